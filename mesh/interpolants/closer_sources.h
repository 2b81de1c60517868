// mesh/interpolants/closer_sources.h
//
// Sources for a point in free space that is closer to a surface than other surfaces are. A leaf sends its
// mean radiosity, which is right for those who see all of the leaf. A point within a few leaf sizes sees a
// part of the leaf. CloserSources divides the leaves near the point into quarters, quarters of quarters, and
// so on, whose radiosities follow from the irradiance that the interpolants show.

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
  // The irradiance that is shown at a point of a patch [W/m^2]; nothing where none is shown.
  using ShownLight = std::function<std::optional<Rgb>(PatchId, const Vec3&)>;

  // `sources` are those of the solution. Parts are divided while the light on them varies so much that the
  // point's irradiance may err by a fraction of `error` because of one part. All arguments must outlive the
  // object.
  CloserSources(const RadiositySolution& solution, const SourceSet& sources, ShownLight light, double error);

  // The patches with leaves near the point, with these leaves divided; nothing if no leaf is near. May be
  // called from any thread.
  std::optional<DividedSources> At(const ReceiverPoint& at) const;

 private:
  bool IsNear(PatchId patch, const Vec3& point) const;

  const Scene& scene_;
  const SourceSet& sources_;
  const ShownLight light_;
  const double tolerance_;
  const Rgb floor_;  // of radiosities to which errors are relative [W/m^2]
};

}  // namespace penumbra
