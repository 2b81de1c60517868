// apps/version.h

#pragma once

#include <string>

namespace penumbra {

// What `--version` prints: the version and, where it is known, the commit that the program was built from,
// for example "penumbra 1.2.3 (1a2b3c4)". "+" behind the commit says that files had been changed.
std::string VersionLine();

// The commit; empty if it is not known. The build writes this function (cmake/WriteCommit.cmake).
const char* CommitOfBuild();

}  // namespace penumbra
