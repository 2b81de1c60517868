#include "mesh/interpolants/triangle_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "mesh/interpolants/representation_error.h"
#include "solver/base/check.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/scene_parts.h"
#include "solver/visibility/point/enclosure.h"

namespace penumbra {
namespace {

Vec3 Corner(const IrradianceMesh& mesh, std::uint32_t t, int k) {
  return mesh.positions[mesh.triangles[t].vertex[static_cast<std::size_t>(k % 3)]];
}

std::vector<std::array<double, 2>> PlacesOfSamples(int samples) {
  std::vector<std::array<double, 2>> places;
  for (int row = 0; row < samples; ++row)
    for (int k = 0; k < 2 * (samples - row) - 1; ++k) {
      // Upright pieces and, between each two of them, one upside down.
      const double third = k % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      places.push_back({(k / 2 + third) / samples, (row + third) / samples});
    }
  return places;
}

double TwiceArea(const IrradianceMesh& mesh, std::uint32_t t) {
  return (Corner(mesh, t, 1) - Corner(mesh, t, 0)).cross(Corner(mesh, t, 2) - Corner(mesh, t, 0)).norm();
}

// The gradient of the interpolant in space [W/m^3]: one row per channel.
Eigen::Matrix3d GradientAt(const IrradianceMesh& mesh, std::uint32_t t, double s, double u) {
  const QuadraticInterpolant& q = mesh.irradiance[t];
  const Rgb ds = 2 * q.a * s + q.b2 * u + q.c2, dt = q.b2 * s + 2 * q.d * u + q.e2;
  const Vec3 e1 = Corner(mesh, t, 1) - Corner(mesh, t, 0), e2 = Corner(mesh, t, 2) - Corner(mesh, t, 0);
  const Vec3 n = e1.cross(e2);
  const double area2 = n.squaredNorm();
  if (area2 == 0) return Eigen::Matrix3d::Zero();
  const Vec3 grad_s = e2.cross(n) / area2, grad_t = n.cross(e1) / area2;
  return ds.matrix() * grad_s.transpose() + dt.matrix() * grad_t.transpose();
}

}  // namespace

MeasuredTriangles MeasureTriangles(const Scene& scene, const IrradianceMesh& mesh,
                                   std::span<const std::uint32_t> triangles, const TriangleSampling& sampling,
                                   const IrradianceSampler& sampler, SampleCache* cache) {
  PENUMBRA_CHECK(sampling.samples >= 1);
  const std::vector<std::array<double, 2>> places = PlacesOfSamples(sampling.samples);
  std::vector<ReceiverPoint> at(triangles.size() * places.size());
  std::vector<Rgb> truth(at.size());
  std::vector<std::size_t> unknown;
  const auto patch_of = [&](std::size_t i) { return mesh.triangles[triangles[i / places.size()]].patch; };
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::uint32_t t = triangles[i / places.size()];
    const auto [s, u] = places[i % places.size()];
    const Vec3 origin = Corner(mesh, t, 0);
    at[i].normal = scene.patches[static_cast<std::size_t>(patch_of(i))].normal;
    at[i].position = origin + s * (Corner(mesh, t, 1) - origin) + u * (Corner(mesh, t, 2) - origin);
    const PointIrradianceResult* known = cache ? cache->Find(patch_of(i), at[i]) : nullptr;
    if (known)
      truth[i] = known->irradiance;
    else
      unknown.push_back(i);
  }
  std::vector<PatchPoint> points;
  points.reserve(unknown.size());
  for (const std::size_t i : unknown) points.push_back({patch_of(i), at[i]});
  std::vector<PointIrradianceResult> found(unknown.size());
  sampler.SampleAll(points, found);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    found[k].one_sided = false;  // within a triangle
    truth[unknown[k]] = found[k].irradiance;
  }
  if (cache)
    for (std::size_t k = 0; k < unknown.size(); ++k)
      cache->Insert(patch_of(unknown[k]), at[unknown[k]], found[k]);

  const Rgb no_light = NoLight(scene);
  MeasuredTriangles measured;
  measured.point_evaluations = unknown.size();
  measured.errors.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    const std::uint32_t t = triangles[i / places.size()];
    const auto [s, u] = places[i % places.size()];
    const Rgb shown = mesh.irradiance[t].At(s, u).max(0.0);
    if (sampling.enclosure && (truth[i] <= no_light).all() &&
        sampling.enclosure->Surrounds(at[i].position, at[i].normal))
      continue;
    TriangleError& error = measured.errors[t];
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(shown[c] - truth[i][c]);
      if (difference == 0) continue;
      const double relative = difference / std::max(truth[i][c], kErrorFloor * sampling.mean[c]);
      error.max = std::max(error.max, relative);
      error.rms += relative * relative;
    }
  }
  for (TriangleError& error : measured.errors)
    error.rms = std::sqrt(error.rms / (3.0 * static_cast<double>(places.size())));
  return measured;
}

std::vector<double> GuessTriangleErrors(const Scene& scene, const IrradianceMesh& mesh, const Rgb& mean) {
  std::vector<double> guess(mesh.triangles.size(), 0.0);
  // For each edge, the first triangle that has it, and the edge's number there.
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, int>> first;
  first.reserve(2 * mesh.triangles.size());
  constexpr double kPlace[3][2][2] = {{{0, 0}, {1, 0}}, {{1, 0}, {0, 1}}, {{0, 1}, {0, 0}}};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const IrradianceMesh::Triangle& triangle = mesh.triangles[t];
      if (triangle.discontinuity[static_cast<std::size_t>(k)]) continue;
      const std::uint64_t v = triangle.vertex[static_cast<std::size_t>(k)],
                          w = triangle.vertex[static_cast<std::size_t>((k + 1) % 3)];
      const auto [place, added] = first.try_emplace(std::min(v, w) << 32 | std::max(v, w), t, k);
      if (added) continue;
      const auto [other, edge] = place->second;
      const Vec3 along = Corner(mesh, t, k + 1) - Corner(mesh, t, k);
      if (along.isZero(0)) continue;
      const Vec3 across =
          along.cross(scene.patches[static_cast<std::size_t>(triangle.patch)].normal).normalized();
      for (int end = 0; end < 2; ++end) {
        const double* here = kPlace[k][end];
        const double* there = kPlace[edge][1 - end];  // the other triangle traverses the edge in reverse
        const Vec3 jump =
            (GradientAt(mesh, t, here[0], here[1]) - GradientAt(mesh, other, there[0], there[1])) * across;
        const Rgb value = mesh.irradiance[t].At(here[0], here[1]).max(kErrorFloor * mean);
        for (const std::uint32_t side : {t, other}) {
          const Vec3 n = (Corner(mesh, side, 1) - Corner(mesh, side, 0))
                             .cross(Corner(mesh, side, 2) - Corner(mesh, side, 0));
          const double height = n.norm() / along.norm();
          // The error of a cubic x^3 with nodes at 0, h/2 and h is h^3 sqrt(3)/36; the slopes of its
          // interpolants jump by h^2.
          constexpr double kCubic = 0.048;
          for (int c = 0; c < 3; ++c)
            if (value[c] > 0)
              guess[side] = std::max(guess[side], kCubic * height * std::abs(jump[c]) / value[c]);
        }
      }
    }
  return guess;
}

std::vector<double> AreaAbove(const Scene& scene, const IrradianceMesh& mesh,
                              std::span<const TriangleError> errors, double error) {
  std::vector<double> areas(scene.patches.size(), 0.0);
  for (std::uint32_t t = 0; t < errors.size(); ++t)
    if (errors[t].max > error)
      areas[static_cast<std::size_t>(mesh.triangles[t].patch)] += 0.5 * TwiceArea(mesh, t);
  return areas;
}

Rgb MeanIrradiance(const Scene& scene, const IrradianceMesh& mesh) {
  const std::vector<double> seen = ReflectingAreas(scene);
  Rgb sum = Rgb::Zero();
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (seen[static_cast<std::size_t>(mesh.triangles[t].patch)] == 0) continue;
    const double a = TwiceArea(mesh, t);
    const QuadraticInterpolant& q = mesh.irradiance[t];
    sum += a / 3 * (q.At(0.5, 0) + q.At(0.5, 0.5) + q.At(0, 0.5));
    area += a;
  }
  return area > 0 ? Rgb(sum / area) : sum;
}

}  // namespace penumbra
