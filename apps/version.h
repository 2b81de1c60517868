// apps/version.h

#pragma once

#include <string>

namespace penumbra {

// The text that `--version` prints: the version and, if known, the commit from which the program was built,
// for example "penumbra 1.2.3 (1a2b3c4)". A "+" behind the commit in the text of `--version` means that
// source files had been changed after the commit.
std::string VersionLine();

// The commit from which the program was built; empty if the commit is not known. The build script
// cmake/WriteCommit.cmake generates the definition of CommitOfBuild().
const char* CommitOfBuild();

}  // namespace penumbra
