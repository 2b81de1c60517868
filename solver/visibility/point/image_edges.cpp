#include "solver/visibility/point/image_edges.h"

#include <cmath>

#include "solver/base/vector_dispatch.h"
#include "solver/visibility/point/arc_tangent.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// In the frame's coordinates, an edge starts at a = (x + p, y + q, 1) and has the direction e = (dx, dy, 0).
// n is the point's normal.
struct FrameNumbers {
  double p, q;
  double n1, n2, n3;
};

// Computes the terms and angles of all edges. `edge` points to their x, y, dx and dy.
PENUMBRA_VECTOR_CLONES
void Terms(const std::array<const double*, 4>& edge, std::size_t count, FrameNumbers frame,
           double* __restrict term, double* __restrict angle) {
  const double* __restrict x = edge[0], * __restrict y = edge[1];
  const double* __restrict dx = edge[2], * __restrict dy = edge[3];
  const auto [p, q, n1, n2, n3] = frame;
  for (std::size_t i = 0; i < count; ++i) {
    const double ax = x[i] + p, ay = y[i] + q;
    const double turn = ax * dy[i] - ay * dx[i];  // a x e = (-dy, dx, turn)
    const double length = std::sqrt(dx[i] * dx[i] + dy[i] * dy[i] + turn * turn);
    const double cosine = ax * (ax + dx[i]) + ay * (ay + dy[i]) + 1;
    const double rise = n2 * dx[i] - n1 * dy[i] + n3 * turn;
    angle[i] = internal::AngleOf(length, cosine);
    term[i] = rise / (length > 0 ? length : 1.0) * angle[i];
  }
}

}  // namespace

void ImageEdges::Clear() {
  for (std::vector<double>& values : edge_) values.clear();
  label_.clear();
  start_.clear();
  owner_.clear();
}

void ImageEdges::AddPiece(const double* x, const double* y, const EdgeLabel* label, int size,
                          PieceOwner owner) {
  const std::size_t begin = label_.size(), end = begin + static_cast<std::size_t>(size);
  start_.push_back(begin);
  owner_.push_back(owner);
  for (std::vector<double>& values : edge_) values.resize(end);
  label_.resize(end);
  for (int i = 0; i < size; ++i) {
    const int j = i + 1 == size ? 0 : i + 1;
    const std::size_t at = begin + static_cast<std::size_t>(i);
    edge_[0][at] = x[i];
    edge_[1][at] = y[i];
    edge_[2][at] = x[j] - x[i];
    edge_[3][at] = y[j] - y[i];
    label_[at] = label[i];
  }
}

Vec2 ImageEdges::Centroid(std::size_t piece) const {
  const std::size_t first = Begin(piece), last = Begin(piece + 1);
  double area = 0;
  Vec2 sum = Vec2::Zero();
  Vec2 a = Difference(first);  // relative to the first vertex
  for (std::size_t i = first + 1; i + 1 < last; ++i) {
    const Vec2 b = a + Difference(i);
    const double twice = a.x() * b.y() - a.y() * b.x();
    area += twice;
    sum += twice * (a + b);
    a = b;
  }
  return area > 0 ? Vec2(Start(first) + sum / (3 * area)) : Start(first);
}

ImageEdges::Sum ImageEdges::FormFactorSum(const ImageFrame& frame, const Vec3& normal) {
  term_.resize(edge_[0].size());
  angle_.resize(edge_[0].size());
  Terms({edge_[0].data(), edge_[1].data(), edge_[2].data(), edge_[3].data()}, term_.size(),
        {frame.Shift().x(), frame.Shift().y(), normal.dot(frame.E1()), normal.dot(frame.E2()),
         normal.dot(frame.Axis())},
        term_.data(), angle_.data());
  Sum sum;
  for (std::size_t i = 0; i < term_.size(); ++i) {
    sum.value += term_[i];
    sum.angles += angle_[i];
  }
  return sum;
}

double ImageEdges::PieceSum(std::size_t piece) const {
  double sum = 0;
  for (std::size_t i = Begin(piece); i < Begin(piece + 1); ++i) sum += term_[i];
  return sum;
}

double ImageEdges::PieceByQuadrature(const ImageFrame& frame, const Vec3& normal, std::size_t piece) const {
  std::vector<Vec3> offset;
  for (std::size_t i = Begin(piece); i < Begin(piece + 1); ++i)
    offset.push_back(Start(i).x() * frame.E1() + Start(i).y() * frame.E2());
  return FormFactorByQuadrature(frame.Origin(), offset, normal);
}

}  // namespace penumbra
