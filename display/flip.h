// display/flip.h
//
// Components of the image difference FLIP (Andersson et al. 2020): colour spaces, and filters that model
// human vision.

#pragma once

#include <array>
#include <vector>

namespace penumbra {

using Colour = std::array<double, 3>;

// The luminance, CIE Y, of a linear sRGB colour; 1 for white.
double Luminance(const Colour& linear);

// Conversion to and from the opponent colour space in which contrast sensitivity was measured (Andersson et
// al. 2020, section 4.1). The opponent space has an achromatic channel from 0 to 100, a red-green channel,
// and a blue-yellow channel.
Colour OpponentFromLinear(const Colour& linear);
Colour LinearFromOpponent(const Colour& opponent);

// CIE L*a*b* of linear sRGB under D65, with a* and b* multiplied by 0.01 L*, because the eye distinguishes
// dark colours less well (Hunt effect; Andersson et al. 2020, section 4.1).
Colour HuntLab(const Colour& linear);
// The colour distance |dL| + |(da, db)| (Abasi, Amani Tehran and Fairchild 2020).
double HyAb(const Colour& a, const Colour& b);

// A one-dimensional filter: weights at the offsets -radius ... radius, symmetric or antisymmetric.
struct Kernel {
  std::vector<float> weight;
  int radius() const { return static_cast<int>(weight.size() / 2); }
};

// Filters one channel of a picture by the separable kernel across(x) * down(y). Beyond the border of the
// picture, the filter reads the nearest border pixel.
std::vector<float> Filter(const std::vector<float>& plane, int width, int height, const Kernel& across,
                          const Kernel& down);

}  // namespace penumbra
