#include "mesh/leaf_light.h"

#include <array>
#include <limits>

#include "solver/geometry/polygon.h"

namespace penumbra {

Rgb LeafLight::At(ElementId leaf, const Vec3& place) {
  const Element& element = forest_[leaf];
  const Vec3& normal = forest_.scene().patches[static_cast<std::size_t>(element.patch)].normal;
  // The triangle, of those that the quarters fall into, in which the place lies deepest, or least far
  // outside.
  std::array<Vec3, 3> around;
  Vec3 weights = Vec3::Constant(-std::numeric_limits<double>::infinity());
  for (const std::array<Vec3, 4>& quarter : Quarters(element))
    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(element.size); ++k) {
      const Vec3 a = quarter[0] - place, b = quarter[k] - place, c = quarter[k + 1] - place;
      const Vec3 areas(normal.dot(b.cross(c)), normal.dot(c.cross(a)), normal.dot(a.cross(b)));
      const Vec3 barycentric = areas / areas.sum();
      if (barycentric.minCoeff() <= weights.minCoeff()) continue;
      weights = barycentric;
      around = {quarter[0], quarter[k], quarter[k + 1]};
    }
  weights = weights.cwiseMax(0);
  Rgb light = Rgb::Zero();
  for (int k = 0; k < 3; ++k) light += weights[k] / weights.sum() * Sample(element, around[k]);
  return light;
}

Rgb LeafLight::Sample(const Element& leaf, const Vec3& point) {
  ReceiverPoint at;
  at.position = point;
  at.normal = forest_.scene().patches[static_cast<std::size_t>(leaf.patch)].normal;
  at.approach = Centroid(leaf.Vertices()) - point;
  if (const PointIrradianceResult* known = samples_.Find(leaf.patch, at)) return known->irradiance;
  const PointIrradianceResult sample = sampler_(leaf.patch, at);
  samples_.Insert(leaf.patch, at, sample);
  return sample.irradiance;
}

}  // namespace penumbra
