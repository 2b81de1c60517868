// Singular corners (thesis 5.2, 4.4.2): where a contact edge ends, the irradiance depends on the direction in
// which one comes near, and no polynomial fits. What a value for each triangle gains there, and what grading
// the mesh towards the corner does.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "mesh/discontinuities/contact_corners.h"
#include "mesh/discontinuities/discontinuity.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "solver/base/random.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

constexpr double kNearCorner = 0.01;     // of the scene's diagonal: how far from a corner errors are measured
constexpr std::size_t kPointsNear = 40;  // of each corner
constexpr int kMostLevels = 6;

// Where a contact ends on a patch.
struct ContactEnd {
  PatchId patch = kNoPatch;
  Vec2 at = Vec2::Zero();  // in the patch's frame [m]
};

std::vector<ContactEnd> FindContactEnds(const Scene& scene, const PatchVisibility& visibility) {
  const DiscontinuityFinder finder(scene, visibility);
  std::vector<ContactEnd> ends;
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p)
    for (const Vec2& end :
         ContactEnds(scene.patches[static_cast<std::size_t>(p)], finder.FindContacts(p, {})))
      ends.push_back({p, end});
  return ends;
}

class CornerComparison {
 public:
  CornerComparison(StudyLog& log, const std::string& name)
      : log_(log), scene_(*LoadBuiltinScene(name, {})), pipeline_(scene_, Options(log.quick())) {
    pipeline_.Solve({});
    pipeline_.irradiance();  // is made once
    ends_ = FindContactEnds(scene_, pipeline_.visibility());
    ScatterPoints();
  }

  void Run() {
    const StudyRow shared = Measure("one value a vertex", 0, /*by_triangle=*/false);
    std::vector<StudyRow> graded;
    for (int levels = 0; levels <= (log_.quick() ? 1 : kMostLevels); ++levels)
      graded.push_back(Measure("a value each triangle, graded", levels, /*by_triangle=*/true));
    const StudyRow &plain = graded.front(), &best = graded.back();
    log_.Find(
        fmt::format("{}: within {:g} of the diagonal of {} ends of contacts the interpolants err by {:.3g} "
                    "(rms) with one value a "
                    "vertex, {:.3g} with one for each triangle, and {:.3g} with the leaves there divided "
                    "{:g} times, for {} "
                    "instead of {} evaluations; a division leaves {:.2f} of the error.",
                    scene_.name, kNearCorner, ends_.size(), shared.error_rms, plain.error_rms, best.error_rms,
                    best.parameter, *best.evaluations, *plain.evaluations,
                    std::pow(best.error_rms / plain.error_rms, 1 / std::max(best.parameter, 1.0))));
  }

 private:
  static PipelineOptions Options(bool quick) {
    PipelineOptions options;
    options.error = quick ? 0.3 : 0.05;
    options.refine = RefineBy::kTransport;
    return options;
  }

  const Patch& PatchOf(PatchId p) const { return scene_.patches[static_cast<std::size_t>(p)]; }

  // Points that spread evenly over discs around the corners, where they lie on the patch and in the light:
  // under a block there is nothing to show.
  void ScatterPoints() {
    Random random(1);
    const double radius = kNearCorner * scene_.Diagonal();
    for (const ContactEnd& end : ends_) {
      const Frame frame = PolygonFrame(PatchOf(end.patch).Vertices());
      for (std::size_t i = 0; i < kPointsNear; ++i) {
        const double r = radius * std::sqrt(random.Uniform()),
                     angle = 2 * std::numbers::pi * random.Uniform();
        const Vec2 p = end.at + r * Vec2(std::cos(angle), std::sin(angle));
        ReceiverPoint at;
        at.position = frame.FromPlane(p);
        at.normal = PatchOf(end.patch).normal;
        if (!ConvexContains(PatchOf(end.patch).Vertices(), at.normal, at.position, 0)) continue;
        const Rgb truth = pipeline_.irradiance().OnPatch(end.patch, at).irradiance;
        if (truth.maxCoeff() == 0) continue;
        points_.emplace_back(end.patch, at.position);
        truth_.push_back(truth);
      }
    }
  }

  StudyRow Measure(const char* method, int levels, bool by_triangle) {
    DiscontinuityOptions discontinuities = pipeline_.resolved().discontinuities;
    discontinuities.corner_divisions = levels;
    const IrradianceSampler sampler = [&](PatchId patch, const ReceiverPoint& at) {
      PointIrradianceResult result = pipeline_.irradiance().OnPatch(patch, at);
      result.one_sided &= by_triangle;
      return result;
    };
    MeshReport report;
    const double begin = ProcessorSeconds();
    const std::vector<PatchTriangulation> triangulations =
        PatchTriangulator(pipeline_.visibility(), pipeline_.solution(), discontinuities, {})
            .Triangulate(BeginPlan(pipeline_.visibility(), pipeline_.solution(), discontinuities), report);
    const BuiltMesh built =
        BuildIrradianceMesh(scene_, triangulations, InterpolantOrder::kQuadratic, sampler, {});
    StudyRow row;
    row.seconds = ProcessorSeconds() - begin;
    row.scene = scene_.name;
    row.method = method;
    row.setting = fmt::format("{} divisions", levels);
    row.parameter = levels;
    row.triangles = built.mesh.triangles.size();
    row.evaluations = built.point_evaluations;
    const MeshLocator locator(scene_, built.mesh);
    std::vector<Rgb> shown;
    for (const auto& [patch, position] : points_)
      shown.push_back(IrradianceAt(built.mesh, *locator.Find(patch, position)).max(0.0));
    SetErrors(RelativeErrors(shown, truth_), &row);
    log_.Add(row);
    return row;
  }

  StudyLog& log_;
  Scene scene_;
  Pipeline pipeline_;
  std::vector<ContactEnd> ends_;
  std::vector<std::pair<PatchId, Vec3>> points_;  // on the patch [m]
  std::vector<Rgb> truth_;
};

void StudyContactCorners(StudyLog& log) {
  for (const std::string name : {"cornell", "office"}) {
    CornerComparison(log, name).Run();
    if (log.quick()) return;
  }
}

}  // namespace

extern const Study kContactCornerStudy;
const Study kContactCornerStudy = {
    "contact-corners",
    "Where contact edges end: the interpolants' error within a hundredth of the scene's diagonal, with one "
    "value a "
    "vertex, one for each triangle, and leaves divided towards the corner; seconds of processors",
    "No polynomial fits where a contact edge ends; refinement must not stick there (Hardt 1996, 4.4.2, "
    "drawback 2).",
    "evaluations",
    "error_rms",
    StudyContactCorners};

}  // namespace penumbra
