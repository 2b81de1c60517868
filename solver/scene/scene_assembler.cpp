#include "solver/scene/scene_assembler.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "solver/base/size.h"
#include "solver/scene/face_check.h"
#include "solver/scene/patch_builder.h"
#include "solver/scene/plane_overlaps.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// Areas of the faces of larger scenes, and products of areas, stay above the smallest doubles that have all
// digits [m].
constexpr double kSmallestScene = 1e-36;

// The texture coordinates of the vertices that are left of a polygon from which vertices were removed.
std::vector<Vec2> CoordinatesLeft(const Polygon3& given, const std::vector<Vec2>& uv, const Polygon3& left) {
  std::vector<Vec2> kept;
  std::size_t i = 0;
  for (const Vec3& vertex : left) {
    while (given[i] != vertex) ++i;
    kept.push_back(uv[i++]);
  }
  return kept;
}

// Three digits of a length or a share, for messages.
std::string ShortNumber(double value) { return fmt::format("{:.3g}", value); }

}  // namespace

std::string Plural(int count, std::string_view noun, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(noun) + std::string(count == 1 ? one : many);
}

void SceneAssembler::Refuse(int line, std::string_view message) const {
  if (options_.strict) throw ErrorAt(file_, line, message);
}

void SceneAssembler::CheckSize(const Vec3& low, const Vec3& high) const {
  const double across = (high - low).maxCoeff();
  if (across > 0 && across < kSmallestScene)
    throw ErrorAt(file_, 0,
                  "all faces lie within " + ShortNumber(across) +
                      " m, but a scene has to be larger than 1e-36 m; lengths are in metres");
}

// How a message calls the face that is being added: where no line can be told, by its number.
std::string SceneAssembler::FaceName(int line) const {
  return line > 0 ? "the face" : "face " + std::to_string(scene_.faces.size()) + " (counted from 0)";
}

// Mends the polygon, drops it (it is then empty), or throws InputError.
void SceneAssembler::Check(Polygon3& polygon, int line) {
  if (RemoveRepeatedVertices(polygon) > 0) {
    Refuse(line, FaceName(line) + " repeats a vertex; leave it out");
    repeated_.Add(line);
  }
  const FaceCheck check =
      CheckFace(polygon, {.cut = options_.max_off_plane.value_or(kCutTolerance), .rounding = rounding_});
  const auto off = [&] {
    return ShortNumber(check.off_plane) + " m, " + ShortNumber(100 * check.off_plane / check.diameter) +
           " % of its diameter";
  };
  switch (check.condition) {
    case FaceCondition::kFine:
      break;
    case FaceCondition::kZeroArea:
      Refuse(line, FaceName(line) + " has no area; remove it");
      flat_.Add(line);
      polygon.clear();
      break;
    case FaceCondition::kUneven: {
      Refuse(line, FaceName(line) + " is not planar to 1e-6 of its diameter: it is off by " + off() +
                       "; split it into triangles");
      uneven_.Add(line);
      largest_off_plane_ = std::max(largest_off_plane_, check.off_plane);
      largest_off_share_ = std::max(largest_off_share_, check.off_plane / check.diameter);
      break;
    }
    case FaceCondition::kFolded:
      throw ErrorAt(file_, line,
                    FaceName(line) + " is not planar: it is off by " + off() +
                        "; split it into triangles, or let it be cut with --max-off-plane");
    case FaceCondition::kSelfCrossing:
      throw ErrorAt(file_, line, FaceName(line) + " crosses itself; put its vertices in order, or split it");
  }
}

void SceneAssembler::Add(Face face, int line) {
  const Polygon3 given = face.uv.empty() ? Polygon3() : face.vertices;
  Check(face.vertices, line);
  if (!face.uv.empty()) face.uv = CoordinatesLeft(given, face.uv, face.vertices);
  scene_.faces.push_back(std::move(face));
  lines_.push_back(line);
}

void SceneAssembler::AddBacks() {
  const auto count = static_cast<std::int32_t>(scene_.faces.size());
  for (std::int32_t i = 0; i < count; ++i) {
    Face back = scene_.faces[static_cast<std::size_t>(i)];
    std::reverse(back.vertices.begin(), back.vertices.end());
    back.uv.clear();  // a place on a picture belongs to one side
    scene_.faces.push_back(std::move(back));
  }
  for (Object& object : scene_.objects) {
    const std::vector<std::int32_t> fronts = object.faces;
    for (const std::int32_t face : fronts) object.faces.push_back(count + face);
  }
}

void SceneAssembler::BuildScenePatches() {
  const PatchReport report = BuildPatches(scene_);
  const auto tally = [&](std::span<const std::int32_t> faces) {
    std::set<std::int32_t> once;  // a face and its back count once
    for (const std::int32_t face : faces) once.insert(face % Size(lines_));
    Tally of_faces;
    for (const std::int32_t face : once) of_faces.Add(lines_[static_cast<std::size_t>(face)]);
    return of_faces;
  };
  std::string cut = "cut where others lie in the same plane and look the same way";
  // Below a rounding there is nothing to tell.
  if (report.largest_distance > kCoplanarTolerance * scene_.Diagonal())
    cut += " (planes " + ShortNumber(report.largest_distance) + " m apart count as one)";
  Warn(tally(report.cut_faces), "face", cut);
  Warn(tally(report.narrow_faces), "face", "too narrow to hold a point left out");
}

void SceneAssembler::WarnOfRepairs() {
  Warn(repeated_, "face", "with repeated vertices, which were left out");
  Warn(flat_, "face", "without area dropped");
  Warn(uneven_, "face",
       "not planar to 1e-6 of the diameter and cut into triangles, at most " +
           ShortNumber(largest_off_plane_) + " m and " + ShortNumber(100 * largest_off_share_) +
           " % of the diameter off");
}

void SceneAssembler::Finish(const Vec3& coordinate_step) {
  if (options_.flip)
    for (Face& face : scene_.faces) {
      std::reverse(face.vertices.begin(), face.vertices.end());
      std::reverse(face.uv.begin(), face.uv.end());
    }
  if (options_.two_sided) AddBacks();
  WarnOfRepairs();
  if (options_.change_materials) options_.change_materials(scene_.materials);
  scene_.coordinate_step = coordinate_step;
  BuildScenePatches();
}

void SceneAssembler::Warn(const Tally& tally, std::string_view what, std::string_view outcome) {
  if (tally.count == 0) return;
  scene_.warnings.push_back(
      WarningAt(file_, tally.first_line,
                Plural(tally.count, what) + " " + std::string(outcome) +
                    (tally.count == 1 || tally.first_line == 0 ? "" : "; the first is here")));
}

}  // namespace penumbra
