// display/flip.h
//
// Components of FLIP (Andersson et al. 2020): colour spaces, and filters that model human vision.

#pragma once

#include <array>
#include <vector>

namespace penumbra {

using Colour = std::array<double, 3>;

// CIE Y of linear sRGB; 1 for white.
double Luminance(const Colour& linear);

// Conversion to and from the opponent colour space in which contrast sensitivity was measured (section 4.1):
// an achromatic channel from 0 to 100, red-green, and blue-yellow.
Colour OpponentFromLinear(const Colour& linear);
Colour LinearFromOpponent(const Colour& opponent);

// CIE L*a*b* of linear sRGB under D65, with a* and b* multiplied by 0.01 L*, because the eye distinguishes
// dark colours less well (Hunt effect; section 4.1).
Colour HuntLab(const Colour& linear);
// The colour distance |dL| + |(da, db)| (Abasi, Amani Tehran and Fairchild 2020).
double HyAb(const Colour& a, const Colour& b);

// A one-dimensional filter: weights at the offsets -radius ... radius, symmetric or antisymmetric.
struct Kernel {
  std::vector<float> weight;
  int radius() const { return static_cast<int>(weight.size() / 2); }
};

// Filters one channel of a picture by the separable kernel across(x) * down(y). Pixels beyond the border have
// the value of the nearest border pixel.
std::vector<float> Filter(const std::vector<float>& plane, int width, int height, const Kernel& across,
                          const Kernel& down);

}  // namespace penumbra
