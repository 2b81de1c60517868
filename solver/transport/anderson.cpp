#include "solver/transport/anderson.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

constexpr std::size_t kSteps = 8;  // that are kept

// Directions that are this small beside the largest are rounding.
constexpr double kRankThreshold = 1e-10;

}  // namespace

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
    Step step{std::vector<Rgb>(n), std::vector<Rgb>(n)};
    for (std::size_t i = 0; i < n; ++i) {
      step.residual[i] = residual[i] - last_residual_[i];
      step.value[i] = g[i] - last_value_[i];
    }
    steps_.push_back(std::move(step));
    if (steps_.size() > kSteps) steps_.pop_front();
  }
  last_residual_ = residual;
  last_value_ = g;
  last_norm_ = norm;
  if (steps_.empty()) return;

  const auto m = static_cast<Eigen::Index>(steps_.size());
  for (int channel = 0; channel < 3; ++channel) {
    Eigen::MatrixXd product(m, m);
    Eigen::VectorXd right(m);
    for (Eigen::Index a = 0; a < m; ++a) {
      const std::vector<Rgb>& fa = steps_[static_cast<std::size_t>(a)].residual;
      for (Eigen::Index b = 0; b <= a; ++b) {
        const std::vector<Rgb>& fb = steps_[static_cast<std::size_t>(b)].residual;
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += weight_[i] * fa[i][channel] * fb[i][channel];
        product(a, b) = product(b, a) = sum;
      }
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += weight_[i] * fa[i][channel] * residual[i][channel];
      right[a] = sum;
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(kRankThreshold);
    solver.compute(product);
    const Eigen::VectorXd gamma = solver.solve(right);
    if (!gamma.allFinite()) continue;
    for (Eigen::Index a = 0; a < m; ++a) {
      const std::vector<Rgb>& value = steps_[static_cast<std::size_t>(a)].value;
      for (std::size_t i = 0; i < n; ++i) g[i][channel] -= gamma[a] * value[i][channel];
    }
  }
}

}  // namespace penumbra
