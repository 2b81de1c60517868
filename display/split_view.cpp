#include "display/split_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "display/false_colour.h"
#include "display/glm_conversion.h"
#include "display/unit_vectors.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr std::uint8_t kNothing = 24;  // grey where no triangle is

// Copies `part` to (left, top) as far as it fits.
void Place(const Srgb8Image& part, int left, int top, Srgb8Image* whole) {
  const int columns = std::min(part.width, whole->width - left);
  if (columns <= 0) return;
  for (int y = 0; y < part.height && top + y < whole->height; ++y) {
    const auto from = part.pixels.begin() + 3 * static_cast<std::ptrdiff_t>(y) * part.width;
    const auto to = whole->pixels.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * whole->width + left);
    std::copy_n(from, 3 * static_cast<std::ptrdiff_t>(columns), to);
  }
}

std::uint8_t GreyCode(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

// 1 / depth of each pixel [1/m], 0 where there is nothing.
std::vector<double> InverseDepths(const RenderedFrame& frame, const PixelRays& rays,
                                  const IrradianceMesh& mesh) {
  glm::dvec3 axis = StableNormalized(glm::cross(rays.dx, rays.dy));
  if (glm::dot(axis, rays.corner) < 0) axis = -axis;
  std::vector<double> inverse(frame.triangle.size(), 0.0);
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    if (frame.triangle[i] == kNoTriangle) continue;
    const auto& [a, b, c] = mesh.triangles[frame.triangle[i]].vertex;
    const double s = static_cast<double>(frame.s[i]), t = static_cast<double>(frame.t[i]);
    const Vec3 p = (1 - s - t) * mesh.positions[a] + s * mesh.positions[b] + t * mesh.positions[c];
    const double depth = glm::dot(axis, ToGlm(p) - rays.eye);
    if (depth > 0) inverse[i] = 1 / depth;
  }
  return inverse;
}

}  // namespace

void PaintSplit(const RenderedFrame& frame, const PixelRays& rays, const IrradianceMesh& mesh,
                const Srgb8Image& picture, Srgb8Image* whole) {
  const int w = QuarterSide(whole->width), h = QuarterSide(whole->height);
  PENUMBRA_CHECK(frame.width == w && frame.height == h && picture.width == w && picture.height == h);
  Srgb8Image ids, coordinates, depths;
  for (Srgb8Image* image : {&ids, &coordinates, &depths}) {
    image->Resize(w, h);
    std::fill(image->pixels.begin(), image->pixels.end(), kNothing);
  }
  const std::vector<double> inverse = InverseDepths(frame, rays, mesh);
  const double nearest = inverse.empty() ? 0 : *std::max_element(inverse.begin(), inverse.end());
  for (std::size_t i = 0; i < inverse.size(); ++i) {
    if (frame.triangle[i] == kNoTriangle) continue;
    const double s = static_cast<double>(frame.s[i]), t = static_cast<double>(frame.t[i]);
    SetPixel(&ids, i, ColourOfNumber(frame.triangle[i]));
    SetPixel(&coordinates, i, {GreyCode(s), GreyCode(t), GreyCode(1 - s - t)});
    const std::uint8_t grey = GreyCode(nearest > 0 ? inverse[i] / nearest : 0.0);
    SetPixel(&depths, i, {grey, grey, grey});
  }
  std::fill(whole->pixels.begin(), whole->pixels.end(), std::uint8_t{0});
  Place(ids, 0, 0, whole);
  Place(coordinates, whole->width - w, 0, whole);
  Place(depths, 0, whole->height - h, whole);
  Place(picture, whole->width - w, whole->height - h, whole);
}

}  // namespace penumbra
