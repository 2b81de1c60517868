// What shows the light of elements: constants, means at vertices, bilinear and bicubic pieces, Gouraud
// shading on the screen, against the discontinuity mesh. The errors are those at the points of path-traced
// references.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "display/image_difference.h"
#include "display/ray_display.h"
#include "display/reconstruction.h"
#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "mesh/interpolants/vertex_light.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/transport/links/element_locator.h"

namespace penumbra {
namespace {

constexpr int kFrameWidth = 320, kFrameHeight = 240;

struct Reconstructed {
  std::string method;
  ReconstructedLight light;
};

class ReconstructionComparison {
 public:
  ReconstructionComparison(const std::string& scene, double error, StudyLog* log)
      : test_(LoadReferenceCase(scene)),
        setting_(fmt::format("--error {:g} --refine transport", error)),
        error_(error),
        log_(log) {
    PipelineOptions options;
    options.error = error;
    options.refine = RefineBy::kTransport;
    pipeline_ = std::make_unique<Pipeline>(test_.scene, options);
    pipeline_->Solve({});
    pipeline_->BuildMesh(MeshKind::kFlat, {});
    for (const ReferencePoint& point : test_.points)
      patches_.push_back(PatchBelow(*pipeline_, {point.position, point.normal, Vec3::Zero(), 0}));
  }

  void Run() {
    const RadiositySolution& solution = pipeline_->solution();
    const ElementLocator locator(solution.forest);
    Shader("flat", [&](const RayPoint& point) {
      return solution.irradiance[static_cast<std::size_t>(locator.LeafAt(point.patch, point.position))];
    });
    const std::vector<VertexLight> means = NodalAverages(solution.forest, solution.irradiance);
    const std::vector<VertexLight> exact = ExactAtVertices(solution.forest, pipeline_->irradiance(), {});
    const auto add = [&](const std::string& method, Reconstruction kind,
                         const std::vector<VertexLight>& from) {
      reconstructed_.push_back({method, ReconstructedLight(kind, solution.forest, from)});
    };
    add("means, bilinear (nodal)", Reconstruction::kNodal, means);
    add("means, bicubic", Reconstruction::kBicubic, means);
    add("means, gouraud-screen", Reconstruction::kGouraudScreen, means);
    add("exact, bilinear", Reconstruction::kBilinear, exact);
    add("exact, bicubic", Reconstruction::kBicubic, exact);
    add("exact, gouraud-screen", Reconstruction::kGouraudScreen, exact);
    for (const Reconstructed& one : reconstructed_)
      Shader(one.method, one.light.Shade(View(false), kFrameWidth, kFrameHeight));
    for (const auto& [method, kind] : {std::pair("gouraud-mesh", MeshKind::kGouraudMesh),
                                       std::pair("interpolant", MeshKind::kInterpolant)}) {
      pipeline_->BuildMesh(kind, {});
      Mesh(method);
    }
    Shader("exact at every point", RayShade(test_.scene, pipeline_->irradiance()));
    FindSwimming();
    FindClaims();
  }

 private:
  // The first camera, and the same turned about its axis by 45 degrees.
  Camera View(bool turned) const {
    Camera camera = test_.scene.cameras.front();
    if (turned) {
      const Vec3 along = (camera.look_at - camera.eye).normalized(),
                 right = along.cross(camera.up).normalized();
      camera.up = right + right.cross(along);
    }
    return camera;
  }

  StudyRow Row(const std::string& method) const {
    StudyRow row;
    row.scene = test_.name;
    row.method = method;
    row.setting = setting_;
    row.parameter = error_;
    row.elements = pipeline_->report().counts.elements;
    return row;
  }

  void Shader(const std::string& method, const RayShader& shader) {
    std::size_t next = 0;
    StudyRow row = Row(method);
    const double begin = ProcessorSeconds();
    SetErrors(ReferenceErrors(test_,
                              [&](const ReceiverPoint& at) -> std::optional<Rgb> {
                                const std::optional<PatchId> patch = patches_[next++];
                                return patch ? std::optional(shader({*patch, at.position})) : std::nullopt;
                              }),
              &row);
    row.seconds = ProcessorSeconds() - begin;
    Add(std::move(row));
  }

  void Mesh(const std::string& method) {
    StudyRow row = Row(method);
    row.triangles = pipeline_->mesh().triangles.size();
    const double begin = ProcessorSeconds();
    SetErrors(ReferenceErrors(test_, [&](const ReceiverPoint& at) { return ShownAt(*pipeline_, at); }), &row);
    row.seconds = ProcessorSeconds() - begin;
    Add(std::move(row));
  }

  void Add(StudyRow row) {
    rows_.push_back(row);
    log_->Add(std::move(row));
  }

  const StudyRow& RowOf(const std::string& method) const {
    return *std::find_if(rows_.begin(), rows_.end(),
                         [&](const StudyRow& row) { return row.method == method; });
  }

  // How much the light at one point changes when the camera turns about its axis.
  void FindSwimming() {
    const Reconstructed& gouraud = reconstructed_[2];
    const RayShader upright = gouraud.light.Shade(View(false), kFrameWidth, kFrameHeight),
                    turned = gouraud.light.Shade(View(true), kFrameWidth, kFrameHeight);
    double largest = 0, squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (!patches_[i]) continue;
      const RayPoint point = {*patches_[i], test_.points[i].position};
      const double before = upright(point).sum(), after = turned(point).sum();
      if (std::max(before, after) <= 0) continue;
      const double change = std::abs(after - before) / std::max(before, after);
      largest = std::max(largest, change);
      squares += change * change;
      ++count;
    }
    log_->Find(fmt::format(
        "{}, {}: when the camera turns about its axis by 45 degrees, Gouraud shading on the screen changes "
        "the "
        "light of a point by {:.2g} % (root mean square) and by up to {:.0f} %.",
        test_.name, setting_, 100 * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, count))),
        100 * largest));
  }

  // The root mean square of the error over points and channels, divided by the mean of the reference. Unlike
  // relative errors, the result is not that of the darkest points.
  double ShareOfMean(std::size_t method) const {
    const RayShader shader = reconstructed_[method].light.Shade(View(false), kFrameWidth, kFrameHeight);
    double squares = 0, sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      if (!patches_[i]) continue;
      const Rgb off = shader({*patches_[i], test_.points[i].position}) - test_.points[i].irradiance;
      squares += off.square().sum() / 3;
      sum += test_.points[i].irradiance.sum() / 3;
      ++count;
    }
    return std::sqrt(squares * static_cast<double>(count)) / sum;
  }

  RgbImage Draw(const RayShader& shader) const {
    RayDisplay display(test_.scene, shader, 1);
    return display.Render(View(false), kFrameWidth, kFrameHeight, {}).linear;
  }

  // Bastos, Goslin and Zhang measure 65.0 for bicubic and 69.7 for bilinear reconstruction, by a metric of
  // what an eye sees.
  void FindClaims() {
    const RgbImage exact = Draw(RayShade(test_.scene, pipeline_->irradiance()));
    const auto seen = [&](std::size_t i) {
      const RgbImage shown = Draw(reconstructed_[i].light.Shade(View(false), kFrameWidth, kFrameHeight));
      return FindVisibleDifference(exact, shown).mean;
    };
    for (const auto& [from, bilinear, bicubic] : {std::tuple("means", std::size_t{0}, std::size_t{1}),
                                                  std::tuple("exact", std::size_t{3}, std::size_t{4})}) {
      const StudyRow &linear = RowOf(reconstructed_[bilinear].method),
                     &cubic = RowOf(reconstructed_[bicubic].method);
      const double flip_linear = seen(bilinear), flip_cubic = seen(bicubic);
      log_->Find(fmt::format(
          "{}, {}, {} at the vertices: bicubic and bilinear pieces: root mean square error, as a share of "
          "the "
          "mean irradiance, {:.3g} and {:.3g} %; 99th percentile of the relative error {:.3g} and {:.3g} %; "
          "mean FLIP against exact irradiance at every pixel {:.4f} and {:.4f}, a ratio of {:.2f} (Bastos, "
          "by "
          "his metric: 65.0 / 69.7 = 0.93).",
          test_.name, setting_, from, 100 * ShareOfMean(bicubic), 100 * ShareOfMean(bilinear),
          100 * cubic.error_p99, 100 * linear.error_p99, flip_cubic, flip_linear, flip_cubic / flip_linear));
    }
  }

  ReferenceCase test_;
  std::string setting_;
  double error_;
  StudyLog* log_;
  std::unique_ptr<Pipeline> pipeline_;
  std::vector<std::optional<PatchId>> patches_;  // of the points of the reference
  std::vector<Reconstructed> reconstructed_;
  std::vector<StudyRow> rows_;
};

void StudyReconstruction(StudyLog& log) {
  const std::vector<std::string> scenes =
      log.quick() ? std::vector<std::string>{"floating-cube"} : std::vector<std::string>{"office", "cornell"};
  const std::vector<double> errors =
      log.quick() ? std::vector<double>{0.2} : std::vector<double>{0.1, 0.02, 0.005};
  for (const std::string& scene : scenes)
    for (const double error : errors) ReconstructionComparison(scene, error, &log).Run();
}

}  // namespace

extern const Study kReconstructionStudy;
const Study kReconstructionStudy = {
    "reconstruction",
    "What shows the light of elements: errors at the points of path-traced references",
    "Bicubic Hermite pieces are closer to the truth than bilinear ones (Bastos, Goslin and Zhang 1996); "
    "Gouraud "
    "shading on the screen moves with the camera.",
    "elements",
    "error_rms",
    StudyReconstruction};

}  // namespace penumbra
