// solver/transport/solvers/anderson.h
//
// Anderson acceleration extrapolates a linear iteration, and thus reduces the number of sweeps (iterations of
// the radiosity equation) in rooms of high reflectance.

#pragma once

#include <deque>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Anderson acceleration of x <- G(x), for each channel separately (Anderson 1965). For linear G, Anderson
// acceleration is essentially GMRES restricted to the last few iterations (Walker and Ni 2011).
class AndersonAcceleration {
 public:
  // `weight` holds the weight of each unknown in scalar products: the area of its element.
  explicit AndersonAcceleration(std::vector<double> weight) : weight_(std::move(weight)) {}

  // Records the iteration step from x to g = G(x). Replaces g by that linear combination of the last steps
  // whose residual is smallest. If the residual g - x has grown since the last step, Improve() forgets the
  // earlier steps and leaves g unchanged.
  void Improve(const std::vector<Rgb>& x, std::vector<Rgb>& g);

 private:
  struct Step {
    // `residual` is the change of G(x) - x since the last step, and `value` is the change of G(x) since the
    // last step.
    std::vector<Rgb> residual, value;
    // The scalar products of `residual` with the residual of each stored step up to this step.
    std::deque<Rgb> product;
  };

  Rgb Product(const std::vector<Rgb>& a, const std::vector<Rgb>& b) const;

  std::vector<double> weight_;
  std::vector<Rgb> last_residual_, last_value_;
  double last_norm_ = 0;
  std::deque<Step> steps_;
};

}  // namespace penumbra
