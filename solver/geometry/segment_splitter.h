// solver/geometry/segment_splitter.h
//
// Splits segments in the plane where they meet each other or a point, until they meet only at common end
// points.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/box_tree.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// A piece of the segment with index `source`, with the same direction.
struct SegmentPiece {
  std::int32_t from = 0, to = 0;  // indices of vertices
  std::int32_t source = 0;
};

class SegmentSplitter {
 public:
  // Splits `pieces` in place and appends crossings to `vertices`, each computed once. A crossing within
  // `snap` of a vertex uses this vertex. A vertex within `snap` of a piece splits the piece. If snapping does
  // not come to an end because many vertices lie within `snap` of each other, later passes merge only points
  // that coincide exactly. Vertices with used[i] == false are ignored. If the result is true, no two pieces
  // cross (by an exact predicate), and no vertex lies in the interior of a piece. If the result is false,
  // crossings lay so close together that splitting did not terminate, and the contents of the arguments are
  // unspecified. REQUIRES: snap is larger than the rounding error of the coordinates.
  [[nodiscard]] bool Split(std::vector<Vec2>& vertices, std::vector<bool>& used,
                           std::vector<SegmentPiece>& pieces, double snap);

 private:
  struct CutPoint {
    std::int32_t piece = 0;
    double at = 0;  // sort key along the piece
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
  double rounding_ = 0;  // largest true distance of a computed distance 0
  std::vector<CutPoint> cuts_;
  std::vector<SegmentPiece> next_;
  std::vector<char> fresh_, next_fresh_;  // per piece: changed since it was last tested
  std::int32_t fresh_vertex_ = 0;         // first vertex added since then
  std::vector<std::int32_t> order_;       // vertices or pieces, sorted by their smallest x
  std::vector<double> low_;               // these smallest x, in the same order
  std::vector<double> left_;              // per piece: its smallest x
  BoxTree tree_;                          // used if there are many vertices or pieces
  std::vector<PlaneBox> boxes_;
  std::vector<std::int32_t> found_;
};

}  // namespace penumbra
