// solver/visibility/point/occlusion_method.h
//
// An interface to compute the part of a source that blockers leave visible from a point. The project has
// several occlusion methods, so that their results can be compared.

#pragma once

#include <span>

#include "solver/base/registry.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// A bound of (error of an exact occlusion method) / (form factor of the unoccluded source), if the given
// directions and normal are taken as exact. Three errors contribute to the bound kOcclusionError. Each of
// about ten clippings of a polygon moves an edge by up to 8 rounding errors of the image coordinates. The
// relative error of computing and adding form factors is kFormFactorError. If the source is seen at a grazing
// angle of 1e-5, one decimal digit of its form factor is lost.
inline constexpr double kOcclusionError = 1e-12;

class OcclusionMethod {
 public:
  virtual ~OcclusionMethod() = default;

  // The form factor of a point with unit normal `normal` to the part of `source` that no occluder covers.
  // VisibleFormFactor() may be called from any thread. REQUIRES: `source` is convex and lies above the
  // point's horizon; all occluders lie in front of the source.
  virtual double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const = 0;
};

struct OcclusionOptions {
  // Used only by backprojection: edges of blockers' outlines that are shorter than
  // min_backprojection_segment * (diameter of the source) are collapsed (thesis, Appendix A, item 6). With
  // min_backprojection_segment = 0, no edges are collapsed.
  double min_backprojection_segment = 0;
};

// The registry of occlusion methods; OcclusionMethods() lists all methods.
using OcclusionRegistry = Registry<const OcclusionMethod, OcclusionOptions>;

// The fastest exact occlusion method, which is clipping.
const OcclusionMethod& FastestExactMethod();

}  // namespace penumbra
