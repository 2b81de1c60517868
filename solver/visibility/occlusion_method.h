// solver/visibility/occlusion_method.h
//
// What blockers leave of a source, as seen from a point: several methods behind one interface, to choose from
// and to check against each other.

#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/visibility/direction_polygon.h"

namespace penumbra {

class OcclusionMethod {
 public:
  virtual ~OcclusionMethod() = default;

  // The form factor of a point with unit normal `normal` to what none of the occluders covers of `source`, a
  // convex polygon of directions above the horizon. All occluders lie before the source. Safe from any
  // thread.
  virtual double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const = 0;
};

// The names of all methods.
std::vector<std::string> OcclusionMethodNames();

struct OcclusionOptions {
  // Backprojection: edges of blockers' outlines shorter than this, relative to the source's diameter, are
  // left out (thesis, Appendix A, 6). 0: none.
  double min_backprojection_segment = 0;
};

// The method of that name. Throws InputError if there is none.
std::unique_ptr<const OcclusionMethod> MakeOcclusionMethod(std::string_view name,
                                                           const OcclusionOptions& options = {});

// Clipping.
const OcclusionMethod& FastestExactMethod();

}  // namespace penumbra
