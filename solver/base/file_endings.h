// solver/base/file_endings.h
//
// Finds the format of a file by the ending of its name. In a registry of file formats, the name of a format
// is its ending without the dot, such as "png".

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"

namespace penumbra {

// The ending of the file's name, without the dot; an empty string if the name has no ending.
std::string EndingOf(const std::string& path);

// The error message for a path that has none of the permitted endings, for example "'a.txt' ends neither in
// .png nor in .exr".
std::string EndingError(const std::string& path, const std::vector<std::string>& endings);

// Returns the given file endings, each with a dot in front: "png" becomes ".png".
std::vector<std::string> Dotted(std::vector<std::string> endings);

// The format in the registry whose name is the ending of the path, EndingOf(path); null if there is no such
// format.
template <class Product, class... Options>
const typename Registry<Product, Options...>::Method* FindByEnding(
    const Registry<Product, Options...>& formats, const std::string& path) {
  const std::string ending = EndingOf(path);
  for (const auto& format : formats.methods())
    if (format.name == ending) return &format;
  return nullptr;
}

}  // namespace penumbra
