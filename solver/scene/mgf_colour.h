// solver/scene/mgf_colour.h
//
// Colours of the Materials and Geometry Format: CIE chromaticities, spectra and colour temperatures, and
// their conversion from and to red, green and blue by the primaries of MGF's own conversion.

#pragma once

#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// CIE XYZ of a colour.
Vec3 MgfXyz(const Rgb& rgb);
// The inverse of MgfXyz(). Colours outside the range of the primaries lose what is negative.
Rgb MgfRgb(const Vec3& xyz);

// XYZ of the chromaticity (x, y) with luminance Y = 1. REQUIRES: y > 0.
Vec3 ChromaticityXyz(double x, double y);

// XYZ, with luminance 1, of a spectrum given at equal steps of wavelength from `low` to `high` [nm], and
// linear between them. The colour matching functions are the fits of Wyman, Sloan and Shirley (2013), which
// are off by 1 % of their maximum. Zero if the spectrum has no luminance.
Vec3 SpectrumXyz(double low, double high, std::span<const double> values);

// XYZ, with luminance 1, of a black body of this temperature [K].
Vec3 BlackBodyXyz(double temperature);

}  // namespace penumbra
