// Whether the error that a user names is kept in rooms that nobody has tuned for: boxes at random, tilted,
// that cut each other and the walls, lights that hang just below the ceiling, at scales of millimetres to
// kilometres and far from the origin.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/random.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {
namespace {

constexpr double kAsked = 0.05, kQuickAsked = 0.2,
                 kFinerThan = 0.5;  // the solution that measures has this part of it
constexpr int kRooms = 20, kMaterials = 4, kMostBoxes = 5, kMostLights = 3;
constexpr std::size_t kPoints = 10'000, kQuickPoints = 300;
constexpr std::uint64_t kPointSeed = 77;

// Writes a room as an OBJ file with its materials.
class RoomWriter {
 public:
  explicit RoomWriter(std::uint64_t seed) : random_(seed) {
    scale_ = random_.LogUniform(1e-3, 1e3);
    if (random_.Uniform() < 0.5)
      for (int k = 0; k < 3; ++k) origin_[k] = scale_ * random_.Uniform(-1000, 1000);
    const Vec3 size(random_.Uniform(2, 6), random_.Uniform(2, 6), random_.Uniform(2, 4));
    for (int m = 0; m < kMaterials; ++m) AddMaterial(m);
    obj_ = "mtllib room.mtl\n";
    Box(0.5 * size, 0.5 * size, Eigen::Matrix3d::Identity(), /*inward=*/true);
    const auto boxes = 1 + random_.Index(kMostBoxes);
    for (std::uint32_t i = 0; i < boxes; ++i) AddBox(size);
    const auto lights = 1 + random_.Index(kMostLights);
    for (std::uint32_t i = 0; i < lights; ++i) AddLight(size);
  }

  Scene Read(const std::string& name) const {
    return ReadObjText(obj_, name + ".obj", [this](std::string_view) { return std::optional(mtl_); }, {});
  }

 private:
  void AddMaterial(int m) {
    mtl_ += fmt::format("newmtl grey{}\nKd {:.3f} {:.3f} {:.3f}\n", m, random_.Uniform(0.1, 0.85),
                        random_.Uniform(0.1, 0.85), random_.Uniform(0.1, 0.85));
    mtl_ += fmt::format("newmtl light{}\nKd 0 0 0\nKe {:.3f} {:.3f} {:.3f}\n", m, random_.Uniform(5, 50),
                        random_.Uniform(5, 50), random_.Uniform(5, 50));
  }

  // Half of them stand upright on the floor; of the others some are tilted.
  void AddBox(const Vec3& room) {
    const Vec3 half(random_.Uniform(0.05, 0.8), random_.Uniform(0.05, 0.8), random_.Uniform(0.05, 0.8));
    Vec3 middle(random_.Uniform(0, room.x()), random_.Uniform(0, room.y()), random_.Uniform(0, room.z()));
    Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random_.Uniform(0, std::numbers::pi), Vec3::UnitZ()).toRotationMatrix();
    if (random_.Uniform() < 0.5)
      middle.z() = half.z();
    else if (random_.Uniform() < 0.6)
      turn = turn * Eigen::AngleAxisd(random_.Uniform(0, std::numbers::pi), Vec3::UnitX());
    Box(middle, half, turn, /*inward=*/false);
  }

  void AddLight(const Vec3& room) {
    constexpr std::array kBelowCeiling = {0.0, 0.001, 0.02, 0.3};
    const double hx = random_.Uniform(0.1, 0.5), hy = random_.Uniform(0.1, 0.5);
    const double x = random_.Uniform(hx, room.x() - hx), y = random_.Uniform(hy, room.y() - hy);
    const double z = room.z() - kBelowCeiling[random_.Index(kBelowCeiling.size())];
    obj_ += fmt::format("usemtl light{}\n", random_.Index(kMaterials));
    for (const auto& [i, j] : {std::pair(-1, -1), {-1, 1}, {1, 1}, {1, -1}})
      Vertex({x + i * hx, y + j * hy, z});
    obj_ += "f -4 -3 -2 -1\n";
  }

  // Six faces in one material; their fronts look outward, or into the box.
  void Box(const Vec3& middle, const Vec3& half, const Eigen::Matrix3d& turn, bool inward) {
    for (int corner = 0; corner < 8; ++corner)
      Vertex(middle + turn * Vec3((corner & 1 ? 1 : -1) * half.x(), (corner & 2 ? 1 : -1) * half.y(),
                                  (corner & 4 ? 1 : -1) * half.z()));
    constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    obj_ += fmt::format("usemtl grey{}\n", random_.Index(kMaterials));
    for (const auto& face : kFaces) {
      std::array<int, 4> at = {face[0], face[1], face[2], face[3]};
      if (inward) std::reverse(at.begin(), at.end());
      obj_ += fmt::format("f {} {} {} {}\n", at[0] - 8, at[1] - 8, at[2] - 8, at[3] - 8);
    }
  }

  void Vertex(const Vec3& at) {
    const Vec3 p = origin_ + scale_ * at;
    obj_ += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
  }

  Random random_;
  double scale_ = 1;  // [m] a unit
  Vec3 origin_ = Vec3::Zero();
  std::string obj_, mtl_;
};

StudyRow MeasureRoom(const Scene& scene, double asked, std::size_t points, bool* told) {
  PipelineOptions options;
  options.error = asked;
  Pipeline pipeline(scene, options);
  const double begin = ProcessorSeconds();
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  StudyRow row;
  row.seconds = ProcessorSeconds() - begin;
  pipeline.Measure({});
  *told = pipeline.report().error_met;
  row.scene = scene.name;
  row.method = "random rooms";
  row.setting = fmt::format("--error {:g}", asked);
  row.parameter = asked;
  row.triangles = pipeline.report().counts.triangles;
  row.evaluations = pipeline.report().counts.point_evaluations;
  options.error = kFinerThan * asked;
  Pipeline finer(scene, options);
  finer.Solve({});
  finer.RefineLight({});
  finer.BuildMesh(MeshKind::kInterpolant, {});
  const RepresentationError error = MeasureRepresentationError(
      scene, pipeline.mesh(),
      [&](PatchId patch, const ReceiverPoint& at) { return finer.irradiance().OnPatch(patch, at); }, points,
      kPointSeed);
  CopyErrors(error, &row);
  return row;
}

void StudyRandomRooms(StudyLog& log) {
  const int rooms = log.quick() ? 1 : kRooms;
  const double asked = log.quick() ? kQuickAsked : kAsked;
  int kept = 0, told_right = 0;
  double worst = 0, seconds = 0;
  std::string missed;
  for (int room = 1; room <= rooms; ++room) {
    const std::string name = fmt::format("room {}", room);
    bool told = false;
    StudyRow row = MeasureRoom(RoomWriter(static_cast<std::uint64_t>(room)).Read(name), asked,
                               log.quick() ? kQuickPoints : kPoints, &told);
    const bool keeps = row.error_p99 <= asked;
    kept += keeps ? 1 : 0;
    told_right += keeps == told ? 1 : 0;
    worst = std::max(worst, row.error_p99);
    seconds += row.seconds;
    if (!keeps)
      missed += fmt::format("{}{} ({:.3g})", missed.empty() ? "; missed by " : ", ", name, row.error_p99);
    log.Add(std::move(row));
  }
  log.Find(fmt::format(
      "Of {} random rooms {} keep --error {:g} at the 99th percentile of {} fresh points, against "
      "a solution for {:g} of it; the report's `met` agrees in {}; the largest is {:.3g}; {:.3g} s of "
      "processors each{}.",
      rooms, kept, asked, log.quick() ? kQuickPoints : kPoints, kFinerThan, told_right, worst,
      seconds / rooms, missed));
}

}  // namespace

extern const Study kRandomRoomStudy;
const Study kRandomRoomStudy = {"random-rooms",
                                "Rooms that nobody has tuned for, asked for 5 %: seconds of processors "
                                "against the error of what is shown",
                                "The error that a user names is the error that a user gets, in any room.",
                                "seconds",
                                "error_p99",
                                StudyRandomRooms};

}  // namespace penumbra
