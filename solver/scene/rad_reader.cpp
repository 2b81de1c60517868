#include "solver/scene/rad_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/curved_surfaces.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/rad_materials.h"
#include "solver/scene/rad_text.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/transform_words.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

// Files whose commands name one another stop here.
constexpr int kDeepestCommand = 16;

// What a chain of xform commands does to the primitives that come through it.
struct RadPath {
  Placement placement;
  std::string modifier;  // instead of that of every surface; empty: none
  std::string prefix;    // before every name, with its dot
  bool inverted = false;
};

// Radiance gives radiance; everything else is as the user says.
SceneOptions WithRadiance(const SceneOptions& options) {
  SceneOptions changed = options;
  changed.emission_is_radiance = true;
  return changed;
}

std::string ReadRadBytes(const std::string& path) {
  try {
    return ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, std::string(failure.what()) + "; give a Radiance file that can be read");
  }
}

class RadParser {
 public:
  RadParser(const std::string& path, const SceneOptions& options)
      : options_(WithRadiance(options)), soup_(path, options_) {}

  Scene Parse() {
    Run(soup_.path(), {RadPath()});
    soup_.AddStep(placed_ ? Vec3(largest_linear_ * digits_.Step()) : digits_.Step());
    WarnOfLeftOut();
    return soup_.Finish("Radiance");
  }

 private:
  void Run(const std::string& path, const std::vector<RadPath>& ways);
  void RunPrimitive(const RadPrimitive& primitive, const std::string& file, const RadPath& way);
  void Command(const std::vector<std::string>& words, const std::string& file, const RadPath& way);
  std::vector<RadPath> XformWays(std::span<const std::string> words, std::vector<std::string>& files) const;
  void Box(std::span<const std::string> words, const std::vector<RadPath>& ways);
  void Surface(const RadPrimitive& primitive, const RadPath& way);
  std::vector<Polygon3> PolygonsOf(const RadPrimitive& primitive);
  void Add(std::vector<Polygon3> polygons, const std::string& modifier, const std::string& name,
           const RadPath& way);
  void WarnOfLeftOut();

  SceneOptions options_;
  PolygonSoup soup_;
  RadMaterials materials_;
  std::map<std::string, std::set<std::string>> left_out_;  // what, of which materials
  std::map<std::string, int> not_read_;                    // primitives, by type
  WrittenDigits digits_;
  bool placed_ = false;
  Eigen::Matrix3d largest_linear_ = Eigen::Matrix3d::Zero();
  int depth_ = 0, line_ = 0;
};

void RadParser::Run(const std::string& path, const std::vector<RadPath>& ways) {
  if (depth_ >= kDeepestCommand)
    throw InputError("files name one another more than 16 deep; remove the circle");
  const std::string text = ReadRadBytes(path);
  RefuseForeignFormat(text, path, "a Radiance scene");
  const std::vector<RadPrimitive> primitives = ReadRadText(text, path);
  ++depth_;
  for (const RadPath& way : ways)
    for (const RadPrimitive& primitive : primitives) {
      line_ = depth_ > 1 ? 0 : primitive.line;  // lines are told of the file that was named
      try {
        RunPrimitive(primitive, path, way);
      } catch (const InputError& error) {
        const std::string what = error.what();
        if (what.find(": error: ") != what.npos) throw;
        throw ErrorAt(
            path, primitive.line,
            (primitive.type == "!" ? "the command" : primitive.type + " " + Quoted(primitive.identifier)) +
                ": " + what);
      }
    }
  --depth_;
}

void RadParser::RunPrimitive(const RadPrimitive& primitive, const std::string& file, const RadPath& way) {
  if (primitive.type == "!") return Command(primitive.strings, file, way);
  if (primitive.type == "alias") return materials_.Alias(primitive);
  if (RadMaterials::IsModifier(primitive.type)) return materials_.Define(primitive);
  Surface(primitive, way);
}

// `xform ... FILES`, `genbox ...`, and either piped through further xforms.
void RadParser::Command(const std::vector<std::string>& words, const std::string& file, const RadPath& way) {
  std::vector<std::vector<std::string>> stages(1);
  for (const std::string& word : words) {
    if (word == "|")
      stages.emplace_back();
    else
      stages.back().push_back(word);
  }
  std::vector<RadPath> ways = {way};
  for (std::size_t i = stages.size(); i-- > 0;) {
    const std::vector<std::string>& stage = stages[i];
    const std::string program = stage.empty() ? "" : stage[0];
    const bool source = i == 0;
    if (program != "xform" && !(source && program == "genbox"))
      throw InputError(Quoted(program) +
                       " is not obeyed, only xform and genbox are; put what it prints into the file");
    if (program == "genbox") return Box(std::span(stage).subspan(1), ways);
    std::vector<std::string> files;
    std::vector<RadPath> next;
    for (const RadPath& inner : XformWays(std::span(stage).subspan(1), files))
      for (const RadPath& outer : ways)
        next.push_back({outer.placement.After(inner.placement),
                        outer.modifier.empty() ? inner.modifier : outer.modifier, outer.prefix + inner.prefix,
                        outer.inverted != inner.inverted});
    ways = std::move(next);
    if (source == files.empty()) throw InputError("xform takes its files at the beginning of a pipe only");
    for (const std::string& name : files) {
      const std::string path = (std::filesystem::path(file).parent_path() / name).string();
      if (options_.before_library) options_.before_library(path);
      Run(path, ways);
    }
  }
}

std::vector<RadPath> RadParser::XformWays(std::span<const std::string> words,
                                          std::vector<std::string>& files) const {
  RadPath rest;
  std::vector<std::string_view> moves;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "-m" || word == "-n") {
      if (i + 1 == words.size()) throw InputError(word + " takes a name");
      (word == "-m" ? rest.modifier : rest.prefix) = words[++i] + (word == "-n" ? "." : "");
    } else if (word == "-I") {
      rest.inverted = true;
    } else if (word != "-e" && word != "-c") {
      moves.emplace_back(word);
    }
  }
  std::size_t used = 0;
  const std::vector<Placement> placements = ReadPlacements(moves, used);
  files.assign(moves.begin() + static_cast<std::ptrdiff_t>(used), moves.end());
  for (const std::string& file : files)
    if (file.starts_with('-')) throw InputError(Quoted(file) + " is no option of xform that is known here");
  std::vector<RadPath> ways;
  for (const Placement& placement : placements) {
    ways.push_back(rest);
    ways.back().placement = placement;
  }
  return ways;
}

// genbox MATERIAL NAME X Y Z [-i]: the six sides of a box between the origin and (x, y, z), seen from
// outside, with -i from inside.
void RadParser::Box(std::span<const std::string> words, const std::vector<RadPath>& ways) {
  if (words.size() < 5) throw InputError("genbox takes a material, a name and three lengths");
  Vec3 size;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double> value = ToNumber(words[static_cast<std::size_t>(axis) + 2]);
    if (!value || !(*value > 0) || !std::isfinite(*value))
      throw InputError("the lengths of genbox are not above 0");
    size[axis] = *value;
  }
  bool inside = false;
  for (const std::string& option : words.subspan(5)) {
    if (option != "-i") throw InputError(Quoted(option) + " of genbox is not known here, only -i is");
    inside = true;
  }
  std::vector<Polygon3> sides;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      Polygon3 side(4, Vec3::Zero());
      side[1][u] = side[2][u] = size[u];
      side[2][v] = side[3][v] = size[v];
      for (Vec3& corner : side) corner[axis] = far ? size[axis] : 0;
      if (far == inside) std::reverse(side.begin(), side.end());
      sides.push_back(std::move(side));
    }
  }
  for (const RadPath& way : ways) Add(sides, words[0], words[1], way);
}

void RadParser::Surface(const RadPrimitive& primitive, const RadPath& way) {
  const std::string& type = primitive.type;
  if (type == "source" || type == "instance" || type == "mesh") {
    ++not_read_[type];
    return;
  }
  std::vector<Polygon3> polygons = PolygonsOf(primitive);
  Add(std::move(polygons), primitive.modifier, primitive.identifier, way);
}

std::vector<Polygon3> RadParser::PolygonsOf(const RadPrimitive& primitive) {
  const std::string& type = primitive.type;
  std::vector<double> x;
  for (const std::string& word : primitive.reals) x.push_back(*ToNumber(word));
  const auto expect = [&](std::size_t count) {
    if (x.size() != count) throw InputError(fmt::format("it has {} numbers; give {}", x.size(), count));
  };
  const auto point = [&](std::size_t i) { return Vec3(x[i], x[i + 1], x[i + 2]); };
  if (type == "polygon") {
    if (x.size() < 9 || x.size() % 3 != 0)
      throw InputError("it takes three numbers for each of three or more vertices");
    Polygon3 polygon;
    for (std::size_t i = 0; i < x.size(); ++i) digits_.Add(static_cast<int>(i % 3), primitive.reals[i], x[i]);
    for (std::size_t i = 0; i < x.size(); i += 3) polygon.push_back(point(i));
    return {polygon};
  }
  std::vector<Polygon3> polygons;
  if (type == "sphere" || type == "bubble") {
    expect(4);
    polygons = SpherePolygons(point(0), std::abs(x[3]));
    if ((type == "bubble") != (x[3] < 0)) polygons = Reversed(std::move(polygons));
  } else if (type == "ring") {
    expect(8);
    if (point(3).norm() == 0) throw InputError("its normal is zero; give a direction");
    polygons = RingPolygons(point(0), point(3), std::min(x[6], x[7]), std::max(x[6], x[7]));
  } else {
    const bool round = type == "cylinder" || type == "tube";
    expect(round ? 7 : 8);
    if (point(0) == point(3)) throw InputError("its axis has no length; give two points");
    polygons = ConePolygons(point(0), x[6], point(3), round ? x[6] : x[7]);
    if (type == "tube" || type == "cup") polygons = Reversed(std::move(polygons));
  }
  if (polygons.empty() || (type != "sphere" && type != "bubble" && (x[6] < 0 || x.back() < 0)))
    throw InputError("its radius is not above 0");
  return polygons;
}

void RadParser::Add(std::vector<Polygon3> polygons, const std::string& modifier, const std::string& name,
                    const RadPath& way) {
  const RadMaterial& material = materials_.Find(way.modifier.empty() ? modifier : way.modifier);
  if (!material.left_out.empty()) left_out_[material.left_out].insert(material.material.name);
  if (material.passed_over) return;
  const std::int32_t index = soup_.MaterialLike(material.material);
  const std::int32_t object = soup_.ObjectNamed(way.prefix + name);
  const Placement& placement = way.placement;
  largest_linear_ = largest_linear_.cwiseMax(placement.matrix.linear().cwiseAbs());
  const bool moved = !placement.matrix.matrix().isIdentity(0);
  placed_ = placed_ || moved;
  for (Polygon3& polygon : polygons) {
    if (moved)
      for (Vec3& corner : polygon) corner = placement.matrix * corner;
    if (placement.mirrored != way.inverted) std::reverse(polygon.begin(), polygon.end());
    const Polygon3 back(polygon.rbegin(), polygon.rend());
    soup_.Add(std::move(polygon), index, object, line_);
    // --two-sided gives every face a back.
    if (material.two_sided && !options_.two_sided) soup_.Add(back, index, object, line_);
  }
}

void RadParser::WarnOfLeftOut() {
  for (const auto& [what, names] : left_out_)
    soup_.warnings().push_back(
        WarningAt(soup_.path(), 0,
                  fmt::format("left out: {} of {}: {}", what, Plural(Size(names), "material"),
                              QuotedList({names.begin(), names.end()}))));
  for (const auto& [type, count] : not_read_)
    soup_.warnings().push_back(
        WarningAt(soup_.path(), 0,
                  fmt::format("left out: {} of the type {}{}", Plural(count, "primitive"), type,
                              type == "source" ? ", which shines from beyond the scene"
                                               : ", which is in another file")));
}

class RadReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"rad"}; }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    return ReadRad(name, options);
  }
};

}  // namespace

Scene ReadRad(const std::filesystem::path& path, const SceneOptions& options) {
  return RadParser(path.string(), options).Parse();
}

SceneReaderRegistry::Method RadReaderMethod() {
  return {"rad", "Radiance scene descriptions; xform and genbox are obeyed", {}, [] {
            return std::make_unique<const RadReader>();
          }};
}

}  // namespace penumbra
