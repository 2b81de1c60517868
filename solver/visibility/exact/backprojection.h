// solver/visibility/exact/backprojection.h
//
// Backprojection (thesis, section 6.2): the outlines of all blockers, projected from the point onto the
// source, as segments of a constrained Delaunay triangulation of it; each triangle is wholly visible or
// hidden. In exact numbers.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The triangulated source as seen, to look at. A source that fills most of a hemisphere comes in up to four
// parts that share no vertices.
struct BackprojectedSource {
  struct Triangle {
    std::array<std::int32_t, 3> vertex;
    bool visible = false;
  };
  // An edge of triangles that lies on the outline of an occluder.
  struct BlockerEdge {
    std::int32_t a = 0, b = 0;  // vertices, a < b
    std::int32_t occluder = 0;  // index in what was given; one entry for each that shares the edge
  };

  std::vector<Vec3> vertex;  // directions; the vertices of a planar source's part lie in one plane
  std::vector<Triangle> triangle;
  std::vector<BlockerEdge> blocker_edge;  // ascending by a, b, occluder
};

class Backprojection final : public OcclusionMethod {
 public:
  // Edges of blockers' outlines, as projected onto the image of the source, that are shorter than
  // `min_segment` times the source's diameter there are collapsed into their middle (thesis, Appendix A,
  // item 6; there to keep the triangulation stable, here to save time). 0 leaves everything exact.
  explicit Backprojection(double min_segment = 0) : min_segment_(min_segment) {}

  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;

  // What VisibleFormFactor() adds up.
  BackprojectedSource Project(const DirectionPolygon& source, std::span<const Occluder> occluders,
                              const Vec3& normal) const;

 private:
  double min_segment_;
};

OcclusionRegistry::Method BackprojectionMethod();

}  // namespace penumbra
