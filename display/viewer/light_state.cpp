#include "display/viewer/snapshot.h"

namespace penumbra::viewer {

std::shared_ptr<const ReconstructedLight> LightState::Reconstructed(Reconstruction kind,
                                                                    const ExecutionContext& context) const {
  const std::lock_guard lock(reconstructing_);
  std::shared_ptr<const ReconstructedLight>& light = reconstructed_[kind];
  if (light) return light;
  const auto exact = [this]() -> const PointIrradiance& { return Exact(); };
  auto made = std::make_shared<const ReconstructedLight>(ReconstructLight(kind, solution_, exact, context));
  if (!context.Cancelled()) light = std::move(made);
  return light;
}

}  // namespace penumbra::viewer
