// apps/probe.h
//
// Measures irradiance at the user's points, finds the faces on which they lie, and detects points that no
// light can reach.

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

// A point lies on a patch if its distance is at most kOnPatchDistance times the scene's diagonal, and its
// normal deviates by at most kOnPatchDegrees degrees.
inline constexpr double kOnPatchDistance = 1e-6;
inline constexpr double kOnPatchDegrees = 1;

// A point is far outside if its distance from the scene's bounding box exceeds kFarDiagonals * (diagonal of
// the box). For example, points that the user gave in centimetres are far outside a scene in metres.
inline constexpr double kFarDiagonals = 10;

// The face and the patch on whose front a point lies.
struct PointFace {
  std::int32_t face = -1;  // its number in outputs; -1: none
  PatchId patch = kNoPatch;
};

enum class Surroundings {
  kOpen,
  kBehind,      // inside a solid, or behind faces: sees only backs
  kZeroNormal,  // no direction to measure in
  kFar,         // so far from the scene that its unit may be wrong
};

struct Measurement {
  ProbePoint point;
  PointFace footing;
  Rgb exact = Rgb::Zero();   // [W/m^2]; nan if the normal is zero
  Rgb direct = Rgb::Zero();  // directly from emitters, part of `exact`; if requested [W/m^2]
  IrradianceGradient gradient = IrradianceGradient::Zero();  // of `exact`; if requested [W/m^3]
  Rgb interpolated = Rgb::Zero();                            // [W/m^2]; nan if not on a front, or not solved
  Surroundings surroundings = Surroundings::kOpen;
  bool sound = true;  // no value is infinite, and values are nan only as described above
};

class Prober {
 public:
  // If `pipeline` is null, Measurement::interpolated is nan. If `parts` is true, direct light and gradients
  // are measured, too. All arguments must outlive this object.
  Prober(const Scene& scene, const PointIrradiance& irradiance, const Pipeline* pipeline, bool parts);

  // Measures the irradiance at all points, in parallel. The result does not depend on the number of threads.
  // If the context is cancelled, the result is unspecified.
  std::vector<Measurement> Measure(const std::vector<ProbePoint>& points,
                                   const ExecutionContext& context) const;

  // Finds the face on whose front the point lies; if the point lies on several fronts, the face with the
  // lowest index. `normal` is a unit vector.
  PointFace FindFooting(const Vec3& position, const Vec3& normal) const;

 private:
  // The receiver point for a position. If the position lies on a patch, it is projected onto the plane of the
  // patch, because rounded coordinates may lie behind the front.
  ReceiverPoint ReceiverPointAt(PatchId patch, const Vec3& position, const Vec3& normal) const;
  Measurement MeasureAt(const ProbePoint& point) const;
  bool IsFar(const Vec3& position) const;
  bool SeesOnlyBacks(const Vec3& position, const Vec3& normal) const;

  const Scene& scene_;
  const PointIrradiance& irradiance_;
  const Pipeline* pipeline_;
  bool parts_;
  RayCaster rays_;
  double reach_;     // [m]
  Vec3 low_, high_;  // of the scene's bounding box [m]
};

// The measurements as CSV, one row for each, with all digits. If `parts` is true, rows include direct light
// and gradients.
std::string MeasurementsCsv(const std::vector<Measurement>& measurements, bool parts);

// Throws InputError if a measurement is not sound (Measurement::sound).
void CheckMeasurements(const std::vector<Measurement>& measurements);

// A one-line warning that lists the row numbers, counted from 1, of points that no light can reach; empty if
// there are no such points.
std::string SurroundingsWarning(const std::vector<Measurement>& measurements);

}  // namespace penumbra
