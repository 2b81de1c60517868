#include "display/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "display/image_difference.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kFlipRowsPerTask = 8;

// Linear sRGB to XYZ (IEC 61966-2-1), a row for X, Y and Z; its rows add up to the white D65.
using Matrix = std::array<Colour, 3>;
constexpr Matrix kXyzFromLinear = {{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}}};

Colour Apply(const Matrix& m, const Colour& v) {
  Colour out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Matrix Inverse(const Matrix& m) {
  Matrix inverse;
  const auto minor_of = [&](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * minor_of(0, 0) + m[0][1] * minor_of(0, 1) + m[0][2] * minor_of(0, 2);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) inverse[c][r] = minor_of(r, c) / determinant;
  return inverse;
}

const Colour& White() {
  static const Colour white = Apply(kXyzFromLinear, {1, 1, 1});
  return white;
}

// XYZ over that of white.
Colour RelativeXyz(const Colour& linear) {
  Colour xyz = Apply(kXyzFromLinear, linear);
  for (std::size_t i = 0; i < 3; ++i) xyz[i] /= White()[i];
  return xyz;
}

// Two Gaussians a sqrt(pi/b) exp(-(pi d)^2 / b) of the distance d in degrees: the contrast sensitivity of one
// channel (section 4.1, table 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivity = {
    {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidest = 0.04;         // the largest b
constexpr double kFeatureWidth = 0.082;  // of edges and points [degrees] (section 4.2)
// How differences become a number in [0, 1] (section 4.1, 4.3).
constexpr double kColourPower = 0.7, kFeaturePower = 0.5, kKnee = 0.4, kKneeValue = 0.95;

// exp(-d^2 s) at the offsets of a radius.
Kernel Gaussian(int radius, double s) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.weight.push_back(static_cast<float>(std::exp(-s * x * x)));
  return kernel;
}

double Sum(const Kernel& kernel) {
  double sum = 0;
  for (const float w : kernel.weight) sum += static_cast<double>(w);
  return sum;
}

void Scale(Kernel& kernel, double factor) {
  for (float& w : kernel.weight) w = static_cast<float>(factor * static_cast<double>(w));
}

// The plane as an eye sees it that is so sensitive.
std::vector<float> FilterBySensitivity(const std::vector<float>& plane, int width, int height,
                                       const Sensitivity& eye, double pixels_per_degree) {
  constexpr double kPi = std::numbers::pi;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return Gaussian(radius, kPi * kPi / (b * pixels_per_degree * pixels_per_degree));
  };
  Kernel first = gaussian(eye.b1), second = gaussian(eye.b2);
  const double sum1 = Sum(first), sum2 = Sum(second);
  const double share1 = eye.a1 * std::sqrt(kPi / eye.b1) * sum1 * sum1,
               share2 = eye.a2 * std::sqrt(kPi / eye.b2) * sum2 * sum2;
  Scale(first, 1 / sum1);
  std::vector<float> seen = Filter(plane, width, height, first, first);
  if (share2 == 0) return seen;
  Scale(second, 1 / sum2);
  const std::vector<float> more = Filter(plane, width, height, second, second);
  const auto part = static_cast<float>(share2 / (share1 + share2));
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += part * (more[i] - seen[i]);
  return seen;
}

struct Seen {
  std::vector<Colour> colour;      // HuntLab() of what is seen
  std::vector<float> edge, point;  // how much of a feature there is
};

// The magnitude of the responses to a feature across and down.
std::vector<float> FeatureStrength(const std::vector<float>& plane, int width, int height,
                                   const Kernel& along, const Kernel& smooth) {
  std::vector<float> x = Filter(plane, width, height, along, smooth);
  const std::vector<float> y = Filter(plane, width, height, smooth, along);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
  return x;
}

// Scales the weights below zero to add up to -1 with the smoothing across, those above to 1.
void Balance(Kernel& along, Kernel& smooth) {
  Scale(smooth, 1 / Sum(smooth));
  double below = 0, above = 0;
  for (const float w : along.weight) (w < 0 ? below : above) += static_cast<double>(w);
  for (float& w : along.weight) w = static_cast<float>(static_cast<double>(w) / (w < 0 ? -below : above));
}

Seen See(const RgbImage& image, double pixels_per_degree) {
  const std::size_t count = image.PixelCount();
  std::array<std::vector<float>, 3> opponent;
  for (auto& plane : opponent) plane.resize(count);
  std::vector<float> achromatic(count);
  const auto width = static_cast<std::size_t>(image.width);
  ParallelFor(static_cast<std::size_t>(image.height), kFlipRowsPerTask, [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      const Colour o = OpponentFromLinear({image.channel[0][i], image.channel[1][i], image.channel[2][i]});
      for (std::size_t c = 0; c < 3; ++c) opponent[c][i] = static_cast<float>(o[c]);
      achromatic[i] = static_cast<float>((o[0] + 16) / 116);
    }
  });

  Seen seen;
  seen.colour.resize(count);
  for (std::size_t c = 0; c < 3; ++c)
    opponent[c] =
        FilterBySensitivity(opponent[c], image.width, image.height, kSensitivity[c], pixels_per_degree);
  ParallelFor(static_cast<std::size_t>(image.height), kFlipRowsPerTask, [&](std::size_t row) {
    for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
      Colour linear = LinearFromOpponent({opponent[0][i], opponent[1][i], opponent[2][i]});
      for (double& value : linear) value = std::clamp(value, 0.0, 1.0);
      seen.colour[i] = HuntLab(linear);
    }
  });

  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const Kernel gaussian = Gaussian(radius, 0.5 / (sigma * sigma));
  Kernel first = gaussian, second = gaussian, smooth = gaussian;
  for (int x = -radius; x <= radius; ++x) {
    const auto i = static_cast<std::size_t>(x + radius);
    first.weight[i] *= static_cast<float>(-x);
    second.weight[i] *= static_cast<float>(x * x / (sigma * sigma) - 1);
  }
  Balance(first, smooth);
  seen.edge = FeatureStrength(achromatic, image.width, image.height, first, smooth);
  smooth = gaussian;
  Balance(second, smooth);
  seen.point = FeatureStrength(achromatic, image.width, image.height, second, smooth);
  return seen;
}

// The largest difference of colours: of green and blue.
double LargestDifference() {
  static const double largest = std::pow(HyAb(HuntLab({0, 1, 0}), HuntLab({0, 0, 1})), kColourPower);
  return largest;
}

// Small differences take most of the range.
double Compress(double difference) {
  const double knee = kKnee * LargestDifference();
  if (difference < knee) return difference * kKneeValue / knee;
  return kKneeValue + (difference - knee) / (LargestDifference() - knee) * (1 - kKneeValue);
}

}  // namespace

double Luminance(const Colour& linear) { return Apply(kXyzFromLinear, linear)[1]; }

Colour OpponentFromLinear(const Colour& linear) {
  const Colour xyz = RelativeXyz(linear);
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Colour LinearFromOpponent(const Colour& opponent) {
  static const Matrix inverse = Inverse(kXyzFromLinear);
  const double y = (opponent[0] + 16) / 116;
  Colour xyz = {y + opponent[1] / 500, y, y - opponent[2] / 200};
  for (std::size_t i = 0; i < 3; ++i) xyz[i] *= White()[i];
  return Apply(inverse, xyz);
}

Colour HuntLab(const Colour& linear) {
  constexpr double kLinearBelow = 6.0 / 29;
  Colour f = RelativeXyz(linear);
  for (double& value : f)
    value = value > kLinearBelow * kLinearBelow * kLinearBelow
                ? std::cbrt(value)
                : value / (3 * kLinearBelow * kLinearBelow) + 4.0 / 29;
  const double l = 116 * f[1] - 16;
  return {l, 0.01 * l * 500 * (f[0] - f[1]), 0.01 * l * 200 * (f[1] - f[2])};
}

double HyAb(const Colour& a, const Colour& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

std::vector<float> Filter(const std::vector<float>& plane, int width, int height, const Kernel& across,
                          const Kernel& down) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<float> middle(plane.size(), 0.0F), out(plane.size(), 0.0F);
  const int reach = across.radius();
  ParallelFor(rows, kFlipRowsPerTask, [&](std::size_t y) {
    // The row with its ends drawn out, so that the loop below meets no border.
    std::vector<float> row(columns + 2 * static_cast<std::size_t>(reach));
    for (std::size_t x = 0; x < row.size(); ++x)
      row[x] = plane[y * columns +
                     static_cast<std::size_t>(std::clamp(static_cast<int>(x) - reach, 0, width - 1))];
    for (std::size_t k = 0; k < across.weight.size(); ++k)
      for (std::size_t x = 0; x < columns; ++x) middle[y * columns + x] += across.weight[k] * row[x + k];
  });
  ParallelFor(rows, kFlipRowsPerTask, [&](std::size_t y) {
    for (int k = -down.radius(); k <= down.radius(); ++k) {
      const auto from = static_cast<std::size_t>(std::clamp(static_cast<int>(y) + k, 0, height - 1));
      const float weight = down.weight[static_cast<std::size_t>(k + down.radius())];
      for (std::size_t x = 0; x < columns; ++x) out[y * columns + x] += weight * middle[from * columns + x];
    }
  });
  return out;
}

std::vector<float> FlipOfExposed(const RgbImage& a, const RgbImage& b, double pixels_per_degree) {
  PENUMBRA_CHECK(a.width == b.width && a.height == b.height);
  const Seen first = See(a, pixels_per_degree), second = See(b, pixels_per_degree);
  std::vector<float> map(a.PixelCount());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double colour = Compress(std::pow(HyAb(first.colour[i], second.colour[i]), kColourPower));
    const double feature = static_cast<double>(
        std::max(std::abs(first.edge[i] - second.edge[i]), std::abs(first.point[i] - second.point[i])));
    const double sharpened = std::pow(std::min(1.0, feature / std::numbers::sqrt2), kFeaturePower);
    map[i] = static_cast<float>(std::clamp(std::pow(colour, 1 - sharpened), 0.0, 1.0));
    if (colour == 0 && feature == 0) map[i] = 0;
  }
  return map;
}

}  // namespace penumbra
