// apps/probe.h
//
// Measures irradiance at points that the user gives, finds the faces on which the points lie, and detects
// points that no light can reach.

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
  kBehind,      // point inside a solid or behind faces, which sees only backs
  kZeroNormal,  // point whose normal is zero, so that irradiance is undefined
  kFar,         // point so far from the scene that its unit of length may be wrong
};

struct Measurement {
  ProbePoint point;
  PointFace footing;
  Rgb exact = Rgb::Zero();   // exact irradiance [W/m^2]; nan if the normal is zero
  Rgb direct = Rgb::Zero();  // if requested, the part of `exact` directly from emitters [W/m^2]
  IrradianceGradient gradient = IrradianceGradient::Zero();  // if requested, the gradient of `exact` [W/m^3]
  // interpolated irradiance [W/m^2]; nan if there is no solution, or if the point lies on no front
  Rgb interpolated = Rgb::Zero();
  PointPlace place = PointPlace::kOpen;
  bool sound = true;  // true if no value is infinite, and values are nan only where documented
};

class Prober {
 public:
  // If `pipeline` is null, Measurement::interpolated is nan. If `parts` is true, direct light and gradients
  // are measured in addition to irradiance. All arguments must outlive the Prober.
  Prober(const Scene& scene, const PointIrradiance& irradiance, const Pipeline* pipeline, bool parts);

  // Measures the irradiance at all points, in parallel. The measured values do not depend on the number of
  // threads. If the context is cancelled, the result is unspecified.
  std::vector<Measurement> Measure(const std::vector<ProbePoint>& points,
                                   const ExecutionContext& context) const;

 private:
  // The receiver point at which irradiance is computed for a position that the user gave. A position on a
  // patch is projected onto the plane of the patch, because with rounded coordinates the position may lie
  // behind the front.
  ReceiverPoint ReceiverPointAt(PatchId patch, const Vec3& position, const Vec3& normal) const;
  Measurement MeasureAt(const ProbePoint& point) const;

  const Scene& scene_;
  const PointIrradiance& irradiance_;
  const Pipeline* pipeline_;
  bool parts_;
  Surroundings surroundings_;
  double reach_;  // largest distance from a patch at which a point counts as lying on the patch [m]
};

struct ProbeColumns {
  bool parts = false;  // if true, direct light and gradients have columns in addition to irradiance
  LightUnit unit = LightUnit::kWatts;
};

// The measurements as CSV, with one row for each point and all digits. In the CSV, a value in W/m^2 has three
// columns, a value in lux one column.
std::string MeasurementsCsv(const std::vector<Measurement>& measurements, const ProbeColumns& columns);

// Throws InputError if Measurement::sound is false for some measurement, that is, if a value is infinite or
// unexpectedly nan.
void CheckMeasurements(const std::vector<Measurement>& measurements);

// A one-line warning that lists the row numbers, counted from 1, of points that no light can reach; the
// warning is empty if light can reach all points.
std::string SurroundingsWarning(const std::vector<Measurement>& measurements);

}  // namespace penumbra
