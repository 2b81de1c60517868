// solver/base/file_endings.h
//
// File formats by the ending of a file's name. Registries of formats name each format by its ending, without
// the dot.

#pragma once

#include <string>
#include <vector>

#include "solver/base/registry.h"

namespace penumbra {

// Without the dot; empty if the name has no ending.
std::string EndingOf(const std::string& path);

// What to tell of a name that has none of the endings: "'a.txt' ends neither in .png nor in .exr".
std::string EndingError(const std::string& path, const std::vector<std::string>& endings);

// Each ending with its dot.
std::vector<std::string> Dotted(std::vector<std::string> endings);

// The format that the ending of the path names; null if none has that name.
template <class Product, class... Options>
const typename Registry<Product, Options...>::Method* FindByEnding(
    const Registry<Product, Options...>& formats, const std::string& path) {
  const std::string ending = EndingOf(path);
  for (const auto& format : formats.methods())
    if (format.name == ending) return &format;
  return nullptr;
}

}  // namespace penumbra
