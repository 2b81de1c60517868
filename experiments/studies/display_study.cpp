// The thesis's figure 7-4 in numbers: what each way to show a solution is wrong by, pixel by pixel, against
// exact irradiance at every pixel, and what a frame of it takes of all processors.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "display/opengl_passes.h"
#include "display/ray_display.h"
#include "display/two_pass_display.h"
#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

constexpr int kFrames = 15;  // of which the median counts

struct Picture {
  int width = 0, height = 0;
  Camera camera;
};

struct Setting {
  std::string scene, name;
  PipelineOptions options;
  Picture picture;
};

// Relative errors of all channels of all pixels that show a surface in both.
std::vector<double> Errors(const RgbImage& shown, const std::vector<PixelKind>& kinds, const RgbImage& exact,
                           const std::vector<PixelKind>& exact_kinds) {
  std::vector<double> errors;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    std::size_t count = 0;
    const auto both = [&](std::size_t i) {
      return kinds[i] == PixelKind::kSurface && exact_kinds[i] == PixelKind::kSurface;
    };
    for (std::size_t i = 0; i < exact_kinds.size(); ++i)
      if (both(i)) {
        sum += static_cast<double>(exact.channel[c][i]);
        ++count;
      }
    const double floor = kDark * sum / static_cast<double>(std::max<std::size_t>(1, count));
    for (std::size_t i = 0; i < exact_kinds.size(); ++i) {
      const double want = static_cast<double>(exact.channel[c][i]);
      if (both(i) && std::max(want, floor) > 0)
        errors.push_back(std::abs(static_cast<double>(shown.channel[c][i]) - want) / std::max(want, floor));
    }
  }
  return errors;
}

class DisplayComparison {
 public:
  DisplayComparison(const Setting& setting, StudyLog* log)
      : setting_(setting),
        scene_(*LoadBuiltinScene(setting.scene, {})),
        pipeline_(scene_, setting.options),
        log_(log) {
    pipeline_.Solve({});
    pipeline_.RefineLight({});
    pipeline_.BuildMesh(MeshKind::kInterpolant, {});
    setting_.picture.camera = scene_.cameras.front();
  }

  void Run() {
    Exact();
    Lerp();
    TwoPass("interpolant", MeshKind::kInterpolant);
    OpenGl("interpolant, OpenGL", OpenGlCoordinates::kFloat);
    OpenGl("interpolant, OpenGL, 8-bit coordinates", OpenGlCoordinates::kTexture);
    TwoPass("gouraud-mesh", MeshKind::kGouraudMesh);
    TwoPass("gouraud", MeshKind::kGouraud);
    TwoPass("flat", MeshKind::kFlat);
    std::string line;
    for (const StudyRow& row : rows_) {
      if (row.method == "exact") continue;
      line += fmt::format("{}{} {:.2g} %, {:.3g} ms", line.empty() ? "" : "; ", row.method,
                          100 * row.error_p95, 1e3 * row.seconds);
    }
    log_->Find(fmt::format(
        "{}, {}: the 95th percentile of the error at {} x {} pixels, and a frame's processor time: {}; exact "
        "irradiance takes {:.3g} s.",
        setting_.scene, setting_.name, setting_.picture.width, setting_.picture.height, line,
        exact_seconds_));
  }

 private:
  void Exact() {
    RayDisplay display(scene_, RayShade(scene_, pipeline_.irradiance()), 1);
    const double begin = ProcessorSeconds();
    exact_ = display.Render(setting_.picture.camera, setting_.picture.width, setting_.picture.height, {});
    exact_seconds_ = ProcessorSeconds() - begin;
    StudyRow row = Row("exact");
    row.seconds = exact_seconds_;
    Add(std::move(row));
  }

  void Lerp() {
    RayDisplay display(scene_, LerpShade(scene_, pipeline_.mesh()), 1);
    const Picture& picture = setting_.picture;
    StudyRow row = Row("lerp");
    row.triangles = pipeline_.mesh().triangles.size();
    row.seconds =
        MedianProcessorSeconds(3, [&] { display.Render(picture.camera, picture.width, picture.height, {}); });
    SetErrors(Errors(display.picture().linear, display.picture().kind, exact_.linear, exact_.kind), &row);
    Add(std::move(row));
  }

  void TwoPass(const std::string& method, MeshKind kind) {
    pipeline_.BuildMesh(kind, {});
    TwoPassDisplay display(scene_, pipeline_.mesh());
    Measure(method, display);
  }

  void OpenGl(const std::string& method, OpenGlCoordinates coordinates) {
    try {
      TwoPassDisplay display(scene_, pipeline_.mesh(), OpenGlPasses(pipeline_.mesh(), coordinates));
      Measure(method, display);
    } catch (const InputError& error) {
      log_->Find(fmt::format("{} was left out: {}", method, error.what()));
    }
  }

  void Measure(const std::string& method, TwoPassDisplay& display) {
    const Picture& picture = setting_.picture;
    const ToneMapping tone{0.01, true};
    StudyRow row = Row(method);
    row.triangles = display.TriangleCount();
    row.seconds = MedianProcessorSeconds(kFrames, [&] {
      display.RenderScreen(picture.camera, picture.width, picture.height, ShadingMode::kRadiosity, tone);
    });
    const RenderedFrame& frame = display.Render(picture.camera, picture.width, picture.height);
    SetErrors(Errors(frame.linear, frame.kind, exact_.linear, exact_.kind), &row);
    Add(std::move(row));
  }

  StudyRow Row(const std::string& method) const {
    StudyRow row;
    row.scene = setting_.scene;
    row.method = method;
    row.setting = setting_.name;
    return row;
  }

  void Add(StudyRow row) {
    rows_.push_back(row);
    log_->Add(std::move(row));
  }

  Setting setting_;
  Scene scene_;
  Pipeline pipeline_;
  StudyLog* log_;
  SampledPicture exact_;
  double exact_seconds_ = 0;
  std::vector<StudyRow> rows_;
};

void StudyDisplay(StudyLog& log) {
  std::vector<Setting> settings;
  if (log.quick()) {
    PipelineOptions options;
    options.error = 0.1;
    settings.push_back({"floating-cube", "--error 0.1", options, {160, 120, {}}});
  } else {
    settings.push_back({"office", "thesis, chapter 7", ThesisSettings(), {640, 480, {}}});
    settings.push_back({"office", "--error 0.02", {}, {640, 480, {}}});
  }
  for (const Setting& setting : settings) DisplayComparison(setting, &log).Run();
}

}  // namespace

extern const Study kDisplayStudy;
const Study kDisplayStudy = {
    "display",
    "Ways to show a solution: error against exact irradiance at every pixel, and the time of a frame",
    "Interpolants on the discontinuity mesh show what irradiance at every pixel would, at the rate of "
    "Gouraud "
    "shading (Hardt 1996, figure 7-4); his texture of 8-bit coordinates is precise enough for a screen.",
    "seconds",
    "error_p95",
    StudyDisplay};

}  // namespace penumbra
