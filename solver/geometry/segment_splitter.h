// solver/geometry/segment_splitter.h
//
// Splits segments in the plane where they meet other segments or points, until the pieces meet only at common
// end points.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/box_tree.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// A piece of the segment with the index `source`, in the direction of this segment.
struct SegmentPiece {
  std::int32_t from = 0, to = 0;  // the vertex indices of the two ends of the segment piece
  std::int32_t source = 0;
};

class SegmentSplitter {
 public:
  // Splits the segments in `pieces` in place and appends their crossings to `vertices`; each crossing is
  // computed once. If a vertex lies within the distance `snap` of a crossing, this vertex represents the
  // crossing. A vertex within the distance `snap` of a piece splits the piece. If snapping does not terminate
  // because many vertices lie close together, later passes merge only points that coincide exactly. Vertices
  // with used[i] == false are ignored. Returns true if, tested by an exact predicate, no two pieces cross and
  // no vertex lies in the interior of a piece. Returns false if splitting did not terminate because crossings
  // lay too close together; the contents of the arguments are then unspecified. REQUIRES: `snap` is larger
  // than the rounding error of the coordinates.
  [[nodiscard]] bool Split(std::vector<Vec2>& vertices, std::vector<bool>& used,
                           std::vector<SegmentPiece>& pieces, double snap);

 private:
  struct CutPoint {
    std::int32_t piece = 0;
    double at = 0;  // the key by which points are sorted along a piece of a segment
    std::int32_t vertex = 0;
  };

  bool Splits(const SegmentPiece& piece, std::int32_t vertex) const;
  void Cut(std::int32_t piece, std::int32_t vertex);
  PlaneBox BoxOf(const SegmentPiece& piece, double margin) const;
  bool IsLarge() const;
  void CutAtVertices();
  void CutAtVerticesOfMany();
  void CutAtCrossings();
  void CutAtCrossingsOfMany();
  void CutCrossing(std::int32_t i, std::int32_t j);
  std::int32_t VertexNear(const Vec2& p);
  bool ApplyCuts();

  std::vector<Vec2>* vertices_ = nullptr;
  std::vector<bool>* used_ = nullptr;
  std::vector<SegmentPiece>* pieces_ = nullptr;
  double snap_ = 0;
  double rounding_ = 0;  // an upper bound of the true distance of two points whose computed distance is 0
  std::vector<CutPoint> cuts_;
  std::vector<SegmentPiece> next_;
  // For each piece: true if the piece changed since it was last tested for vertices and crossings on it.
  std::vector<char> fresh_, next_fresh_;
  // Index of the first vertex that was not yet tested against all pieces.
  std::int32_t fresh_vertex_ = 0;
  // The indices of vertices or of segment pieces, sorted by their smallest x coordinate.
  std::vector<std::int32_t> order_;
  std::vector<double> low_;   // low_[i] is the smallest x coordinate of the vertex or piece order_[i]
  std::vector<double> left_;  // left_[i] is the smallest x coordinate of segment piece i
  // A search tree for the vertices or pieces, used if there are many of them.
  BoxTree tree_;
  std::vector<PlaneBox> boxes_;
  std::vector<std::int32_t> found_;
};

}  // namespace penumbra
