#include "mesh/refinement/covered_light.h"

#include <algorithm>
#include <utility>

namespace penumbra {
namespace {

// A piece is omitted if its area is at most this times the area of its triangle and of the polygon. Contacts
// and the edges of the mesh along them differ by about 1e-9 of a patch.
constexpr double kLeastPiece = 1e-6;

// Keeps the part of the polygon to the left of the line from a to b.
void KeepLeft(const Vec2& a, const Vec2& b, Polygon2& polygon, Polygon2& buffer) {
  const Vec2 along = b - a;
  const auto height = [&](const Vec2& p) { return Cross2(along, p - a); };
  if (std::all_of(polygon.begin(), polygon.end(), [&](const Vec2& p) { return height(p) >= 0; })) return;
  buffer.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = height(p), hq = height(q);
    if (hp >= 0) buffer.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) buffer.push_back(p + hp / (hp - hq) * (q - p));
  }
  std::swap(polygon, buffer);
}

}  // namespace

Rgb CoveredLight::Triangle::At(const Vec2& p) const {
  const Vec2 st = BarycentricOf(p);
  return irradiance->At(st.x(), st.y());
}

CoveredLight::CoveredLight(const IrradianceMesh& mesh, std::uint32_t first, std::uint32_t end,
                           const Frame& frame) {
  auto triangles = std::make_shared<std::vector<Triangle>>();
  for (std::uint32_t t = first; t < end; ++t) {
    std::array<Vec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k)
      corner[k] = frame.ToPlane(mesh.positions[mesh.triangles[t].vertex[k]]);
    const double area = SignedArea(corner);
    if (!(area > 0)) continue;
    Triangle triangle{t, corner[0], Eigen::Matrix2d(), area, &mesh.irradiance[t]};
    triangle.to_barycentric.col(0) = corner[1] - corner[0];
    triangle.to_barycentric.col(1) = corner[2] - corner[0];
    triangle.to_barycentric = triangle.to_barycentric.inverse().eval();
    triangles->push_back(triangle);
    Add(static_cast<std::uint32_t>(triangles->size() - 1), corner, area);
  }
  triangles_ = std::move(triangles);
}

void CoveredLight::Add(std::uint32_t triangle, std::span<const Vec2> polygon, double area) {
  const auto first = static_cast<std::uint32_t>(corners_.size());
  corners_.insert(corners_.end(), polygon.begin(), polygon.end());
  pieces_.push_back({triangle, first, static_cast<std::uint32_t>(corners_.size()), area});
  area_ += area;
}

CoveredLight CoveredLight::Within(std::span<const Vec2> polygon) const {
  CoveredLight part;
  part.triangles_ = triangles_;
  const double whole = SignedArea(polygon);
  Polygon2 clipped, buffer;
  for (const Piece& piece : pieces_) {
    const std::span<const Vec2> corners = Corners(piece);
    clipped.assign(corners.begin(), corners.end());
    for (std::size_t k = 0; k < polygon.size() && clipped.size() >= 3; ++k)
      KeepLeft(polygon[k], polygon[(k + 1) % polygon.size()], clipped, buffer);
    if (clipped.size() < 3) continue;
    const double area = SignedArea(clipped);
    const double least = kLeastPiece * std::min(whole, (*triangles_)[piece.triangle].area);
    if (area > least) part.Add(piece.triangle, clipped, area);
  }
  return part;
}

Rgb CoveredLight::Mean() const {
  Rgb sum = Rgb::Zero();
  for (const Piece& piece : pieces_) {
    const Triangle& triangle = (*triangles_)[piece.triangle];
    const std::span<const Vec2> p = Corners(piece);
    for (std::size_t i = 2; i < p.size(); ++i) {
      // The midpoint rule is exact for quadratics.
      const double area = 0.5 * Cross2(p[i - 1] - p[0], p[i] - p[0]);
      sum += area / 3 *
             (triangle.At(0.5 * (p[0] + p[i - 1])) + triangle.At(0.5 * (p[i - 1] + p[i])) +
              triangle.At(0.5 * (p[i] + p[0])));
    }
  }
  return sum / area_;
}

std::vector<CoveredLight::SampleWeights> CoveredLight::MeanWeights() const {
  std::vector<SampleWeights> weights;
  for (const Piece& piece : pieces_) {
    const Triangle& triangle = (*triangles_)[piece.triangle];
    SampleWeights& own = weights.emplace_back();
    own.triangle = triangle.number;
    const std::span<const Vec2> p = Corners(piece);
    for (std::size_t i = 2; i < p.size(); ++i) {
      const double area = 0.5 * Cross2(p[i - 1] - p[0], p[i] - p[0]);
      for (const Vec2& at :
           {Vec2(0.5 * (p[0] + p[i - 1])), Vec2(0.5 * (p[i - 1] + p[i])), Vec2(0.5 * (p[i] + p[0]))}) {
        const Vec2 st = triangle.BarycentricOf(at);
        const std::array<double, 6> basis = QuadraticInterpolant::WeightsAt(st.x(), st.y());
        for (std::size_t k = 0; k < basis.size(); ++k) own.weight[k] += area / (3 * area_) * basis[k];
      }
    }
  }
  return weights;
}

Rgb CoveredLight::Deviation(const Rgb& mean) const {
  Rgb deviation = Rgb::Zero();
  for (const Piece& piece : pieces_) {
    const Triangle& triangle = (*triangles_)[piece.triangle];
    const std::span<const Vec2> p = Corners(piece);
    for (std::size_t i = 0; i < p.size(); ++i) {
      deviation = deviation.max((triangle.At(p[i]) - mean).abs());
      deviation = deviation.max((triangle.At(0.5 * (p[i] + p[(i + 1) % p.size()])) - mean).abs());
    }
  }
  return deviation;
}

double CoveredLight::LargestTriangle() const {
  double largest = 0;
  for (const Piece& piece : pieces_) largest = std::max(largest, (*triangles_)[piece.triangle].area);
  return largest;
}

}  // namespace penumbra
