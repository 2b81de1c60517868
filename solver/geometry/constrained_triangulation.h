// solver/geometry/constrained_triangulation.h
//
// The constrained Delaunay triangulation of points and segments in the plane (thesis, section 5.4). Segments
// may cross, touch and overlap each other, and may occur several times. The result is a planar mesh in which
// every segment is a chain of edges.
//
// Segments are split at their common points before the triangulation starts, so that each crossing is
// computed once and is shared. A point closer to a segment than the snap distance becomes a vertex of the
// segment: the segment bends by at most the snap distance, which avoids triangles that are too thin for
// binary64. Input points never move.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/geometry/segment_splitter.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Each constraint segment has a tag. Callers may use the tags 0, 1, 2, ... for their own purposes.
inline constexpr std::int32_t kNoTag = -1;
// The tag of segments on the border of the triangulated region. The border consists of closed loops, all of
// which run around the inside of the region in the same sense.
inline constexpr std::int32_t kBorder = -2;

// kSnapDistance, the snap distance divided by the larger side of the points' bounding box, is far above the
// rounding error of a crossing (1e-16) and far below any length that matters.
inline constexpr double kSnapDistance = 1e-13;

struct ConstraintSegment {
  std::int32_t from = 0, to = 0;  // the indices of the two points at the ends of the segment
  // The tag of the segment: kNoTag, kBorder, or a tag >= 0 that the caller has chosen.
  std::int32_t tag = kNoTag;
};

struct ConstrainedTriangulation {
  struct Triangle {
    // The indices of the triangle's vertices, counter-clockwise, beginning with the smallest.
    std::array<std::int32_t, 3> vertex;
    // The neighbour across edge k, which runs from vertex k to vertex k + 1; -1 if no triangle is there.
    std::array<std::int32_t, 3> neighbor;
    // Smallest tag >= 0 of the constraints on edge k; kNoTag if there is none.
    std::array<std::int32_t, 3> tag;
    // border[k] is true if edge k lies on a constraint segment with the tag kBorder.
    std::array<bool, 3> border;
    // edge[k] is the index of edge k in the list `edges`, or -1 if no constraint segment lies on edge k.
    std::array<std::int32_t, 3> edge;
    std::int32_t winding = 0;  // the winding number of the border segments around the triangle

    bool Inside() const { return winding != 0; }
  };

  // A Cover says that a constraint segment runs along an edge of the mesh.
  struct Cover {
    std::int32_t constraint = 0;  // the index of the constraint segment in the list that the caller gave
    // True if the constraint segment runs from the edge's vertex a to its vertex b.
    bool forward = true;
  };
  struct Edge {
    std::int32_t a = 0, b = 0;          // the indices of the vertices at the ends of the edge; a < b
    std::int32_t first = 0, count = 0;  // the entries [first, first + count) of `covers` belong to this edge
  };

  // The vertices are the input points, followed by the crossings of segments. Of several points with equal
  // coordinates, only the first is used.
  std::vector<Vec2> vertices;
  // Triangles that fill the convex hull of the vertices, sorted by their vertex indices.
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;  // all edges of the mesh that lie on constraint segments, sorted by (a, b)
  // One Cover for each constraint on each edge, sorted by edge, then by constraint.
  std::vector<Cover> covers;

  std::span<const Cover> Covers(const Edge& edge) const {
    return std::span(covers).subspan(static_cast<std::size_t>(edge.first),
                                     static_cast<std::size_t>(edge.count));
  }
};

// The winding number of the constraints with the tag `tag` around each triangle, counted counter-clockwise.
// REQUIRES: the mesh was made from `constraints`, and the constraints with the tag `tag` form closed loops.
std::vector<std::int32_t> WindingNumbers(const ConstrainedTriangulation& mesh,
                                         std::span<const ConstraintSegment> constraints, std::int32_t tag);

// Triangulates sets of points and segments, one set after the other, with the same buffers. Each thread needs
// its own triangulator.
class ConstrainedTriangulator {
 public:
  ConstrainedTriangulator();
  ~ConstrainedTriangulator();
  ConstrainedTriangulator(ConstrainedTriangulator&&) noexcept;
  ConstrainedTriangulator& operator=(ConstrainedTriangulator&&) noexcept;

  // Returns the constrained Delaunay triangulation, which stays valid until the next call. If all points lie
  // on a line, the result has no triangles. For four points on a circle, the order of points and constraints
  // determines which diagonal is used; the result is therefore deterministic. The result is null if crossings
  // lie so close together, compared with the rounding of their coordinates, that no planar mesh was found.
  // REQUIRES: coordinates are finite, and the segments' point indices are valid.
  const ConstrainedTriangulation* TryTriangulate(std::span<const Vec2> points,
                                                 std::span<const ConstraintSegment> constraints);
  // Like TryTriangulate(), but the result is never null. REQUIRES: the input has a planar mesh, which is
  // certain if the distances between points are large compared with the snap distance.
  const ConstrainedTriangulation& Triangulate(std::span<const Vec2> points,
                                              std::span<const ConstraintSegment> constraints);

  // Triangulates pieces of segments that SegmentSplitter::Split() has returned, without splitting or snapping
  // them again. A piece has the tag of the constraint of which it is a part. Only points i with used[i] ==
  // true are vertices of the triangulation. REQUIRES: no two points i and j with used[i] and used[j] have
  // equal coordinates.
  const ConstrainedTriangulation& TriangulatePieces(std::span<const Vec2> points,
                                                    const std::vector<bool>& used,
                                                    std::span<const SegmentPiece> pieces,
                                                    std::span<const ConstraintSegment> constraints);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
