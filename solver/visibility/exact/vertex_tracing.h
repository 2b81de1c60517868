// solver/visibility/exact/vertex_tracing.h
//
// Vertex tracing (Stark and Riesenfeld 1999): finds the vertices of the visible region one by one, and the
// visible angular spans of each vertex. Vertex tracing builds no polygon of the visible region. Vertex
// tracing makes all decisions with exact numbers.

#pragma once

#include <cstdint>

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

struct TracedFormFactor {
  double form_factor = 0;
  // `vertices` is the number of vertices of the visible region (intrinsic, apparent or conjunctive). Each
  // vertex of the visible region has one or more visible angular spans; `borders` is the number of the
  // borders of all spans.
  std::int64_t vertices = 0, borders = 0;
  // The number of borders of angular spans whose contribution to the form factor is computed by the formula
  // of Stark and Riesenfeld. For all other borders of angular spans, the contribution to the form factor is
  // computed edge by edge.
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
