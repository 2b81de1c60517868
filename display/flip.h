// display/flip.h
//
// The pieces of FLIP (Andersson et al. 2020): colour spaces, and filters that see as an eye does.

#pragma once

#include <array>
#include <vector>

namespace penumbra {

using Colour = std::array<double, 3>;

// CIE Y of linear sRGB; 1 for white.
double Luminance(const Colour& linear);

// The opponent space that contrast sensitivity was measured in: achromatic Y 0 to 100, red-green, blue-yellow
// (section 4.1), and back.
Colour OpponentFromLinear(const Colour& linear);
Colour LinearFromOpponent(const Colour& opponent);

// CIE L*a*b* of linear sRGB under D65, a and b scaled by 0.01 L: colours are told apart less well in the dark
// (Hunt; section 4.1).
Colour HuntLab(const Colour& linear);
// |dL| + |(da, db)| (Abasi, Amani Tehran and Fairchild 2020).
double HyAb(const Colour& a, const Colour& b);

// Weights at the offsets -radius ... radius, symmetric or antisymmetric.
struct Kernel {
  std::vector<float> weight;
  int radius() const { return static_cast<int>(weight.size() / 2); }
};

// The picture, filtered by across(x) x down(y); beyond its border the border goes on.
std::vector<float> Filter(const std::vector<float>& plane, int width, int height, const Kernel& across,
                          const Kernel& down);

}  // namespace penumbra
