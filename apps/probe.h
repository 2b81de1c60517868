// apps/probe.h
//
// Measurements at points of the user's choice: where they lie, and whether light can get there at all.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/points_csv.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

// How near a point must lie to a patch to lie on it, relative to the scene's diagonal, and how far its normal
// may be off [degrees].
inline constexpr double kOnPatchDistance = 1e-6;
inline constexpr double kOnPatchDegrees = 1;

// Points that are farther from the box around the scene than so many of its diagonals are far outside: what
// is in centimetres or feet is, where the scene is in metres.
inline constexpr double kFarDiagonals = 10;

// The front that a point lies on.
struct Footing {
  std::int32_t face = -1;  // as users count; -1: none
  PatchId patch = kNoPatch;
};

enum class Surroundings {
  kOpen,
  kBehind,      // inside a solid, or behind faces: only backs are in sight
  kZeroNormal,  // no direction to measure in
  kFar,         // so far from the scene that it may be in another unit
};

struct Measurement {
  ProbePoint point;
  Footing footing;
  Rgb exact = Rgb::Zero();   // [W/m^2]; nan where the normal is zero
  Rgb direct = Rgb::Zero();  // the share in it of what surfaces emit of themselves, if asked for
  IrradianceGradient gradient = IrradianceGradient::Zero();  // of `exact`, if asked for [W/m^3]
  Rgb interpolated = Rgb::Zero();  // [W/m^2]; nan off the fronts, and where nothing was solved
  Surroundings surroundings = Surroundings::kOpen;
  bool sound = true;  // no value is infinite, and only those that are said to be are nan
};

class Prober {
 public:
  // Without a pipeline nothing is interpolated. With `parts` direct light and gradients are measured, too.
  // Everything referred to must outlive this object.
  Prober(const Scene& scene, const PointIrradiance& irradiance, const Pipeline* pipeline, bool parts);

  // Measures at all points, in parallel; the same for any number of threads. What is left of the results
  // after a cancelled context is unspecified.
  std::vector<Measurement> Measure(const std::vector<ProbePoint>& points,
                                   const ExecutionContext& context) const;

  // The front within reach of the point whose face has the lowest index; `normal` is unit.
  Footing FindFooting(const Vec3& position, const Vec3& normal) const;

 private:
  // The point itself, or its foot on the patch, which digits may have left behind the front.
  ReceiverPoint StandOn(PatchId patch, const Vec3& position, const Vec3& normal) const;
  Measurement MeasureAt(const ProbePoint& point) const;
  bool IsFar(const Vec3& position) const;
  bool SeesOnlyBacks(const Vec3& position, const Vec3& normal) const;

  const Scene& scene_;
  const PointIrradiance& irradiance_;
  const Pipeline* pipeline_;
  bool parts_;
  RayCaster rays_;
  double reach_;     // [m]
  Vec3 low_, high_;  // of the box around the scene [m]
};

// The measurements as CSV, a row each, all digits; with `parts`, the direct light and the gradient as well.
std::string MeasurementsCsv(const std::vector<Measurement>& measurements, bool parts);

// Throws InputError if a value is no number where it should be.
void CheckMeasurements(const std::vector<Measurement>& measurements);

// One line that names the rows, counted from 1, where no light can be expected; empty if there are none.
std::string SurroundingsWarning(const std::vector<Measurement>& measurements);

}  // namespace penumbra
