// solver/geometry/constrained_triangulation.h
//
// The constrained Delaunay triangulation of points and segments in the plane (thesis, section 5.4). Segments
// may cross, touch, overlap and repeat; the result is a planar mesh in which every segment is a chain of
// edges.
//
// Before anything is triangulated the segments are split where they meet, so that each crossing is computed
// once and shared. Points nearer to a segment than kSnapDistance become vertices of it: the segment bends by
// that much, instead of leaving a triangle too thin for binary64. Input points never move.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/geometry/segment_splitter.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Tags of constraints. Users' own tags are 0 or more.
inline constexpr std::int32_t kNoTag = -1;
// The border of the region: closed loops, each running in one sense around what is inside.
inline constexpr std::int32_t kBorder = -2;

// Relative to the larger side of the box around the points: far above the rounding of a crossing (1e-16), far
// below any length that matters.
inline constexpr double kSnapDistance = 1e-13;

struct ConstraintSegment {
  std::int32_t from = 0, to = 0;  // indices of points
  std::int32_t tag = kNoTag;      // kBorder, or 0 or more
};

struct ConstrainedTriangulation {
  struct Triangle {
    std::array<std::int32_t, 3> vertex;  // counter-clockwise; the smallest index comes first
    std::array<std::int32_t, 3>
        neighbor;                      // across edge k, which runs from vertex k to vertex k + 1; -1 for none
    std::array<std::int32_t, 3> tag;   // the smallest tag >= 0 of the constraints on edge k, else kNoTag
    std::array<bool, 3> border;        // edge k lies on a constraint tagged kBorder, whatever `tag` says
    std::array<std::int32_t, 3> edge;  // index in `edges`, -1 if no constraint lies on edge k
    std::int32_t winding = 0;          // how often the border runs counter-clockwise around the triangle

    bool Inside() const { return winding != 0; }
  };

  // A stretch of a constraint that is an edge of the mesh.
  struct Cover {
    std::int32_t constraint = 0;  // index in the input
    bool forward = true;          // the constraint runs from vertex a to vertex b of the edge
  };
  struct Edge {
    std::int32_t a = 0, b = 0;          // vertices, a < b
    std::int32_t first = 0, count = 0;  // its range in `covers`
  };

  // The input points, then the crossings of segments. Of several points in the same place only the first is
  // used.
  std::vector<Vec2> vertices;
  std::vector<Triangle> triangles;  // ascending by their vertices; they fill the convex hull
  std::vector<Edge> edges;          // ascending by (a, b)
  std::vector<Cover> covers;        // of each edge, ascending by constraint

  std::span<const Cover> Covers(const Edge& edge) const {
    return std::span(covers).subspan(static_cast<std::size_t>(edge.first),
                                     static_cast<std::size_t>(edge.count));
  }
};

// Of each triangle, how often the constraints with the tag run counter-clockwise around it. REQUIRES: they
// are the constraints that the mesh was made with, and those with the tag form closed loops.
std::vector<std::int32_t> WindingNumbers(const ConstrainedTriangulation& mesh,
                                         std::span<const ConstraintSegment> constraints, std::int32_t tag);

// Triangulates one set after the other and keeps its buffers in between. One object a thread.
class ConstrainedTriangulator {
 public:
  ConstrainedTriangulator();
  ~ConstrainedTriangulator();
  ConstrainedTriangulator(ConstrainedTriangulator&&) noexcept;
  ConstrainedTriangulator& operator=(ConstrainedTriangulator&&) noexcept;

  // The result stays valid until the next call. Without triangles if all points lie on a line. The order of
  // points and constraints decides between diagonals of four points on a circle, and so the result is a
  // function of the input. Null where crossings crowd within the rounding of their coordinates so that no
  // planar mesh was found. REQUIRES: finite coordinates, indices in range.
  const ConstrainedTriangulation* TryTriangulate(std::span<const Vec2> points,
                                                 std::span<const ConstraintSegment> constraints);
  // The same where there is one, as there always is if points lie far apart beside kSnapDistance.
  const ConstrainedTriangulation& Triangulate(std::span<const Vec2> points,
                                              std::span<const ConstraintSegment> constraints);

  // The same of pieces that SegmentSplitter::Split() left: nothing is split or moved any more. A piece has
  // the tag of the constraint that is its source. REQUIRES: no two points that are used lie in one place.
  const ConstrainedTriangulation& TriangulatePieces(std::span<const Vec2> points,
                                                    const std::vector<bool>& used,
                                                    std::span<const SegmentPiece> pieces,
                                                    std::span<const ConstraintSegment> constraints);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
