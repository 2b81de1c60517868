#include "solver/scene/mgf_colour.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace penumbra {
namespace {

// Chromaticities of MGF's monitor: red, green, blue, and its white of equal energy.
constexpr std::array<std::array<double, 2>, 3> kPrimaries = {
    {{0.640, 0.330}, {0.290, 0.600}, {0.150, 0.060}}};
constexpr double kEqualEnergy = 1.0 / 3;
// What the conversion to chromaticities and back leaves of a channel that was zero, relative to the largest
// one.
constexpr double kColourRounding = 1e-12;

Eigen::Matrix3d RgbToXyz() {
  Eigen::Matrix3d primaries;
  for (int c = 0; c < 3; ++c) {
    const auto& [x, y] = kPrimaries[static_cast<std::size_t>(c)];
    primaries.col(c) = ChromaticityXyz(x, y);
  }
  // Scaled so that equal amounts of all three are white.
  const Vec3 amounts = primaries.inverse() * ChromaticityXyz(kEqualEnergy, kEqualEnergy);
  return primaries * amounts.asDiagonal();
}

const Eigen::Matrix3d& XyzMatrix() {
  static const Eigen::Matrix3d matrix = RgbToXyz();
  return matrix;
}

// A bell curve with different widths on either side [nm].
double Lobe(double wavelength, double centre, double below, double above) {
  const double t = (wavelength - centre) / (wavelength < centre ? below : above);
  return std::exp(-0.5 * t * t);
}

Vec3 MatchingFunctions(double wavelength) {
  const double w = wavelength;
  return {1.056 * Lobe(w, 599.8, 37.9, 31.0) + 0.362 * Lobe(w, 442.0, 16.0, 26.7) -
              0.065 * Lobe(w, 501.1, 20.4, 26.2),
          0.821 * Lobe(w, 568.8, 46.9, 40.5) + 0.286 * Lobe(w, 530.9, 16.3, 31.1),
          1.217 * Lobe(w, 437.0, 11.8, 36.0) + 0.681 * Lobe(w, 459.0, 26.0, 13.8)};
}

constexpr double kFirstVisible = 380, kLastVisible = 780;  // [nm]

}  // namespace

Vec3 ChromaticityXyz(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Vec3 MgfXyz(const Rgb& rgb) { return XyzMatrix() * rgb.matrix(); }

Rgb MgfRgb(const Vec3& xyz) {
  static const Eigen::Matrix3d inverse = XyzMatrix().inverse();
  const Rgb rgb = (inverse * xyz).array();
  const double least = kColourRounding * rgb.maxCoeff();
  return (rgb > least).select(rgb, 0.0);
}

Vec3 SpectrumXyz(double low, double high, std::span<const double> values) {
  if (values.empty() || !(high > low)) return Vec3::Zero();
  const double last = static_cast<double>(values.size() - 1),
               step = last > 0 ? (high - low) / last : high - low;
  const auto value_at = [&](double wavelength) {
    const double at = std::clamp((wavelength - low) / step, 0.0, last);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double share = at - static_cast<double>(below);
    return (1 - share) * values[below] + share * values[above];
  };
  Vec3 sum = Vec3::Zero();
  for (double w = std::max(std::ceil(low), kFirstVisible); w <= std::min(high, kLastVisible); ++w)
    sum += value_at(w) * MatchingFunctions(w);
  return sum.y() > 0 ? Vec3(sum / sum.y()) : Vec3::Zero();
}

Vec3 BlackBodyXyz(double temperature) {
  constexpr double kSecondConstant = 1.438776877e7;  // of Planck's law, hc/k [nm K]
  std::vector<double> values;
  for (double w = kFirstVisible; w <= kLastVisible; ++w)
    values.push_back(std::pow(w / kFirstVisible, -5) / std::expm1(kSecondConstant / (w * temperature)));
  return SpectrumXyz(kFirstVisible, kLastVisible, values);
}

}  // namespace penumbra
