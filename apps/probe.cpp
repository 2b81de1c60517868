#include "apps/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/processes.h"
#include "solver/geometry/polygon.h"
#include "solver/geometry/polygon_distance.h"
#include "solver/geometry/vec_bytes.h"

namespace penumbra {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBatch = 1024;    // points between two looks at the context
constexpr std::size_t kNamedRows = 10;  // rows that a warning names before it only counts

// Unit, whatever the length; zero stays zero.
Vec3 Normalised(const Vec3& v) {
  const double largest = MaxAbs(v);
  return largest > 0 ? (v / largest).normalized() : Vec3::Zero().eval();
}

void AppendNumber(double value, fmt::memory_buffer* out) {
  if (std::isnan(value))
    fmt::format_to(std::back_inserter(*out), ",nan");  // never -nan
  else
    fmt::format_to(std::back_inserter(*out), ",{:.17g}", value);
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
      surroundings_(scene),
      reach_(PatchReach(scene)) {}

ReceiverPoint Prober::ReceiverPointAt(PatchId id, const Vec3& position, const Vec3& normal) const {
  if (id == kNoPatch) return {position, normal, Vec3::Zero(), 0};
  const Patch& patch = scene_.patches[static_cast<std::size_t>(id)];
  const Vec3 foot = NearestInPolygon(patch.Vertices(), patch.normal, position);
  return {surroundings_.BeforeBacks(id, foot), patch.normal, Vec3::Zero(), 0};
}

Measurement Prober::MeasureAt(const ProbePoint& point) const {
  Measurement measurement;
  measurement.point = point;
  measurement.interpolated = Rgb::Constant(kNan);
  const Vec3 normal = Normalised(point.normal);
  if (normal.isZero(0)) {
    measurement.exact = measurement.direct = Rgb::Constant(kNan);
    measurement.gradient.setConstant(kNan);
    measurement.place = PointPlace::kZeroNormal;
    return measurement;
  }
  measurement.footing = FindFace(scene_, point.position, normal);
  const ReceiverPoint at = ReceiverPointAt(measurement.footing.patch, point.position, normal);
  IrradianceParts parts;
  const bool is_in_space = pipeline_ && measurement.footing.patch == kNoPatch;
  IrradianceParts* const wanted = parts_ ? &parts : nullptr;
  measurement.exact =
      (is_in_space ? pipeline_->IrradianceInSpace(irradiance_, at, wanted) : irradiance_.Anywhere(at, wanted))
          .irradiance;
  measurement.direct = parts.direct;
  measurement.gradient = parts.gradient;
  if (pipeline_ && measurement.footing.patch != kNoPatch)
    if (const std::optional<Rgb> value =
            pipeline_->Interpolated(measurement.footing.patch, at.position, reach_)) {
      measurement.interpolated = *value;
      measurement.sound = value->allFinite();
    }
  measurement.sound = measurement.sound && measurement.exact.allFinite() && measurement.direct.allFinite();
  if (surroundings_.SeesOnlyBacks(at.position, normal)) measurement.place = PointPlace::kBehind;
  if (surroundings_.IsFar(point.position)) measurement.place = PointPlace::kFar;
  return measurement;
}

// What a process has measured; the point is known to all.
template <class Archive>
void Transfer(Archive& archive, Measurement& measurement) {
  Transfer(archive, measurement.footing.face);
  Transfer(archive, measurement.footing.patch);
  Transfer(archive, measurement.exact);
  Transfer(archive, measurement.direct);
  archive.Raw(measurement.gradient.data(),
              sizeof(double) * static_cast<std::size_t>(measurement.gradient.size()));
  Transfer(archive, measurement.interpolated);
  Transfer(archive, measurement.place);
  Transfer(archive, measurement.sound);
}

std::vector<Measurement> Prober::Measure(const std::vector<ProbePoint>& points,
                                         const ExecutionContext& context) const {
  std::vector<Measurement> measurements(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) measurements[i].point = points[i];
  for (std::size_t begin = 0; begin < points.size() && !context.Cancelled(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    DealOut(std::span(measurements).subspan(begin, count), 8,
            [&](std::size_t i) { measurements[begin + i] = MeasureAt(points[begin + i]); });
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

namespace {

// The names of a value's columns: NAME_r,NAME_g,NAME_b, or NAME_lux.
std::string ColumnsOf(const char* name, LightUnit unit) {
  return unit == LightUnit::kLux ? fmt::format(",{}_lux", name) : fmt::format(",{0}_r,{0}_g,{0}_b", name);
}

std::string Header(const ProbeColumns& columns) {
  std::string header = "x,y,z,nx,ny,nz,patch";
  header += ColumnsOf("exact", columns.unit) + ColumnsOf("interp", columns.unit);
  if (!columns.parts) return header;
  header += ColumnsOf("direct", columns.unit);
  if (columns.unit == LightUnit::kLux) return header + ",grad_lux_x,grad_lux_y,grad_lux_z";
  return header + ",grad_r_x,grad_r_y,grad_r_z,grad_g_x,grad_g_y,grad_g_z,grad_b_x,grad_b_y,grad_b_z";
}

void AppendLight(const Rgb& light, LightUnit unit, fmt::memory_buffer* out) {
  if (unit == LightUnit::kLux) return AppendNumber(Lux(light), out);
  for (const double value : light) AppendNumber(value, out);
}

void AppendGradient(const IrradianceGradient& gradient, LightUnit unit, fmt::memory_buffer* out) {
  if (unit == LightUnit::kLux) {
    for (int axis = 0; axis < 3; ++axis) AppendNumber(Lux(gradient.col(axis).array()), out);
    return;
  }
  for (int channel = 0; channel < 3; ++channel)
    for (int axis = 0; axis < 3; ++axis) AppendNumber(gradient(channel, axis), out);
}

}  // namespace

std::string MeasurementsCsv(const std::vector<Measurement>& measurements, const ProbeColumns& columns) {
  fmt::memory_buffer csv;
  fmt::format_to(std::back_inserter(csv), "{}\n", Header(columns));
  for (const Measurement& m : measurements) {
    fmt::format_to(std::back_inserter(csv), "{:.17g}", m.point.position.x());
    for (const double value : {m.point.position.y(), m.point.position.z(), m.point.normal.x(),
                               m.point.normal.y(), m.point.normal.z()})
      AppendNumber(value, &csv);
    fmt::format_to(std::back_inserter(csv), ",{}", m.footing.face);
    AppendLight(m.exact, columns.unit, &csv);
    AppendLight(m.interpolated, columns.unit, &csv);
    if (columns.parts) {
      AppendLight(m.direct, columns.unit, &csv);
      AppendGradient(m.gradient, columns.unit, &csv);
    }
    csv.push_back('\n');
  }
  return fmt::to_string(csv);
}

std::string SurroundingsWarning(const std::vector<Measurement>& measurements) {
  std::vector<std::size_t> behind, zero, far;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (measurements[i].place == PointPlace::kBehind) behind.push_back(i + 1);
    if (measurements[i].place == PointPlace::kZeroNormal) zero.push_back(i + 1);
    if (measurements[i].place == PointPlace::kFar) far.push_back(i + 1);
  }
  std::string warning;
  for (const auto& [what, rows] :
       {std::pair("inside a solid or behind faces", &behind), std::pair("with a zero normal", &zero),
        std::pair("far outside the scene, which is in metres", &far)})
    if (!rows->empty()) warning += fmt::format("{}{}: {}", warning.empty() ? "" : "; ", what, RowList(*rows));
  return warning.empty() ? warning : "points (row 1 follows the header) " + warning;
}

}  // namespace penumbra
