#include "solver/transport/solvers/anderson.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

constexpr std::size_t kSteps = 8;  // number of steps kept

// Directions this small relative to the largest are rounding errors.
constexpr double kRankThreshold = 1e-10;

}  // namespace

// The weighted scalar product of two vectors of unknowns, for each channel.
Rgb AndersonAcceleration::Product(const std::vector<Rgb>& a, const std::vector<Rgb>& b) const {
  Rgb sum = Rgb::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) sum += weight_[i] * a[i] * b[i];
  return sum;
}

void AndersonAcceleration::Improve(const std::vector<Rgb>& x, std::vector<Rgb>& g) {
  const std::size_t n = g.size();
  std::vector<Rgb> residual(n);
  double norm = 0;
  for (std::size_t i = 0; i < n; ++i) {
    residual[i] = g[i] - x[i];
    norm += weight_[i] * residual[i].square().sum();
  }
  if (last_norm_ > 0 && norm > last_norm_) {
    steps_.clear();
  } else if (!last_residual_.empty()) {
    Step step{std::vector<Rgb>(n), std::vector<Rgb>(n), {}};
    for (std::size_t i = 0; i < n; ++i) {
      step.residual[i] = residual[i] - last_residual_[i];
      step.value[i] = g[i] - last_value_[i];
    }
    if (steps_.size() == kSteps) {
      steps_.pop_front();
      for (Step& other : steps_) other.product.pop_front();
    }
    for (const Step& other : steps_) step.product.push_back(Product(step.residual, other.residual));
    step.product.push_back(Product(step.residual, step.residual));
    steps_.push_back(std::move(step));
  }
  last_residual_ = residual;
  last_value_ = g;
  last_norm_ = norm;
  if (steps_.empty()) return;

  const std::size_t m = steps_.size();
  std::vector<Rgb> right;
  for (const Step& step : steps_) right.push_back(Product(step.residual, residual));
  std::vector<Rgb> gamma(m, Rgb::Zero());
  for (int channel = 0; channel < 3; ++channel) {
    const auto size = static_cast<Eigen::Index>(m);
    Eigen::MatrixXd product(size, size);
    Eigen::VectorXd side(size);
    for (Eigen::Index a = 0; a < size; ++a) {
      side[a] = right[static_cast<std::size_t>(a)][channel];
      for (Eigen::Index b = 0; b <= a; ++b)
        product(a, b) = product(b, a) =
            steps_[static_cast<std::size_t>(a)].product[static_cast<std::size_t>(b)][channel];
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(kRankThreshold);
    solver.compute(product);
    const Eigen::VectorXd solved = solver.solve(side);
    if (!solved.allFinite()) continue;
    for (std::size_t a = 0; a < m; ++a) gamma[a][channel] = solved[static_cast<Eigen::Index>(a)];
  }
  for (std::size_t a = 0; a < m; ++a)
    for (std::size_t i = 0; i < n; ++i) g[i] -= gamma[a] * steps_[a].value[i];
}

}  // namespace penumbra
