// solver/base/size.h
//
// The number of elements of a container as std::int32_t, the type of all indices in meshes and scenes.

#pragma once

#include <cstdint>

namespace penumbra {

std::int32_t Size(const auto& container) { return static_cast<std::int32_t>(container.size()); }

}  // namespace penumbra
