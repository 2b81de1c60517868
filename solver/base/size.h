// solver/base/size.h
//
// The size of a container in the type that indices of meshes and scenes have.

#pragma once

#include <cstdint>

namespace penumbra {

std::int32_t Size(const auto& container) { return static_cast<std::int32_t>(container.size()); }

}  // namespace penumbra
