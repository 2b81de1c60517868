#include "solver/scene/ashdown_reader.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "solver/base/file_endings.h"
#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/ashdown_entity.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

constexpr std::string_view kEntityEnding = "ent";

std::string ReadAshdownBytes(const std::string& path) {
  try {
    return ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, std::string(failure.what()) + "; give a world or entity file that can be read");
  }
}

std::string InLowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The file called `name` in the folder; if there is none, the first one, by name, whose name differs only in
// upper and lower case. Worlds were written for systems that do not distinguish the cases, and that separate
// folders by backslashes.
std::filesystem::path FindEntityFile(const std::filesystem::path& folder, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const std::filesystem::path exact = folder / name;
  std::error_code error;
  if (std::filesystem::exists(exact, error)) return exact;
  const std::filesystem::path parent = exact.parent_path();
  std::vector<std::filesystem::path> alike;
  for (const auto& entry :
       std::filesystem::directory_iterator(parent.empty() ? std::filesystem::path(".") : parent, error))
    if (InLowerCase(entry.path().filename().string()) == InLowerCase(exact.filename().string()))
      alike.push_back(parent / entry.path().filename());
  return alike.empty() ? exact : *std::min_element(alike.begin(), alike.end());
}

// The rotation about a coordinate axis; exact for multiples of 90 degrees, so that walls stay in their
// planes.
Eigen::Matrix3d TurnAbout(int axis, double degrees) {
  const double turn = std::remainder(degrees, 360), quarters = turn / 90;
  const bool exact = quarters == std::round(quarters);
  const double angle = turn * std::numbers::pi / 180;
  const double sine = exact ? (quarters == 1 ? 1 : quarters == -1 ? -1 : 0) : std::sin(angle);
  const double cosine = exact ? (quarters == 0 ? 1 : std::abs(quarters) == 2 ? -1 : 0) : std::cos(angle);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(u, u) = matrix(v, v) = cosine;
  matrix(v, u) = sine;
  matrix(u, v) = -sine;
  return matrix;
}

struct AshdownInstance {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Vec3 move = Vec3::Zero();
  int line = 0;  // line of the world file
};

class AshdownWorldReader {
 public:
  AshdownWorldReader(const std::string& path, const SceneOptions& options)
      : path_(path), options_(options), soup_(path, options) {}

  Scene ReadWorld();
  Scene ReadOneEntity();

 private:
  const AshdownEntity& EntityAt(const std::filesystem::path& path);
  AshdownInstance ReadPlace(AshdownLines& lines);
  void Place(const AshdownEntity& entity, const AshdownInstance& instance);
  Scene Finish(std::string_view kind);

  std::string path_;
  const SceneOptions& options_;
  PolygonSoup soup_;
  std::map<std::filesystem::path, AshdownEntity> entities_;
  std::map<std::string, int> instances_of_;  // number of instances for each name of an entity
  WrittenDigits digits_;                     // of the translations
  std::size_t instances_ = 0, surfaces_ = 0, patches_ = 0, elements_ = 0, vertices_ = 0;
};

Scene AshdownWorldReader::ReadWorld() {
  const std::string text = ReadAshdownBytes(path_);
  RefuseForeignFormat(text, path_, "a world file (.wld)");
  AshdownLines lines(text, path_);
  if (!lines.Next()) throw lines.Error("the file is empty; it must begin with the line WORLD");
  while (true) {
    if (!lines.Next()) throw lines.Error("the file ends without the line END_FILE; give the whole file");
    if (lines.Rest() == "END_FILE") break;
    const int line = lines.line();
    const std::filesystem::path file =
        FindEntityFile(std::filesystem::path(path_).parent_path(), std::string(lines.Rest()));
    const auto absent = [&](const std::string& why) {
      return ErrorAt(path_, line,
                     fmt::format("the entity file {} {}; put it in the folder of the world",
                                 Quoted(file.string()), why));
    };
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw absent("does not exist");
    AshdownInstance instance = ReadPlace(lines);
    instance.line = line;
    Place(EntityAt(file), instance);
  }
  soup_.AddStep(digits_.Step());
  return Finish("a world of entities");
}

Scene AshdownWorldReader::ReadOneEntity() {
  Place(EntityAt(path_), {});
  return Finish("an entity");
}

const AshdownEntity& AshdownWorldReader::EntityAt(const std::filesystem::path& path) {
  const auto found = entities_.find(path);
  if (found != entities_.end()) return found->second;
  const std::string name = path.string();
  if (name != path_ && options_.before_library) options_.before_library(name);
  return entities_.emplace(path, ReadAshdownEntity(ReadAshdownBytes(name), name)).first->second;
}

// Reads the three lines of an instance: scaling, rotation and translation.
AshdownInstance AshdownWorldReader::ReadPlace(AshdownLines& lines) {
  const auto read = [&](std::string_view what) {
    if (!lines.Next()) throw lines.Error(fmt::format("the file ends before {}; give the whole file", what));
    const std::array<double, 3> values = lines.Bracketed<3>(what);
    return Vec3(values[0], values[1], values[2]);
  };
  AshdownInstance instance;
  const Vec3 scale = read("the factors of scaling: < x y z >");
  const int scale_line = lines.line();
  if (scale.prod() < 0)
    soup_.warnings().push_back(WarningAt(
        path_, scale_line,
        "a negative factor of scaling turns the fronts of the instance to its inside; give positive ones"));
  const Vec3 turn = read("the angles of rotation: < x y z >");
  instance.move = read("the translation: < x y z >");
  for (int axis = 0; axis < 3; ++axis)
    digits_.Add(axis, lines.words()[static_cast<std::size_t>(axis)], instance.move[axis]);
  instance.linear =
      TurnAbout(2, turn.z()) * TurnAbout(1, turn.y()) * TurnAbout(0, turn.x()) * scale.asDiagonal();
  return instance;
}

void AshdownWorldReader::Place(const AshdownEntity& entity, const AshdownInstance& instance) {
  const int number = ++instances_of_[entity.name];
  const std::int32_t object =
      soup_.ObjectNamed(number == 1 ? entity.name : fmt::format("{}_{}", entity.name, number));
  std::vector<std::int32_t> materials;
  for (const Material& surface : entity.surfaces) materials.push_back(soup_.MaterialLike(surface));
  for (const AshdownEntity::Patch& patch : entity.patches) {
    Polygon3 corners;
    for (const Vec3& corner : patch.corners) corners.push_back(instance.linear * corner + instance.move);
    soup_.Add(std::move(corners), materials[patch.surface], object, instance.line);
  }
  soup_.AddStep(instance.linear.cwiseAbs() * entity.step);
  ++instances_;
  surfaces_ += entity.surfaces.size();
  patches_ += entity.patches.size();
  elements_ += entity.elements;
  vertices_ += entity.vertices;
}

Scene AshdownWorldReader::Finish(std::string_view kind) {
  const auto count = [](std::size_t n, std::string_view noun) { return Plural(static_cast<int>(n), noun); };
  const std::string parts =
      fmt::format("{} ({}, {}, {}, {}, {})", kind, count(instances_, "instance"), count(surfaces_, "surface"),
                  Plural(static_cast<int>(patches_), "patch", "", "es"), count(elements_, "element"),
                  Plural(static_cast<int>(vertices_), "vert", "ex", "ices"));
  return soup_.Finish(parts);
}

class AshdownReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"wld", std::string(kEntityEnding)}; }
  // Names of such files are often in upper case.
  bool Recognises(const SceneSource& source) const override {
    return SceneReader::Recognises({InLowerCase(source.name), source.is_file, source.beginning});
  }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    return InLowerCase(EndingOf(name)) == kEntityEnding ? ReadAshdownEntityScene(name, options)
                                                        : ReadAshdownWorld(name, options);
  }
};

}  // namespace

Scene ReadAshdownWorld(const std::string& path, const SceneOptions& options) {
  return AshdownWorldReader(path, options).ReadWorld();
}

Scene ReadAshdownEntityScene(const std::string& path, const SceneOptions& options) {
  return AshdownWorldReader(path, options).ReadOneEntity();
}

SceneReaderRegistry::Method AshdownReaderMethod() {
  return {"wld", "the worlds and entities of Ashdown's book", {}, [] {
            return std::make_unique<const AshdownReader>();
          }};
}

}  // namespace penumbra
