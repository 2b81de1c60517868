#include "solver/transport/point_irradiance.h"

#include <numeric>
#include <utility>
#include <vector>

#include "solver/transport/gathering.h"
#include "solver/transport/solution.h"

namespace penumbra {

PointIrradiance::PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility)
    : scene_(solution.forest.scene()),
      visibility_(visibility),
      forest_(&solution.forest),
      sources_(SourceSet::FromSolution(solution)),
      leaves_(solution.forest, visibility),
      all_patches_(scene_.patches.size()) {
  std::iota(all_patches_.begin(), all_patches_.end(), 0);
}

PointIrradiance::PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources)
    : scene_(scene),
      visibility_(visibility),
      sources_(std::move(sources)),
      all_patches_(scene.patches.size()) {
  std::iota(all_patches_.begin(), all_patches_.end(), 0);
}

PointIrradianceResult PointIrradiance::OnPatch(PatchId patch, const ReceiverPoint& at) const {
  Gathering gathering(scene_, sources_, at, nullptr, nullptr);
  if (forest_ != nullptr) {
    for (const PatchPair& pair : leaves_.SourcesOf(forest_->LeafAt(patch, at.position)))
      gathering.AddSource(pair.source, leaves_.Blockers(pair), patch);
  } else {
    for (const PatchPair& pair : visibility_.SourcesOf(patch))
      gathering.AddSource(pair.source, visibility_.Blockers(pair), patch);
  }
  return {gathering.irradiance(), gathering.one_sided()};
}

PointIrradianceResult PointIrradiance::Anywhere(const ReceiverPoint& at) const {
  Gathering gathering(scene_, sources_, at, nullptr, nullptr);
  for (const PatchId source : all_patches_) gathering.AddSource(source, all_patches_, kNoPatch);
  return {gathering.irradiance(), gathering.one_sided()};
}

}  // namespace penumbra
