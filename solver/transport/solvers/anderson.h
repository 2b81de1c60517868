// solver/transport/solvers/anderson.h
//
// Anderson acceleration: extrapolates a linear iteration, and thus reduces the number of sweeps in rooms of
// high reflectance.

#pragma once

#include <deque>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Anderson acceleration of x <- G(x), for each channel separately (Anderson 1965). For linear G, Anderson
// acceleration is essentially GMRES restricted to the last steps (Walker and Ni 2011).
class AndersonAcceleration {
 public:
  // `weight` holds the weight of each unknown in scalar products: the area of its element.
  explicit AndersonAcceleration(std::vector<double> weight) : weight_(std::move(weight)) {}

  // Records the step from x to g = G(x). Replaces g by the linear combination of the last steps with the
  // smallest residual. If the residual has grown, forgets the earlier steps and leaves g unchanged.
  void Improve(const std::vector<Rgb>& x, std::vector<Rgb>& g);

 private:
  struct Step {
    std::vector<Rgb> residual, value;  // differences to the next step
    std::deque<Rgb> product;  // scalar products of this residual with those of all steps up to this one
  };

  Rgb Product(const std::vector<Rgb>& a, const std::vector<Rgb>& b) const;

  std::vector<double> weight_;
  std::vector<Rgb> last_residual_, last_value_;
  double last_norm_ = 0;
  std::deque<Step> steps_;
};

}  // namespace penumbra
