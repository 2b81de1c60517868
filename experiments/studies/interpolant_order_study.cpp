// The order of the interpolant (thesis 3.2, 3.3): constant, linear, quadratic and cubic on the same
// triangles, with discontinuities meshed and without, at equal samples and at equal error.
//
// All see the same light. Meshes are those of ever finer solutions. What an order costs is its exact
// evaluations, each node counted once, times the seconds that one takes.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "experiments/studies/lagrange_interpolant.h"
#include "experiments/studies/study.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

constexpr std::array kOrders = {"constant", "linear", "quadratic", "cubic"};
constexpr std::size_t kSpreadPoints = 2000, kQuickSpreadPoints = 100;
constexpr std::uint64_t kSpreadSeed = 5;
constexpr double kFinest = 0.02, kQuickFinest = 0.2;  // of the solution that gives the light

// The nodes that triangles ask for, with those that neighbours share counted once.
std::size_t CountNodes(const IrradianceMesh& mesh, int degree) {
  std::set<std::uint32_t> vertices;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const IrradianceMesh::Triangle& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = triangle.vertex[k], w = triangle.vertex[(k + 1) % 3];
      vertices.insert(v);
      edges.insert(std::minmax(v, w));
    }
  switch (degree) {
    case 0:
      return mesh.triangles.size();
    case 1:
      return vertices.size();
    case 2:
      return vertices.size() + edges.size();
    default:
      return vertices.size() + 2 * edges.size() + mesh.triangles.size();
  }
}

class OrderComparison {
 public:
  OrderComparison(StudyLog& log, const std::string& name)
      : log_(log),
        name_(name),
        scene_(*LoadBuiltinScene(name, {})),
        light_(scene_, Options(log.quick() ? kQuickFinest : kFinest)) {
    light_.Solve({});
    points_ = SpreadPoints(scene_, log.quick() ? kQuickSpreadPoints : kSpreadPoints, kSpreadSeed);
    truth_.resize(points_.size());
    const Stopwatch stopwatch;
    for (std::size_t i = 0; i < points_.size(); ++i) truth_[i] = Exact(points_[i].patch, At(i, Vec3::Zero()));
    seconds_ = stopwatch.Seconds() / static_cast<double>(points_.size());
  }

  void Run(const std::vector<double>& ladder) {
    const std::size_t first = log_.rows().size();
    for (const bool meshed : {true, false})
      for (const double error : ladder) MeasureMesh(meshed, error);
    for (const bool meshed : {true, false}) Conclude(meshed, first);
  }

 private:
  static PipelineOptions Options(double error) {
    PipelineOptions options;
    options.error = error;
    options.refine = RefineBy::kTransport;
    return options;
  }

  static std::string MethodName(std::size_t degree, bool meshed) {
    return fmt::format("{}, {}", kOrders[degree], meshed ? "meshed" : "not meshed");
  }

  ReceiverPoint At(std::size_t i, const Vec3& approach) const {
    ReceiverPoint at;
    at.position = points_[i].position;
    at.normal = scene_.patches[static_cast<std::size_t>(points_[i].patch)].normal;
    at.approach = approach;
    return at;
  }

  Rgb Exact(PatchId patch, const ReceiverPoint& at) const {
    return light_.irradiance().OnPatch(patch, at).irradiance;
  }

  // The value there of the interpolant of a degree on the triangle.
  Rgb Interpolated(const IrradianceMesh& mesh, const MeshLocator::Location& location, int degree) const {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[location.triangle];
    const Vec3 &a = mesh.positions[triangle.vertex[0]], &b = mesh.positions[triangle.vertex[1]],
               &c = mesh.positions[triangle.vertex[2]];
    ReceiverPoint at;
    at.normal = scene_.patches[static_cast<std::size_t>(triangle.patch)].normal;
    std::vector<Rgb> samples;
    for (const auto& [s, t] : InterpolationNodes(degree)) {
      at.position = a + s * (b - a) + t * (c - a);
      at.approach = (a + b + c) / 3 - at.position;
      samples.push_back(Exact(triangle.patch, at));
    }
    return InterpolateLagrange(degree, samples, location.s, location.t).max(0.0);
  }

  void MeasureMesh(bool meshed, double error) {
    Pipeline pipeline(scene_, Options(error));
    pipeline.Solve({});
    MeshOptions options;
    options.discontinuities = pipeline.resolved().discontinuities;
    if (!meshed) options.discontinuities.choice = "none";
    options.order = InterpolantOrder::kConstant;
    const IrradianceMesh mesh =
        RunLocalPass(pipeline.visibility(), pipeline.solution(), {}, options, {}).mesh;
    const MeshLocator locator(scene_, mesh);
    for (std::size_t degree = 0; degree < kOrders.size(); ++degree) {
      std::vector<Rgb> shown(points_.size()), truth = truth_;
      ParallelFor(points_.size(), 8, [&](std::size_t i) {
        const auto location = locator.Find(points_[i].patch, points_[i].position);
        if (location)
          shown[i] = Interpolated(mesh, *location, static_cast<int>(degree));
        else
          shown[i] = truth[i];  // in the gap of rounding between two triangles
      });
      StudyRow row;
      SetErrors(RelativeErrors(shown, truth), &row);
      row.scene = name_;
      row.method = MethodName(degree, meshed);
      row.setting = fmt::format("leaves of error {:g}", error);
      row.parameter = error;
      row.triangles = mesh.triangles.size();
      row.evaluations = CountNodes(mesh, static_cast<int>(degree));
      row.seconds = seconds_ * static_cast<double>(*row.evaluations);
      log_.Add(std::move(row));
    }
  }

  // What an order needs for an error, between the rows that enclose it; nothing beyond them.
  std::optional<double> EvaluationsFor(const std::string& method, double error, std::size_t first) const {
    const StudyRow* before = nullptr;
    for (std::size_t i = first; i < log_.rows().size(); ++i) {
      const StudyRow& row = log_.rows()[i];
      if (row.method != method) continue;
      if (before && before->error_rms >= error && row.error_rms <= error) {
        const double share =
            std::log(before->error_rms / error) / std::log(before->error_rms / row.error_rms);
        return static_cast<double>(*before->evaluations) *
               std::pow(static_cast<double>(*row.evaluations) / static_cast<double>(*before->evaluations),
                        share);
      }
      before = &row;
    }
    return std::nullopt;
  }

  void Conclude(bool meshed, std::size_t first) {
    std::string orders, needs;
    for (std::size_t degree = 0; degree < kOrders.size(); ++degree) {
      std::vector<double> evaluations, errors;
      for (std::size_t i = first; i < log_.rows().size(); ++i)
        if (log_.rows()[i].method == MethodName(degree, meshed)) {
          evaluations.push_back(static_cast<double>(*log_.rows()[i].evaluations));
          errors.push_back(log_.rows()[i].error_rms);
        }
      orders += fmt::format("{}{} as evaluations^{:.2f}", degree > 0 ? ", " : "", kOrders[degree],
                            LogSlope(evaluations, errors));
      constexpr double kWanted = 0.02;
      const std::optional<double> needed = EvaluationsFor(MethodName(degree, meshed), kWanted, first);
      needs += fmt::format("{}{} {}", degree > 0 ? ", " : "", kOrders[degree],
                           needed ? fmt::format("{:.0f}", *needed) : std::string("beyond what was tried"));
    }
    log_.Find(fmt::format("{}, {}: the rms error falls, {}; evaluations for 0.02 of it: {}.", name_,
                          meshed ? "discontinuities meshed" : "not meshed", orders, needs));
  }

  StudyLog& log_;
  std::string name_;
  Scene scene_;
  Pipeline light_;
  std::vector<SurfacePoint> points_;
  std::vector<Rgb> truth_;
  double seconds_ = 0;  // of one evaluation
};

void StudyInterpolantOrder(StudyLog& log) {
  if (log.quick()) return OrderComparison(log, "floating-cube").Run({0.2, 0.05});
  for (const char* name : {"floating-cube", "cornell", "office"})
    OrderComparison(log, name).Run({0.4, 0.2, 0.1, 0.05, 0.02});
}

}  // namespace

extern const Study kInterpolantOrderStudy;
const Study kInterpolantOrderStudy = {
    "interpolant-order",
    "Interpolants of degree 0 to 3 on the same triangles, discontinuities meshed and not: evaluations of "
    "exact "
    "irradiance against the error at random points",
    "Quadratic interpolants need fewer evaluations for an error than linear ones, and more degrees gain "
    "little, if the discontinuities are meshed (Hardt 1996, 3.2).",
    "evaluations",
    "error_rms",
    StudyInterpolantOrder};

}  // namespace penumbra
