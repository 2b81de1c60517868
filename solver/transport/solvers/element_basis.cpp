#include "solver/transport/solvers/element_basis.h"

#include <limits>

#include <Eigen/LU>

#include "solver/base/check.h"
#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

struct RuleNode {
  double s, t, weight;
};

// On [-1, 1]^2.
std::vector<RuleNode> SquareRule(int degree) {
  constexpr double kTwo = 0.57735026918962576, kThree = 0.77459666924148338;
  const std::vector<std::array<double, 2>> line =
      degree == 0 ? std::vector<std::array<double, 2>>{{0, 1}}
      : degree == 1
          ? std::vector<std::array<double, 2>>{{-kTwo, 0.5}, {kTwo, 0.5}}
          : std::vector<std::array<double, 2>>{{-kThree, 5.0 / 18}, {0, 8.0 / 18}, {kThree, 5.0 / 18}};
  std::vector<RuleNode> rule;
  for (const auto& [t, wt] : line)
    for (const auto& [s, ws] : line) rule.push_back({s, t, ws * wt});
  return rule;
}

// On the triangle (0, 0), (1, 0), (0, 1).
std::vector<RuleNode> TriangleRule(int degree) {
  std::vector<RuleNode> rule;
  const auto orbit = [&](double a, double weight) {
    rule.push_back({a, a, weight});
    rule.push_back({1 - 2 * a, a, weight});
    rule.push_back({a, 1 - 2 * a, weight});
  };
  if (degree == 0) {
    rule.push_back({1.0 / 3, 1.0 / 3, 1});
  } else if (degree == 1) {
    orbit(1.0 / 6, 1.0 / 3);
  } else {
    constexpr double kOuter = 0.10995174365532187;
    orbit(0.091576213509770743, kOuter);
    orbit(0.44594849091596489, 1.0 / 3 - kOuter);
  }
  return rule;
}

}  // namespace

bool IsParallelogram(std::span<const Vec3> polygon, double extent) {
  // Each coordinate is rounded, and so are the sums of two.
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * extent;
  return polygon.size() == 4 && MaxAbs(polygon[0] + polygon[2] - polygon[1] - polygon[3]) <= rounding;
}

ElementBasis::ElementBasis(std::span<const Vec3> polygon, BasisDegree degree)
    : degree_(static_cast<int>(degree)), tensor_(polygon.size() == 4) {
  Vec3 a, b;
  if (tensor_) {
    origin_ =
        degree_ == 0 ? Centroid(polygon) : Vec3(0.25 * (polygon[0] + polygon[1] + polygon[2] + polygon[3]));
    a = 0.5 * (polygon[1] - polygon[0]);
    b = 0.5 * (polygon[3] - polygon[0]);
  } else {
    origin_ = polygon[0];
    a = polygon[1] - polygon[0];
    b = polygon[2] - polygon[0];
  }
  const double aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), determinant = aa * bb - ab * ab;
  s_ = (bb * a - ab * b) / determinant;
  t_ = (aa * b - ab * a) / determinant;
  for (const RuleNode& node : tensor_ ? SquareRule(degree_) : TriangleRule(degree_)) {
    node_.emplace_back(origin_ + node.s * a + node.t * b);
    weight_.push_back(node.weight);
  }
  const auto n = static_cast<Eigen::Index>(size());
  Eigen::MatrixXd monomial(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Values values{};
    AddMonomials(node_[static_cast<std::size_t>(i)], 1, values);
    for (Eigen::Index m = 0; m < n; ++m) monomial(i, m) = values[static_cast<std::size_t>(m)];
  }
  coefficient_ = monomial.inverse();
}

void ElementBasis::AddMonomials(const Vec3& position, double factor, Values& monomials) const {
  const Vec3 offset = position - origin_;
  const double s = s_.dot(offset), t = t_.dot(offset);
  std::size_t m = 0;
  double row = factor;
  for (int j = 0; j <= degree_; ++j, row *= t) {
    double value = row;
    for (int i = 0; i <= (tensor_ ? degree_ : degree_ - j); ++i, value *= s) monomials[m++] += value;
  }
}

ElementBasis::Values ElementBasis::FromMonomials(const Values& monomials) const {
  Values values{};
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t m = 0; m < size(); ++m)
      values[i] += coefficient_(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(i)) * monomials[m];
  return values;
}

ElementBasis::Values ElementBasis::At(const Vec3& position) const {
  Values monomials{};
  AddMonomials(position, 1, monomials);
  return FromMonomials(monomials);
}

}  // namespace penumbra
