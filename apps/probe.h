// apps/probe.h
//
// Measures irradiance at the user's points, finds the faces on which they lie, and detects points that no
// light can reach.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/points_csv.h"
#include "apps/surroundings.h"
#include "display/photometry.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/progress.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

enum class PointPlace {
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
  PointPlace place = PointPlace::kOpen;
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

 private:
  // The receiver point for a position. If the position lies on a patch, it is projected onto the plane of the
  // patch, because rounded coordinates may lie behind the front.
  ReceiverPoint ReceiverPointAt(PatchId patch, const Vec3& position, const Vec3& normal) const;
  Measurement MeasureAt(const ProbePoint& point) const;

  const Scene& scene_;
  const PointIrradiance& irradiance_;
  const Pipeline* pipeline_;
  bool parts_;
  Surroundings surroundings_;
  double reach_;  // [m]
};

struct ProbeColumns {
  bool parts = false;  // direct light and gradients, too
  LightUnit unit = LightUnit::kWatts;
};

// The measurements as CSV, one row for each, with all digits: three columns for each value in W/m^2, or one
// in lux.
std::string MeasurementsCsv(const std::vector<Measurement>& measurements, const ProbeColumns& columns);

// Throws InputError if a measurement is not sound (Measurement::sound).
void CheckMeasurements(const std::vector<Measurement>& measurements);

// A one-line warning that lists the row numbers, counted from 1, of points that no light can reach; empty if
// there are no such points.
std::string SurroundingsWarning(const std::vector<Measurement>& measurements);

}  // namespace penumbra
