// solver/base/size.h
//
// Counts as indices of meshes and scenes have them.

#pragma once

#include <cstdint>

namespace penumbra {

std::int32_t Size(const auto& container) { return static_cast<std::int32_t>(container.size()); }

}  // namespace penumbra
