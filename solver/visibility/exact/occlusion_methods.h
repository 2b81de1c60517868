// solver/visibility/exact/occlusion_methods.h

#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The registry of all occlusion methods; the fastest exact method comes first.
OcclusionRegistry& OcclusionMethods();

// The name under which users ask for exact occlusion without naming a method. Blockers are then cut out of
// whole quadtrees of sources at once, which is faster than every registered method.
inline constexpr std::string_view kFastestOcclusion = "auto";
// The names of all occlusion methods: kFastestOcclusion, then those of OcclusionMethods().
std::vector<std::string> OcclusionNames();
// Makes the occlusion method with this name; null for kFastestOcclusion. Throws InputError if no method has
// the name.
std::unique_ptr<const OcclusionMethod> MakeOcclusion(std::string_view name, const OcclusionOptions& options);

}  // namespace penumbra
