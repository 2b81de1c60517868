// solver/visibility/exact/vertex_tracing.h
//
// Vertex tracing (Stark and Riesenfeld 1999): the corners of what is visible, found one by one, and at each
// the angular spans that are visible. No polygon is ever assembled. In exact numbers.

#pragma once

#include <cstdint>

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

struct TracedFormFactor {
  double form_factor = 0;
  // Vertices of the visible region, intrinsic, apparent or conjunctive, and the borders of visible spans at
  // them.
  std::int64_t vertices = 0, borders = 0;
  // Borders whose contribution is the paper's formula. The others were added up as edges.
  std::int64_t formula_borders = 0;
};

class VertexTracing final : public OcclusionMethod {
 public:
  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;

  TracedFormFactor Trace(const DirectionPolygon& source, std::span<const Occluder> occluders,
                         const Vec3& normal) const;
};

OcclusionRegistry::Method VertexTracingMethod();

}  // namespace penumbra
