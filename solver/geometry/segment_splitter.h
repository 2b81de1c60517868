// solver/geometry/segment_splitter.h
//
// Splits segments in the plane where they meet each other or a point, until they meet in common ends only.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/box_tree.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// A piece of the segment `source`, running in its sense.
struct SegmentPiece {
  std::int32_t from = 0, to = 0;  // indices of vertices
  std::int32_t source = 0;
};

class SegmentSplitter {
 public:
  // Splits `pieces` in place. `vertices` grows by the crossings, each computed once; a crossing within
  // `snap` of a vertex uses that vertex, and a vertex within `snap` of a piece splits it.
  // Where vertices crowd within `snap` of each other, only what meets exactly is joined in the end.
  // Vertices whose `used` flag is false take no part. On return no two pieces cross (exactly decided), and no
  // vertex lies inside a piece. REQUIRES: snap above the rounding error of the coordinates.
  // False, with no promise about what is left, if crossings crowd so densely that no end is found.
  [[nodiscard]] bool Split(std::vector<Vec2>& vertices, std::vector<bool>& used,
                           std::vector<SegmentPiece>& pieces, double snap);

 private:
  struct CutPoint {
    std::int32_t piece = 0;
    double at = 0;  // its place in the order along the piece
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
  double rounding_ = 0;  // a computed distance of 0 is at most this
  std::vector<CutPoint> cuts_;
  std::vector<SegmentPiece> next_;
  std::vector<char> fresh_, next_fresh_;  // pieces that changed since they were last tested
  std::int32_t fresh_vertex_ = 0;         // vertices from here on are new since then
  std::vector<std::int32_t> order_;       // vertices or pieces by their smallest x
  std::vector<double> low_;               // that x, in the same order
  std::vector<double> left_;              // of each piece, that x
  BoxTree tree_;                          // of many vertices or pieces
  std::vector<PlaneBox> boxes_;
  std::vector<std::int32_t> found_;
};

}  // namespace penumbra
