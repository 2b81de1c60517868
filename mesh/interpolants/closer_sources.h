// mesh/interpolants/closer_sources.h
//
// Light sources for a point in free space, which may be closer to a quadtree leaf of the solution than any
// other surface is. In the radiosity solution, a quadtree leaf sends its mean radiosity, which is right for
// receivers that see the whole leaf. A point within a distance of a few leaf sizes may see only a part of the
// leaf. CloserSources divides the leaves near the point into quarters, quarters of quarters, and so on. The
// radiosities of the parts of a leaf are computed from the displayed irradiance (interpolants of the mesh).

#pragma once

#include <functional>
#include <optional>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

class CloserSources {
 public:
  // A function that returns the displayed irradiance at a point of a patch [W/m^2], or nullopt where no
  // irradiance is displayed.
  using ShownLight = std::function<std::optional<Rgb>(PatchId, const Vec3&)>;

  // `sources` are the light sources of the solution. A part of a leaf is divided while the light on the part
  // varies so much that the point's irradiance may err by more than a fixed fraction of `error` because of
  // this part. All constructor arguments must outlive the CloserSources.
  CloserSources(const RadiositySolution& solution, const SourceSet& sources, ShownLight light, double error);

  // Returns the patches that have leaves near the point, with these leaves divided into smaller light
  // sources; nullopt if no leaf is near the point. At() may be called from several threads at once.
  std::optional<DividedSources> At(const ReceiverPoint& at) const;

 private:
  bool IsNear(PatchId patch, const Vec3& point) const;

  const Scene& scene_;
  const SourceSet& sources_;
  const ShownLight light_;
  const double tolerance_;
  const Rgb floor_;  // errors of radiosity are relative to max(radiosity, floor_) [W/m^2]
};

}  // namespace penumbra
