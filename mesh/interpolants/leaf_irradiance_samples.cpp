#include "mesh/interpolants/leaf_irradiance_samples.h"

#include <array>
#include <limits>

#include "solver/geometry/polygon.h"

namespace penumbra {

LeafIrradianceSamples::LeafIrradianceSamples(const ElementForest& forest, PatchId patch,
                                             const IrradianceSampler& sampler, const SampleCache* known)
    : forest_(forest),
      id_(patch),
      patch_(forest.scene().patches[static_cast<std::size_t>(patch)]),
      sampler_(sampler),
      uncertainty_(SampleUncertainty(forest.scene(), patch_)),
      known_(known) {}

Rgb LeafIrradianceSamples::At(ElementId leaf, const Vec3& place) {
  const Element& element = forest_[leaf];
  // Of the triangles into which the quarters are divided, the triangle with the largest minimum barycentric
  // coordinate of the place.
  std::array<Vec3, 3> around;
  Vec3 weights = Vec3::Constant(-std::numeric_limits<double>::infinity());
  for (const std::array<Vec3, 4>& quarter : Quarters(element))
    for (std::size_t k = 1; k + 1 < static_cast<std::size_t>(element.size); ++k) {
      const Vec3 a = quarter[0] - place, b = quarter[k] - place, c = quarter[k + 1] - place;
      const Vec3 areas(patch_.normal.dot(b.cross(c)), patch_.normal.dot(c.cross(a)),
                       patch_.normal.dot(a.cross(b)));
      if (!(areas.sum() > 0)) continue;  // a leaf as narrow as rounding errors
      const Vec3 barycentric = areas / areas.sum();
      if (barycentric.minCoeff() <= weights.minCoeff()) continue;
      weights = barycentric;
      around = {quarter[0], quarter[k], quarter[k + 1]};
    }
  weights = weights.cwiseMax(0);
  if (!(weights.sum() > 0)) return Sample(element, place);
  Rgb light = Rgb::Zero();
  for (int k = 0; k < 3; ++k) light += weights[k] / weights.sum() * Sample(element, around[k]);
  return light;
}

Rgb LeafIrradianceSamples::Sample(const Element& leaf, const Vec3& point) {
  ReceiverPoint at;
  at.position = point;
  at.normal = patch_.normal;
  at.approach = Centroid(leaf.Vertices()) - point;
  at.uncertainty = uncertainty_;
  if (known_ != nullptr)
    if (const PointIrradianceResult* sample = known_->Find(id_, at)) return sample->irradiance;
  if (const PointIrradianceResult* sample = samples_.Find(id_, at)) return sample->irradiance;
  const PointIrradianceResult sample = sampler_(id_, at);
  samples_.Insert(id_, at, sample);
  return sample.irradiance;
}

}  // namespace penumbra
