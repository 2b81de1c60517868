#include "solver/transport/sources/source_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/geometry/polygon.h"
#include "solver/visibility/point/clipping.h"

namespace penumbra {
namespace {

// Gauss-Legendre nodes and weights on [0, 1].
constexpr int kNodes = 10;
constexpr std::array<double, kNodes> kNode = {0.013046735741414128, 0.067468316655507732, 0.16029521585048778,
                                              0.28330230293537639,  0.42556283050918442,  0.57443716949081558,
                                              0.71669769706462361,  0.83970478414951222,  0.93253168334449232,
                                              0.98695326425858587};
constexpr std::array<double, kNodes> kWeight = {
    0.033335672154344367, 0.074725674575290266, 0.10954318125799103, 0.13463335965499812,
    0.14776211235737646,  0.14776211235737646,  0.13463335965499812, 0.10954318125799103,
    0.074725674575290266, 0.033335672154344367};

// A piece is far from the point if the distance of its centre is at least this times its half diagonal. The
// kernel is then analytic in ellipses about the sides whose semi-axes add up to at least 5.8 half sides, and
// the error of ten nodes is about 5.8^-20 = 5e-16 of the piece.
constexpr double kFar = 3;

// After this number of halvings a piece counts as far: it is smaller than the rounding of its coordinates.
constexpr int kMostHalvings = 110;

// A convex quadrilateral; a triangle repeats its last vertex.
using Piece = std::array<Vec3, 4>;

class Nodes {
 public:
  Nodes(const ReceiverPoint& at, const Patch& source, std::vector<SourceNode>& nodes)
      : at_(at), source_(source), height_(source.normal.dot(at.position - source.vertex[0])), nodes_(nodes) {}

  void Add(const Piece& piece, int halvings) {
    const Vec3 centre = 0.25 * (piece[0] + piece[1] + piece[2] + piece[3]);
    double square = 0;
    for (const Vec3& v : piece) square = std::max(square, (v - centre).squaredNorm());
    if ((centre - at_.position).squaredNorm() >= kFar * kFar * square || halvings >= kMostHalvings)
      return AddGauss(piece);
    // Halves the longer pair of sides.
    const double along = std::max((piece[1] - piece[0]).squaredNorm(), (piece[2] - piece[3]).squaredNorm());
    const double across = std::max((piece[3] - piece[0]).squaredNorm(), (piece[2] - piece[1]).squaredNorm());
    if (along >= across) {
      const Vec3 low = 0.5 * (piece[0] + piece[1]), high = 0.5 * (piece[3] + piece[2]);
      Add({piece[0], low, high, piece[3]}, halvings + 1);
      Add({low, piece[1], piece[2], high}, halvings + 1);
    } else {
      const Vec3 low = 0.5 * (piece[0] + piece[3]), high = 0.5 * (piece[1] + piece[2]);
      Add({piece[0], piece[1], high, low}, halvings + 1);
      Add({low, high, piece[2], piece[3]}, halvings + 1);
    }
  }

 private:
  void AddGauss(const Piece& q) {
    for (std::size_t j = 0; j < kNodes; ++j)
      for (std::size_t i = 0; i < kNodes; ++i) {
        const double s = kNode[i], t = kNode[j];
        const Vec3 low = q[0] + s * (q[1] - q[0]), high = q[3] + s * (q[2] - q[3]);
        const Vec3 position = low + t * (high - low);
        const Vec3 ds = (1 - t) * (q[1] - q[0]) + t * (q[2] - q[3]), dt = high - low;
        const Vec3 sight = position - at_.position;
        const double square = sight.squaredNorm(), rise = at_.normal.dot(sight);
        if (rise <= 0 || square == 0) continue;
        nodes_.push_back({position, kWeight[i] * kWeight[j] * ds.cross(dt).norm() * rise * height_ /
                                        (std::numbers::pi * square * square)});
      }
  }

  const ReceiverPoint& at_;
  const Patch& source_;
  double height_;  // height of the point above the source's plane [m]
  std::vector<SourceNode>& nodes_;
};

// Error of the sum over all pieces: each piece has a relative error of at most 5e-16, and blockers' outlines
// lose digits in the image.
constexpr double kNodesError = 1e-13;

}  // namespace

double SourceQuadratureError(const ReceiverPoint& at, const Patch& source) {
  const double height = std::abs(source.normal.dot(at.position - source.vertex[0]));
  const double rounding = HeightRounding(MaxAbs(at.position) + source.extent);
  return kNodesError + std::min(1.0, rounding / height);
}

void AddSourceNodes(const ReceiverPoint& at, const Patch& source, std::span<const Vec3> part,
                    std::vector<SourceNode>& nodes) {
  Nodes add(at, source, nodes);
  for (std::size_t i = 2; i < part.size(); i += 2)
    add.Add({part[0], part[i - 1], part[i], part[i + 1 < part.size() ? i + 1 : i]}, 0);
}

void AddVisibleSourceNodes(PointView& view, std::span<const Vec3> part, std::span<const PatchId> candidates,
                           PatchId own, std::vector<SourceNode>& nodes) {
  const ReceiverPoint& at = view.at();
  const Patch& patch = view.Source();
  const DirectionPolygon seen = view.SeeSource(part);
  if (seen.empty()) return;
  std::vector<Occluder>& occluders = view.occluder_stack();
  occluders.clear();
  if (!view.FindBlockers(candidates, own, seen, occluders)) return;
  if (occluders.empty()) {
    if (view.SourceIsPlain()) return AddSourceNodes(at, patch, part, nodes);
    const Polygon3 above =
        ClipToHalfSpace(part, at.normal, at.position, HeightRounding(MaxAbs(at.position) + patch.extent));
    if (!above.empty()) AddSourceNodes(at, patch, above, nodes);
    return;
  }
  // Projects the visible pieces from the point onto the source's plane.
  const double height = patch.normal.dot(patch.vertex[0] - at.position);
  Polygon3 piece;
  ForEachVisiblePiece(seen, occluders, at.normal, [&](std::span<const Vec3> directions) {
    piece.clear();
    for (const Vec3& direction : directions)
      piece.push_back(at.position + direction * (height / patch.normal.dot(direction)));
    AddSourceNodes(at, patch, piece, nodes);
  });
}

}  // namespace penumbra
