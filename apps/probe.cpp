#include "apps/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/geometry/polygon.h"
#include "solver/geometry/polygon_distance.h"

namespace penumbra {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBatch = 1024;    // points between two looks at the context
constexpr std::size_t kNamedRows = 10;  // rows that a warning names before it only counts
constexpr double kDegree = std::numbers::pi / 180;

constexpr std::string_view kPartColumns =
    ",direct_r,direct_g,direct_b,grad_r_x,grad_r_y,grad_r_z,grad_g_x,grad_g_y,grad_g_z,grad_b_x,grad_b_y,"
    "grad_b_z";

// Unit, whatever the length; zero stays zero.
Vec3 Normalised(const Vec3& v) {
  const double largest = MaxAbs(v);
  return largest > 0 ? (v / largest).normalized() : Vec3::Zero().eval();
}

// Directions that look around on the side of the normal: along it, and two rings of six.
std::vector<Vec3> LookAround(const Vec3& normal) {
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  std::vector<Vec3> directions = {normal};
  for (const double from_normal : {45 * kDegree, 75 * kDegree})
    for (int i = 0; i < 6; ++i) {
      const double around = (60 * i + 17) * kDegree;  // off the axes, along which scenes have their edges
      directions.push_back(std::sin(from_normal) * (std::cos(around) * frame.u + std::sin(around) * frame.v) +
                           std::cos(from_normal) * normal);
    }
  return directions;
}

void AppendNumber(double value, fmt::memory_buffer* out) {
  if (std::isnan(value))
    fmt::format_to(std::back_inserter(*out), ",nan");  // never -nan
  else
    fmt::format_to(std::back_inserter(*out), ",{:.17g}", value);
}

// The lowest of the faces that the patch covers within `reach` of the point.
std::int32_t LowestFace(const Scene& scene, PatchId id, const Vec3& position, double reach) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
  if (patch.faces.size() > 1)
    for (const std::int32_t face : patch.faces)
      if (ConvexContains(scene.faces[static_cast<std::size_t>(face)].vertices, patch.normal, position, reach))
        return face;
  return scene.FaceAt(id, position);
}

// "rows 1, 2, 3 and 4 more".
std::string RowList(const std::vector<std::size_t>& rows) {
  std::string list = rows.size() == 1 ? "row" : "rows";
  const std::size_t named = std::min(rows.size(), kNamedRows);
  for (std::size_t i = 0; i < named; ++i) list += fmt::format("{} {}", i > 0 ? "," : "", rows[i]);
  if (rows.size() > named) list += fmt::format(" and {} more", rows.size() - named);
  return list;
}

}  // namespace

Prober::Prober(const Scene& scene, const PointIrradiance& irradiance, const Pipeline* pipeline, bool parts)
    : scene_(scene),
      irradiance_(irradiance),
      pipeline_(pipeline),
      parts_(parts),
      rays_(scene),
      reach_(kOnPatchDistance * scene.Diagonal()) {
  std::tie(low_, high_) = scene.Bounds();
}

PointFace Prober::FindFooting(const Vec3& position, const Vec3& normal) const {
  PointFace lowest;
  const double least_cosine = std::cos(kOnPatchDegrees * kDegree);
  for (std::size_t i = 0; i < scene_.patches.size(); ++i) {
    const Patch& patch = scene_.patches[i];
    if (patch.normal.dot(normal) < least_cosine) continue;
    if (std::abs(patch.normal.dot(position - patch.vertex[0])) > reach_) continue;
    if (!ConvexContains(patch.Vertices(), patch.normal, position, reach_)) continue;
    const auto id = static_cast<PatchId>(i);
    const std::int32_t face = LowestFace(scene_, id, position, reach_);
    if (lowest.patch == kNoPatch || face < lowest.face) lowest = {face, id};
  }
  return lowest;
}

ReceiverPoint Prober::ReceiverPointAt(PatchId id, const Vec3& position, const Vec3& normal) const {
  if (id == kNoPatch) return {position, normal, Vec3::Zero(), 0};
  const Patch& patch = scene_.patches[static_cast<std::size_t>(id)];
  return {NearestInPolygon(patch.Vertices(), patch.normal, position), patch.normal, Vec3::Zero(), 0};
}

bool Prober::IsFar(const Vec3& position) const {
  const Vec3 nearest = position.cwiseMax(low_).cwiseMin(high_);
  return !scene_.patches.empty() &&
         (position - nearest).stableNorm() > kFarDiagonals * (high_ - low_).stableNorm();
}

bool Prober::SeesOnlyBacks(const Vec3& position, const Vec3& normal) const {
  // A point on a surface stands on the side that its normal points to, in the floats of rays, too, which
  // count from the middle of the scene; where the scene lies plays no part.
  constexpr double kFloatRounding = 8 * std::numeric_limits<float>::epsilon();
  const double from_middle = MaxAbs(position - 0.5 * (low_ + high_));
  const Vec3 eye = position + (reach_ + kFloatRounding * from_middle) * normal;
  // Furniture without a bottom stands on an uncut floor: a look down from inside it meets a front.
  for (const Vec3& up : {normal, Vec3(-normal)}) {
    bool any_back = false, any_front = false;
    for (const Vec3& direction : LookAround(up)) {
      const RayCaster::Hit hit = rays_.Cast(eye, direction);
      if (hit.patch != kNoPatch) (hit.front ? any_front : any_back) = true;
    }
    if (any_front) return false;
    if (any_back) return true;
  }
  return false;
}

Measurement Prober::MeasureAt(const ProbePoint& point) const {
  Measurement measurement;
  measurement.point = point;
  measurement.interpolated = Rgb::Constant(kNan);
  const Vec3 normal = Normalised(point.normal);
  if (normal.isZero(0)) {
    measurement.exact = measurement.direct = Rgb::Constant(kNan);
    measurement.gradient.setConstant(kNan);
    measurement.surroundings = Surroundings::kZeroNormal;
    return measurement;
  }
  measurement.footing = FindFooting(point.position, normal);
  const ReceiverPoint at = ReceiverPointAt(measurement.footing.patch, point.position, normal);
  IrradianceParts parts;
  measurement.exact = irradiance_.Anywhere(at, parts_ ? &parts : nullptr).irradiance;
  measurement.direct = parts.direct;
  measurement.gradient = parts.gradient;
  if (pipeline_ && measurement.footing.patch != kNoPatch)
    if (const std::optional<Rgb> value =
            pipeline_->Interpolated(measurement.footing.patch, at.position, reach_)) {
      measurement.interpolated = *value;
      measurement.sound = value->allFinite();
    }
  measurement.sound = measurement.sound && measurement.exact.allFinite() && measurement.direct.allFinite();
  if (SeesOnlyBacks(at.position, normal)) measurement.surroundings = Surroundings::kBehind;
  if (IsFar(point.position)) measurement.surroundings = Surroundings::kFar;
  return measurement;
}

std::vector<Measurement> Prober::Measure(const std::vector<ProbePoint>& points,
                                         const ExecutionContext& context) const {
  std::vector<Measurement> measurements(points.size());
  for (std::size_t begin = 0; begin < points.size() && !context.Cancelled(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    ParallelFor(count, 8, [&](std::size_t i) { measurements[begin + i] = MeasureAt(points[begin + i]); });
    context.Report("probe", static_cast<double>(begin + count) / static_cast<double>(points.size()));
  }
  return measurements;
}

void CheckMeasurements(const std::vector<Measurement>& measurements) {
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (!measurements[i].sound)
      throw InputError(fmt::format(
          "error: the irradiance at row {} (row 1 follows the header) is no number; where the point and "
          "the light are within reason, this is a mistake of the program",
          i + 1));
  }
}

std::string MeasurementsCsv(const std::vector<Measurement>& measurements, bool parts) {
  fmt::memory_buffer csv;
  fmt::format_to(std::back_inserter(csv),
                 "x,y,z,nx,ny,nz,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b{}\n",
                 parts ? kPartColumns : "");
  for (const Measurement& m : measurements) {
    fmt::format_to(std::back_inserter(csv), "{:.17g}", m.point.position.x());
    for (const double value : {m.point.position.y(), m.point.position.z(), m.point.normal.x(),
                               m.point.normal.y(), m.point.normal.z()})
      AppendNumber(value, &csv);
    fmt::format_to(std::back_inserter(csv), ",{}", m.footing.face);
    for (const double value : m.exact) AppendNumber(value, &csv);
    for (const double value : m.interpolated) AppendNumber(value, &csv);
    if (parts) {
      for (const double value : m.direct) AppendNumber(value, &csv);
      for (int channel = 0; channel < 3; ++channel)
        for (int axis = 0; axis < 3; ++axis) AppendNumber(m.gradient(channel, axis), &csv);
    }
    csv.push_back('\n');
  }
  return fmt::to_string(csv);
}

std::string SurroundingsWarning(const std::vector<Measurement>& measurements) {
  std::vector<std::size_t> behind, zero, far;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (measurements[i].surroundings == Surroundings::kBehind) behind.push_back(i + 1);
    if (measurements[i].surroundings == Surroundings::kZeroNormal) zero.push_back(i + 1);
    if (measurements[i].surroundings == Surroundings::kFar) far.push_back(i + 1);
  }
  std::string warning;
  for (const auto& [what, rows] :
       {std::pair("inside a solid or behind faces", &behind), std::pair("with a zero normal", &zero),
        std::pair("far outside the scene, which is in metres", &far)})
    if (!rows->empty()) warning += fmt::format("{}{}: {}", warning.empty() ? "" : "; ", what, RowList(*rows));
  return warning.empty() ? warning : "points (row 1 follows the header) " + warning;
}

}  // namespace penumbra
