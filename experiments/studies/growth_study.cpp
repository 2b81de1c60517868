// Growth: how time, links and memory grow with the rooms of a building and with the lights and blockers of a
// room, and times with pixels and threads.

#include <malloc.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "display/two_pass_display.h"
#include "experiments/bench/bench_scenes.h"
#include "experiments/studies/study.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/convex_solids.h"

namespace penumbra {
namespace {

// Begins to count the peak anew (Linux; where it cannot be told, the peak is that of the process so far, and
// buildings come in order of size).
void ForgetPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

// The most memory that this process has used since then [bytes].
std::size_t PeakBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoul(line.substr(6));  // given in KiB
  return 0;
}

// Solves scenes of growing size.
class Series {
 public:
  // Sizes are counts of `what`; corrections and interpolants come after the links where `whole` asks for
  // them.
  Series(std::string what, double error, bool whole, StudyLog* log)
      : what_(std::move(what)), whole_(whole), log_(log) {
    options_.error = error;
    options_.refine = RefineBy::kTransport;
    if (!whole) options_.max_corrections = 0;
  }

  void Solve(const Scene& scene, double size) {
    const ExecutionContext context;
    ForgetPeak();
    const Stopwatch stopwatch;
    const double begin = ProcessorSeconds();
    Pipeline pipeline(scene, options_);
    pipeline.Solve(context);
    if (whole_) pipeline.RefineLight(context);
    if (whole_) pipeline.BuildMesh(MeshKind::kInterpolant, context);
    StudyRow row;
    row.seconds = stopwatch.Seconds();
    const double processor = ProcessorSeconds() - begin;
    const PipelineReport::Counts& counts = pipeline.report().counts;
    row.scene = what_;
    row.method = whole_ ? "links, corrections, interpolants" : "links";
    row.setting =
        fmt::format("{}, error {:g}, {:.1f} s of processors", scene.name, options_.error, processor);
    row.parameter = size;
    row.elements = counts.elements;
    row.links = counts.links;
    row.bytes = PeakBytes();
    if (whole_) {
      row.triangles = counts.triangles;
      row.evaluations = counts.point_evaluations;
    }
    size_.push_back(size);
    processor_.push_back(processor);
    links_.push_back(static_cast<double>(counts.links));
    bytes_.push_back(static_cast<double>(*row.bytes));
    log_->Add(row);
  }

  void FindPowers() const {
    log_->Find(
        fmt::format("{}, {} to {} {}: seconds of processors grow as the power {:.2f} of their number, "
                    "links as {:.2f}, bytes as {:.2f}.",
                    whole_ ? "Whole solves" : "Links alone", size_.front(), size_.back(), what_,
                    LogSlope(size_, processor_), LogSlope(size_, links_), LogSlope(size_, bytes_)));
  }

 private:
  std::string what_;
  bool whole_;
  StudyLog* log_;
  PipelineOptions options_;
  std::vector<double> size_, processor_, links_, bytes_;
};

void GrowByRooms(StudyLog& log, const std::vector<int>& sides, double error, bool whole) {
  Series series("patches of a building", error, whole, &log);
  for (const int side : sides) {
    const Scene scene = *LoadBuiltinScene(fmt::format("building-{0}x{0}", side), {});
    series.Solve(scene, static_cast<double>(scene.patches.size()));
  }
  series.FindPowers();
}

// Calls place(x, y, side) for the cells of a square grid of n by n in a floor of 4 m by 4 m.
template <class Place>
void ForGrid(int n, const Place& place) {
  const double side = 4.0 / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) place((i + 0.5) * side, (j + 0.5) * side, side);
}

// A closed room of 4 m x 4 m x 3 m, with lights of 1 m^2 together below its ceiling and boxes of as much
// floor area in the air below them, both in square grids.
Scene Room(int lights_a_side, int boxes_a_side) {
  Scene scene;
  scene.name = fmt::format("room with {} lights and {} boxes", lights_a_side * lights_a_side,
                           boxes_a_side * boxes_a_side);
  scene.materials = GreyAndLight();
  AddBox(scene, {0, 0, 0}, {4, 4, 3}, true);
  ForGrid(lights_a_side, [&](double x, double y, double side) {
    const double h = side / 8, z = 2.9;
    AddPatch(scene, {{x - h, y - h, z}, {x - h, y + h, z}, {x + h, y + h, z}, {x + h, y - h, z}}, 1);
  });
  ForGrid(boxes_a_side, [&](double x, double y, double side) {
    const double h = side / 8;
    AddBox(scene, {x - h, y - h, 1 - h}, {x + h, y + h, 1 + h}, false);
  });
  FindConvexSolids(scene);
  return scene;
}

void GrowByLights(StudyLog& log, const std::vector<int>& sides, double error) {
  constexpr int kBoxes = 2;  // a side
  Series series("lights", error, true, &log);
  for (const int side : sides) series.Solve(Room(side, kBoxes), side * side);
  series.FindPowers();
}

void GrowByBlockers(StudyLog& log, const std::vector<int>& sides, double error) {
  Series series("blockers", error, true, &log);
  for (const int side : sides) series.Solve(Room(1, side), side * side);
  series.FindPowers();
}

// The display and solves of one scene: frames by pixels, then both by threads.
class OneScene {
 public:
  OneScene(const std::string& name, double error, StudyLog* log)
      : scene_(*LoadBuiltinScene(name, {})), log_(log) {
    options_.error = error;
    Pipeline pipeline(scene_, options_);
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    display_ = std::make_unique<TwoPassDisplay>(scene_, pipeline.mesh());
  }

  void GrowByPixels(const std::vector<int>& heights) {
    std::vector<double> pixels, seconds;
    for (const int height : heights) {
      const int width = 16 * height / 9;
      pixels.push_back(width * height);
      StudyRow row = Row("pixels", "a frame", fmt::format("{} x {}", width, height), pixels.back());
      row.seconds = MedianProcessorSeconds(kFrames, [&] { Frame(width, height); });
      row.triangles = display_->TriangleCount();
      seconds.push_back(row.seconds);
      log_->Add(row);
    }
    log_->Find(fmt::format(
        "Frames of {} triangles, {} to {} pixels: seconds of processors grow as the power {:.2f} of the "
        "pixels.",
        display_->TriangleCount(), pixels.front(), pixels.back(), LogSlope(pixels, seconds)));
  }

  // By wall clock, so that what else the machine does counts.
  void GrowByThreads(int width, int height) {
    const int all = ThreadCount();
    const Seconds alone = WithThreads(1, width, height);
    for (int threads = 2; threads <= all; ++threads) {
      const Seconds together = WithThreads(threads, width, height);
      log_->Find(
          fmt::format("{}, {} threads: a solve is {:.2f} times as fast as with one, a frame {:.2f} times.",
                      scene_.name, threads, alone.solve / together.solve, alone.frame / together.frame));
    }
    SetThreadCount(0);
  }

 private:
  static constexpr int kFrames = 31, kSolves = 3;  // of which the medians count

  struct Seconds {
    double solve, frame;
  };

  Seconds WithThreads(int threads, int width, int height) {
    SetThreadCount(threads);
    const std::string setting = fmt::format("{} threads", threads);
    StudyRow solve = Row("threads", "a solve", setting, threads);
    solve.seconds = MedianSeconds(kSolves, [&] {
      Pipeline pipeline(scene_, options_);
      pipeline.Solve({});
      pipeline.RefineLight({});
      pipeline.BuildMesh(MeshKind::kInterpolant, {});
    });
    log_->Add(solve);
    StudyRow frame = Row("threads", "a frame", fmt::format("{}, {} x {}", setting, width, height), threads);
    frame.seconds = MedianSeconds(kFrames, [&] { Frame(width, height); });
    log_->Add(frame);
    return {solve.seconds, frame.seconds};
  }

  void Frame(int width, int height) {
    display_->RenderScreen(scene_.cameras.front(), width, height, ShadingMode::kRadiosity, {0.01, true});
  }

  StudyRow Row(const std::string& what, const std::string& method, const std::string& setting,
               double size) const {
    StudyRow row;
    row.scene = what;
    row.method = method;
    row.setting = scene_.name + ", " + setting;
    row.parameter = size;
    return row;
  }

  Scene scene_;
  PipelineOptions options_;
  std::unique_ptr<TwoPassDisplay> display_;
  StudyLog* log_;
};

void StudyGrowth(StudyLog& log) {
  if (log.quick()) {
    constexpr double kHasty = 0.5;
    GrowByRooms(log, {1, 2}, kHasty, false);
    GrowByLights(log, {1, 2}, kHasty);
    GrowByBlockers(log, {1, 2}, kHasty);
    OneScene scene("floating-cube", kHasty, &log);
    scene.GrowByPixels({90, 180});
    return scene.GrowByThreads(160, 90);
  }
  constexpr double kError = 0.05;
  GrowByRooms(log, {1, 2, 3, 5, 10}, kError, true);
  GrowByRooms(log, {1, 2, 3, 5, 10}, kError, false);
  GrowByLights(log, {1, 2, 4, 6, 8}, kError);
  GrowByBlockers(log, {1, 2, 4, 6, 8}, kError);
  OneScene scene("office", kError, &log);
  scene.GrowByPixels({180, 360, 720, 1080, 2160});
  scene.GrowByThreads(1920, 1080);
}

}  // namespace

extern const Study kGrowthStudy;
const Study kGrowthStudy = {
    "growth",
    "Growth of time, links and memory with rooms, lights, blockers, pixels and threads",
    "What a room costs depends on what it sees, not on the building around it: exponents in polygons stay "
    "below 1.5, 25 rooms take a minute and 100 rooms less than 4 GB. Lights and blockers of one room cost in "
    "proportion to their number, frames to their pixels, and two threads are nearly twice as fast as one.",
    "parameter",
    "seconds",
    StudyGrowth};

}  // namespace penumbra
