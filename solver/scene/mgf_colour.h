// solver/scene/mgf_colour.h
//
// Colours of the Materials and Geometry Format (MGF): CIE chromaticities, spectra and colour temperatures.
// Colours are converted from and to RGB with the primaries that MGF's own conversion uses.

#pragma once

#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// Converts an RGB colour to CIE XYZ.
Vec3 MgfXyz(const Rgb& rgb);
// Converts CIE XYZ to an RGB colour, the inverse of MgfXyz(). For colours outside the gamut of the primaries,
// negative channels become 0.
Rgb MgfRgb(const Vec3& xyz);

// CIE XYZ of the colour with the chromaticity (x, y) and the luminance Y = 1. REQUIRES: y > 0.
Vec3 ChromaticityXyz(double x, double y);

// CIE XYZ, scaled to the luminance 1, of a spectrum. The spectrum has the given values at equal steps of
// wavelength from `low` to `high` [nm], and is linear between these wavelengths. The colour matching
// functions are the fits of Wyman, Sloan and Shirley (2013), whose error is 1 % of their maximum. The result
// is zero if the spectrum has no luminance.
Vec3 SpectrumXyz(double low, double high, std::span<const double> values);

// CIE XYZ, scaled to the luminance 1, of a black body with the given temperature [K].
Vec3 BlackBodyXyz(double temperature);

}  // namespace penumbra
