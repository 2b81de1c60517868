// solver/transport/solvers/anderson.h
//
// Fewer sweeps in bright rooms: guesses where a linear iteration leads from where it has been.

#pragma once

#include <deque>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Anderson's acceleration of x <- G(x), each channel by itself (D. G. Anderson 1965). For linear G it is
// GMRES over the last steps (Walker and Ni 2011).
class AndersonAcceleration {
 public:
  // `weight` says how much each unknown counts: its area.
  explicit AndersonAcceleration(std::vector<double> weight) : weight_(std::move(weight)) {}

  // Takes note of a step from x to g = G(x), and replaces g by a better guess if it has one: the combination
  // of the last steps whose residual is least. Where the residual has grown, it starts again from g.
  void Improve(const std::vector<Rgb>& x, std::vector<Rgb>& g);

 private:
  struct Step {
    std::vector<Rgb> residual, value;  // differences to the step after
    std::deque<Rgb> product;           // of the residuals, with each step up to this one
  };

  Rgb Product(const std::vector<Rgb>& a, const std::vector<Rgb>& b) const;

  std::vector<double> weight_;
  std::vector<Rgb> last_residual_, last_value_;
  double last_norm_ = 0;
  std::deque<Step> steps_;
};

}  // namespace penumbra
