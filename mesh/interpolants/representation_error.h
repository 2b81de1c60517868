// mesh/interpolants/representation_error.h
//
// The error of the displayed irradiance: interpolants are compared with the exact irradiance, at points other
// than the interpolation nodes.

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
#include "solver/transport/sources/error_floors.h"

namespace penumbra {

// In each part of the scene, for example an object, the 99th percentile of the relative errors must be at
// most kPartError * (requested error).
inline constexpr double kPartError = 2;

// Statistics of the relative error |shown - true| / max(true, kErrorFloor * mean irradiance of the channel)
// of displayed irradiance, over points and channels.
struct RepresentationError {
  std::size_t points = 0;
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  // Likely bounds of the true 99th percentile are the quantiles 0.99 + sigma and 0.99 - sigma - 1 / points of
  // the measured errors, where sigma = sqrt(0.99 * 0.01 / points). The standard deviation sigma is that of
  // the fraction of points whose error exceeds the true 99th percentile.
  double p99_at_most = 0, p99_at_least = 0;
  // The index of the face with the largest error, in the order of the scene file.
  std::int32_t worst_face = -1;
  Vec3 worst_point = Vec3::Zero();  // the position of the point with the largest error [m]
};

// Irradiance of at most 1e-10 * (largest emittance) counts as zero [W/m^2]. Coplanar faces whose vertices are
// rounded to six decimals in a file deviate by angles of 1e-6, and the form factors between such faces are
// about 1e-12.
Rgb NoLight(const Scene& scene);

// Returns the relative errors of all channels: entry 3 i + c is the error of channel c at point i. A relative
// error is |shown - true| / max(true, floor), where floor = max(kErrorFloor * the channel's mean over
// `truth`, `least`).
std::vector<double> RelativeErrors(std::span<const Rgb> shown, std::span<const Rgb> truth,
                                   const Rgb& least = Rgb::Zero());

// Returns the q-quantile: the smallest entry v of `values` such that at least a fraction q of the entries is
// <= v. REQUIRES: `values` is not empty.
double Quantile(std::vector<double> values, double q);

// The relative error of one channel at one point.
struct ValueError {
  double error = 0;
  std::size_t point = 0;
};

// Like RelativeErrors(), but omits at each point the channels that the surface does not reflect
// (ReflectingChannels).
std::vector<ValueError> SeenErrors(const Scene& scene, std::span<const SurfacePoint> at,
                                   std::span<const Rgb> shown, std::span<const Rgb> truth);
// Returns the q-quantile of ValueError::error, or 0 if `values` is empty.
double Quantile(std::span<const ValueError> values, double q);

// The smallest number of random points whose errors give a reliable 99th percentile for a part of the scene.
// With fewer than kPointsToTellAPart points, a high percentile may be an accident.
inline constexpr std::size_t kPointsToTellAPart = 300;

// The error in one part of the scene, for example an object (PartsOf).
struct PartError {
  std::string name;
  std::size_t part = 0;  // the index of the scene's part in the list that PartsOf() returns
  RepresentationError whole;
};

struct MeasuredError {
  // The error of the interpolants, compared with exact irradiance from the same light sources.
  RepresentationError interpolant;
  // Exact irradiance from the same light sources compared with exact irradiance from more accurate light
  // sources. If there are several sets of more accurate light sources, the set with the largest differences
  // counts.
  RepresentationError sources;
  // The error of the interpolants, compared with exact irradiance from more accurate light sources.
  RepresentationError whole;
  double above = 0;  // fraction of the errors in `whole` that exceed ErrorMeasurement::bound
  // The errors of the interpolants, compared with exact irradiance from more accurate sources, for each
  // reflecting part of the scene.
  std::vector<PartError> by_part;
};

// The parameters of MeasureError().
struct ErrorMeasurement {
  std::size_t points = 0;
  std::uint64_t seed = 0;
  double bound = 0;  // MeasuredError::above counts errors larger than `bound`
};

// Measures errors at `points` random points, distributed uniformly by area over the reflecting fronts of
// patches (ReflectingAreas). Additional random points in each part of the scene make the errors of small
// parts reliable. Points that get no light and that nobody can see (Enclosure) are left out. The same random
// seed gives the same points. With probability one, none of the random points is an interpolation node. If
// the list `better` is empty, only MeasuredError::interpolant is computed.
MeasuredError MeasureError(const Scene& scene, const IrradianceMesh& mesh, const IrradianceSampler& sampler,
                           std::span<const IrradianceSampler> better, const ErrorMeasurement& measurement);

// Computes MeasuredError::interpolant, the error of the interpolants compared with exact irradiance from the
// same sources.
RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed);

}  // namespace penumbra
