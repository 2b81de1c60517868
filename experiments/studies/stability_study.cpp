// Numerical stability: the digits that each formula and each method keeps where input is nearly degenerate,
// tiny, huge or far from the origin.

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>

#include "experiments/bench/bench_scenes.h"
#include "experiments/studies/study.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

using Digits60 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>>;

// The sum over the edges of a polygon above the horizon of the z axis, at the origin, with `angle` between
// the directions a and b; m = a x b.
template <class Real, class Angle>
Real EdgeSum(const std::vector<std::array<Real, 3>>& polygon, Angle&& angle) {
  using std::sqrt;
  Real sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const std::array<Real, 3> m = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                   a[0] * b[1] - a[1] * b[0]};
    const Real length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    if (length > 0) sum += angle(a, b, length) * m[2] / length;
  }
  return sum;
}

template <class Real>
Real Dot(const std::array<Real, 3>& a, const std::array<Real, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double ByAtan2(const std::vector<std::array<double, 3>>& polygon) {
  return EdgeSum<double>(polygon, [](auto& a, auto& b, double m) { return std::atan2(m, Dot(a, b)); }) /
         (2 * std::numbers::pi);
}

double ByAcos(const std::vector<std::array<double, 3>>& polygon) {
  return EdgeSum<double>(polygon,
                         [](auto& a, auto& b, double) {
                           return std::acos(std::clamp(
                               Dot(a, b) / (std::sqrt(Dot(a, a)) * std::sqrt(Dot(b, b))), -1.0, 1.0));
                         }) /
         (2 * std::numbers::pi);
}

// gamma / sin(gamma) times n . (a x b) of unit vectors, as many programs write it.
double ByAcosOverSine(const std::vector<std::array<double, 3>>& polygon) {
  return EdgeSum<double>(polygon,
                         [](auto& a, auto& b, double m) {
                           const double lengths = std::sqrt(Dot(a, a)) * std::sqrt(Dot(b, b));
                           const double c = std::clamp(Dot(a, b) / lengths, -1.0, 1.0);
                           const double sine = std::sqrt(1 - c * c);
                           return sine > 0 ? std::acos(c) / sine * (m / lengths) : 0;
                         }) /
         (2 * std::numbers::pi);
}

double ByPenumbra(const std::vector<std::array<double, 3>>& polygon) {
  Polygon3 vertices;
  for (const auto& v : polygon) vertices.emplace_back(v[0], v[1], v[2]);
  return FormFactor(Vec3::Zero(), vertices, Vec3::UnitZ());
}

double Reference(const std::vector<std::array<double, 3>>& polygon) {
  std::vector<std::array<Digits60, 3>> exact;
  for (const auto& v : polygon) exact.push_back({Digits60(v[0]), Digits60(v[1]), Digits60(v[2])});
  const Digits60 sum = EdgeSum<Digits60>(
      exact, [](auto& a, auto& b, const Digits60& m) { return Digits60(atan2(m, Dot(a, b))); });
  return static_cast<double>(sum / (2 * boost::math::constants::pi<Digits60>()));
}

struct Kind {
  std::string name;
  std::function<std::vector<std::array<double, 3>>(Random&)> make;
};

// Rectangles that run counter-clockwise about the z axis as seen from above it: corner low, sides u and v.
std::vector<std::array<double, 3>> Rectangle(const Vec3& low, const Vec3& u, const Vec3& v) {
  std::vector<std::array<double, 3>> polygon;
  for (const Vec3& p : {low, Vec3(low + u), Vec3(low + u + v), Vec3(low + v)})
    polygon.push_back({p.x(), p.y(), p.z()});
  return polygon;
}

std::vector<Kind> Kinds() {
  std::vector<Kind> kinds;
  const auto random_place = [](Random& r, double z) { return Vec3(r.Uniform(-1, 1), r.Uniform(-1, 1), z); };
  kinds.push_back({"ordinary", [=](Random& r) {
                     return Rectangle(random_place(r, r.Uniform(0.5, 2)), Vec3(r.Uniform(0.2, 1), 0, 0),
                                      Vec3(0, r.Uniform(0.2, 1), 0));
                   }});
  kinds.push_back({"far", [=](Random& r) {
                     return Rectangle(random_place(r, r.LogUniform(1e3, 1e8)), Vec3(1, 0, 0), Vec3(0, 1, 0));
                   }});
  kinds.push_back({"near", [=](Random& r) {
                     return Rectangle(random_place(r, r.LogUniform(1e-12, 1e-3)) - Vec3(1, 1, 0),
                                      Vec3(3, 0, 0), Vec3(0, 3, 0));
                   }});
  kinds.push_back({"beside an edge", [](Random& r) {
                     const double d = r.LogUniform(1e-12, 1e-3);
                     return Rectangle(Vec3(d, -1, 0), Vec3(0, 2, 0), Vec3(0, 0, 2));
                   }});
  kinds.push_back({"sliver", [=](Random& r) {
                     return Rectangle(random_place(r, 1), Vec3(1, 0, 0),
                                      Vec3(0, r.LogUniform(1e-14, 1e-4), 0));
                   }});
  kinds.push_back({"grazing", [](Random& r) {
                     const double h = r.LogUniform(1e-9, 1e-3);
                     return Rectangle(Vec3(r.Uniform(2, 9), -1, 0), Vec3(0, 2, 0), Vec3(0, 0, h));
                   }});
  return kinds;
}

void StudyFormulas(StudyLog& log) {
  const int count = log.quick() ? 20 : 2000;
  const std::array<std::pair<const char*, double (*)(const std::vector<std::array<double, 3>>&)>, 4>
      formulas = {
          {{"acos", ByAcos}, {"acos / sine", ByAcosOverSine}, {"atan2", ByAtan2}, {"penumbra", ByPenumbra}}};
  std::array<double, 4> worst{};
  for (const Kind& kind : Kinds()) {
    for (std::size_t f = 0; f < formulas.size(); ++f) {
      Random random(7);
      std::vector<double> errors;
      for (int i = 0; i < count; ++i) {
        const auto polygon = kind.make(random);
        const double truth = std::abs(Reference(polygon));
        errors.push_back(truth > 0 ? std::abs(std::abs(formulas[f].second(polygon)) / truth - 1) : 0);
      }
      worst[f] = std::max(worst[f], *std::max_element(errors.begin(), errors.end()));
      StudyRow row;
      row.scene = kind.name;
      row.method = formulas[f].first;
      row.setting = "one polygon";
      SetErrors(std::move(errors), &row);
      log.Add(std::move(row));
    }
  }
  for (std::size_t f = 0; f < formulas.size(); ++f)
    log.Find(fmt::format("The form factor of one polygon by {}: at worst {:.2g} of its value off.",
                         formulas[f].first, worst[f]));
}

// A lamp over blinds, boxes and slits, all of it scaled and then shifted.
Scene HardScene(double scale, double shift) {
  Scene scene;
  scene.materials = GreyAndLight();
  const Vec3 o = Vec3::Constant(shift);
  const auto add = [&](std::initializer_list<Vec3> polygon, std::int32_t material) {
    Polygon3 moved;
    for (const Vec3& p : polygon) moved.push_back(scale * p + o);
    AddPatch(scene, moved, material);
  };
  add({{-0.5, -0.5, 4}, {-0.5, 0.5, 4}, {0.5, 0.5, 4}, {0.5, -0.5, 4}}, 1);
  for (int i = -8; i < 8; ++i) {  // a blind of slats that touch the light's plane from below
    const double x = 0.0625 * i;
    add({{x, -1, 3}, {x + 0.03125, -1, 3.03125}, {x + 0.03125, 1, 3.03125}, {x, 1, 3}}, 0);
  }
  for (const double y : {-0.25, 0.0, 0.25})  // boards that share edges and planes with each other
    add({{-0.25, y, 2}, {0.25, y, 2}, {0.25, y + 0.25, 2}, {-0.25, y + 0.25, 2}}, 0);
  add({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0);  // a wall that stands on the floor
  return scene;
}

void StudyScales(StudyLog& log) {
  const int count = log.quick() ? 5 : 200;
  double worst_scaled = 0, worst_shifted = 0;
  const auto irradiances = [&](double scale, double shift, const OcclusionMethod* method) {
    const Scene scene = HardScene(scale, shift);
    const PatchVisibility unused;
    PointIrradianceOptions options;
    options.method = method;
    const PointIrradiance irradiance(scene, unused, SourceSet::Emitters(scene), options);
    Random random(11);
    std::vector<double> values;
    for (int i = 0; i < count; ++i) {
      // Multiples of 1/1024, so that small shifts round nothing.
      const double x = (random.Index(2048) - 1024.0) / 1024, y = (random.Index(2048) - 1024.0) / 1024;
      values.push_back(
          irradiance.Anywhere({scale * Vec3(x, y, 0) + Vec3::Constant(shift), Vec3::UnitZ(), Vec3::Zero(), 0})
              .irradiance[0]);
    }
    return values;
  };
  const Backprojection exact;
  const std::vector<double> truth = irradiances(1, 0, &exact);
  const double largest = *std::max_element(truth.begin(), truth.end());
  const auto measure = [&](const std::string& scene, double parameter, double scale, double shift) {
    const std::vector<double> got = irradiances(scale, shift, nullptr);
    std::vector<double> errors;
    for (std::size_t i = 0; i < got.size(); ++i) errors.push_back(std::abs(got[i] - truth[i]) / largest);
    StudyRow row;
    row.scene = scene;
    row.method = "penumbra";
    row.setting = fmt::format("{:g}", parameter);
    row.parameter = parameter;
    SetErrors(std::move(errors), &row);
    const double worst = row.error_max;
    log.Add(std::move(row));
    return worst;
  };
  for (const double scale :
       log.quick() ? std::vector<double>{1e-6} : std::vector<double>{1e-6, 1e-3, 1, 1e3, 1e6})
    worst_scaled = std::max(worst_scaled, measure("scaled", scale, scale, 0));
  for (const double shift :
       log.quick() ? std::vector<double>{1024} : std::vector<double>{1024, 1048576, 1073741824})
    worst_shifted = std::max(worst_shifted, measure("far from the origin", shift, 1, shift));
  log.Find(fmt::format(
      "A blind, boards and a wall on the floor, scaled from 1e-6 to 1e6: irradiance is at worst {:.2g} of "
      "its largest off; shifted as far as 1e9 m (where coordinates keep 23 bits behind the point): "
      "{:.2g}.",
      worst_scaled, worst_shifted));
}

void StudyStability(StudyLog& log) {
  StudyFormulas(log);
  StudyScales(log);
}

}  // namespace

extern const Study kStabilityStudy;
const Study kStabilityStudy = {"stability",
                               "Digits kept on hard input: form factors of one polygon by formula, and "
                               "irradiance in scenes of any scale; relative errors",
                               "The angle by atan2 and quadrature where the sum cancels keep 13 digits "
                               "wherever the polygon lies; other forms lose all "
                               "of them.",
                               "parameter",
                               "error_max",
                               StudyStability};

}  // namespace penumbra
