// solver/visibility/exact/backprojection.h
//
// Backprojection (thesis, section 6.2): the outlines of all blockers are projected from the receiver point
// onto the source, and are constraints of a Delaunay triangulation of the source. Each triangle of the source
// is visible or hidden as a whole. Backprojection makes all decisions with exact numbers.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {

// The triangulated source as seen from the receiver point, for inspection. A source that fills most of a
// hemisphere is split into at most four parts, which share no vertices.
struct BackprojectedSource {
  struct Triangle {
    std::array<std::int32_t, 3> vertex;
    bool visible = false;
  };
  // An edge of the triangulation that lies on the outline of an occluder.
  struct BlockerEdge {
    std::int32_t a = 0, b = 0;  // the indices of the vertices at the ends of the edge; a < b
    std::int32_t occluder = 0;  // index of an occluder; an edge on the outlines of n occluders has n entries
  };

  // The directions from the receiver point to the vertices, which lie in one plane for each part of a planar
  // source.
  std::vector<Vec3> vertex;
  std::vector<Triangle> triangle;
  // The edges that lie on outlines of occluders, sorted by (a, b, occluder).
  std::vector<BlockerEdge> blocker_edge;
};

class Backprojection final : public OcclusionMethod {
 public:
  // Collapses an edge of a blocker's outline into its midpoint if the edge's projection onto the image of the
  // source is shorter than `min_segment` times the diameter of that image (thesis, Appendix A, item 6). The
  // thesis collapses edges to keep the triangulation stable; the class Backprojection collapses edges only to
  // save time. With min_segment = 0, the visible form factor is exact.
  explicit Backprojection(double min_segment = 0) : min_segment_(min_segment) {}

  double VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                           const Vec3& normal) const override;

  // Returns the triangulation of the source; VisibleFormFactor() adds up the form factors of its visible
  // triangles.
  BackprojectedSource Project(const DirectionPolygon& source, std::span<const Occluder> occluders,
                              const Vec3& normal) const;

 private:
  double min_segment_;
};

OcclusionRegistry::Method BackprojectionMethod();

}  // namespace penumbra
