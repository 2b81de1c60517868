#include "solver/visibility/point/sampled_visibility.h"

#include <algorithm>

#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

bool Holds(const Cone& cone, const Vec3& direction) {
  return cone.size > 0 && std::all_of(cone.normal.begin(), cone.normal.begin() + cone.size,
                                      [&](const Vec3& normal) { return normal.dot(direction) >= 0; });
}

}  // namespace

double SampledVisibility::VisibleFormFactor(const DirectionPolygon& source,
                                            std::span<const Occluder> occluders, const Vec3& normal) const {
  double sum = 0;
  // Cuts the source into quadrilaterals about its first vertex. The last may be a triangle, in which two
  // corners coincide.
  for (int i = 2; i < source.size(); i += 2) {
    const Vec3 &p00 = source[0], &p10 = source[i - 1], &p11 = source[i],
               &p01 = source[std::min(i + 1, source.size() - 1)];
    const auto at = [&](double s, double t) -> Vec3 {
      return (1 - s) * (1 - t) * p00 + s * (1 - t) * p10 + s * t * p11 + (1 - s) * t * p01;
    };
    const double step = 1.0 / divisions_;
    for (int k = 0; k < divisions_; ++k)
      for (int m = 0; m < divisions_; ++m) {
        const Vec3 middle = at((k + 0.5) * step, (m + 0.5) * step);
        if (std::any_of(occluders.begin(), occluders.end(),
                        [&](const Occluder& occluder) { return Holds(*occluder.cone, middle); }))
          continue;
        DirectionPolygon part;
        part.Add(at(k * step, m * step));
        part.Add(at((k + 1) * step, m * step));
        part.Add(at((k + 1) * step, (m + 1) * step));
        part.Add(at(k * step, (m + 1) * step));
        sum += FormFactor(part, normal);
      }
  }
  return sum;
}

OcclusionRegistry::Method SampledVisibilityMethod() {
  return {"sampled",
          "counts the parts of the source whose middle is visible, which the thesis gave up (chapter 6)",
          {},
          [](const OcclusionOptions&) { return std::make_unique<const SampledVisibility>(); }};
}

}  // namespace penumbra
