// mesh/interpolants/representation_error.h
//
// The error of what is shown: interpolants against the irradiance itself, at points that the construction
// never used.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "solver/scene/scene.h"
#include "solver/scene/surface_points.h"

namespace penumbra {

// Of the mean irradiance of a channel: errors where it is darker are relative to this.
inline constexpr double kErrorFloor = 0.01;

// No part of the scene may err by more than so many times the error asked for, at its 99th percentile.
inline constexpr double kPartError = 2;

// Statistics over points and channels of |shown - true| / max(true, 1 % of that channel's mean irradiance).
struct RepresentationError {
  std::size_t points = 0;
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  // What the 99th percentile of all points may well be: a standard deviation more of the points lie above, or
  // one point and a standard deviation fewer.
  double p99_at_most = 0, p99_at_least = 0;
  std::int32_t worst_face = -1;     // where the largest error was seen, as users count faces
  Vec3 worst_point = Vec3::Zero();  // [m]
};

// Light that is less than this is none, 1e-10 of what the strongest emitter sends out [W/m^2]: faces that lie
// in one plane, but for the six decimals of their file, bend by 1e-6 and see some 1e-12 of each other.
Rgb NoLight(const Scene& scene);

// Point by point, the channels of a point in turn. The means are those of `truth`; where they are less than
// `least`, that counts.
std::vector<double> RelativeErrors(std::span<const Rgb> shown, std::span<const Rgb> truth,
                                   const Rgb& least = Rgb::Zero());

// The value that the fraction q of them does not pass. REQUIRES: some.
double Quantile(std::vector<double> values, double q);

// The error of one channel at one point.
struct ValueError {
  double error = 0;
  std::size_t point = 0;
};

// The same errors without those of channels that the surface of a point does not reflect
// (ReflectingChannels).
std::vector<ValueError> SeenErrors(const Scene& scene, std::span<const SurfacePoint> at,
                                   std::span<const Rgb> shown, std::span<const Rgb> truth);
// 0 without values.
double Quantile(std::span<const ValueError> values, double q);

// How one part of the scene (PartsOf) does.
struct PartError {
  std::string name;
  std::size_t part = 0;  // of PartsOf()
  RepresentationError whole;
};

struct MeasuredError {
  RepresentationError interpolant;  // of the interpolants, against exact irradiance under the same sources
  RepresentationError
      sources;  // of that, against exact irradiance under better sources, whichever differs more
  RepresentationError whole;       // of the interpolants, against the latter
  double above = 0;                // the share of the latter's values that are above `bound`
  std::vector<PartError> by_part;  // of the latter: parts that are seen
};

// At which points errors are measured.
struct ErrorMeasurement {
  std::size_t points = 0;
  std::uint64_t seed = 0;
  double bound = 0;  // of errors: MeasuredError::above counts what is above it
};

// Measures at so many random points that spread evenly by area over the fronts that are seen
// (ReflectingAreas), and at further ones in each part of the scene, so that no large one speaks for a small
// one. The same seed gives the same points. Points are offset from all interpolation nodes with probability
// one. Without `better` sources the others are left empty.
MeasuredError MeasureError(const Scene& scene, const IrradianceMesh& mesh, const IrradianceSampler& sampler,
                           std::span<const IrradianceSampler> better, const ErrorMeasurement& measurement);

// The first of these.
RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed);

}  // namespace penumbra
