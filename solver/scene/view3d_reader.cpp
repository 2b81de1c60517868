#include "solver/scene/view3d_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

struct View3dSurface {
  int line = 0;
  Polygon3 corners;
  std::string name;
  std::size_t base = 0, combined_with = 0;  // 1-based numbers of surfaces; 0: none
  double emittance = 1;                     // of heat radiation, = absorptance [1]
  bool obstructs_only = false;
};

// The words of a file, line by line. What follows an exclamation mark is a comment.
class View3dWords {
 public:
  View3dWords(std::string_view text, const std::string& path) : lines_(text), path_(path) {}

  // Advances to the next line with a word; false at the end of the file.
  bool NextLine() {
    while (!lines_.AtEnd()) {
      line_ = lines_.NextLine();
      const std::string_view whole = lines_.Take();
      rest_ = whole.substr(0, whole.find('!'));
      if (rest_.find_first_not_of(kBlanks) != rest_.npos) return true;
    }
    return false;
  }
  // The next word of the line; empty if the line has no more.
  std::string_view Word() {
    const std::size_t begin = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
    const std::size_t end = std::min(rest_.find_first_of(kBlanks, begin), rest_.size());
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
  }
  double Number(std::string_view what) {
    const std::string_view word = Word();
    const std::optional<double> value = ToNumber(word);
    if (!value || !std::isfinite(*value))
      throw Error(fmt::format("{} is missing or no number; found {}", what, Quoted(word)));
    return *value;
  }
  // The number, or 0, of one of `count` things.
  std::size_t Index(std::string_view what, std::size_t count) {
    const double value = Number(what);
    if (value < 0 || value > static_cast<double>(count) || value != std::floor(value))
      throw Error(fmt::format("{} is {:g}; it must be 0 to {}", what, value, count));
    return static_cast<std::size_t>(value);
  }
  double Coordinate(int axis, std::string_view what) {
    const std::string_view before = rest_;
    const double value = Number(what);
    rest_ = before;
    digits_.Add(axis, Word(), value);
    return value;
  }

  int line() const { return line_; }
  const WrittenDigits& digits() const { return digits_; }
  InputError Error(const std::string& message) const { return ErrorAt(path_, line_, message); }

 private:
  static constexpr std::string_view kBlanks = " \t,";

  LineReader lines_;
  const std::string& path_;
  std::string_view rest_;
  int line_ = 0;
  WrittenDigits digits_;
};

class View3dParser {
 public:
  View3dParser(std::string_view text, const std::string& path, const SceneOptions& options)
      : words_(text, path), soup_(path, options) {}

  Scene Parse() {
    while (words_.NextLine())
      if (!ReadLine()) break;
    AddSurfaces();
    soup_.AddStep(words_.digits().Step());
    return soup_.Finish("View3D, without emission");
  }

 private:
  bool ReadLine();
  void ReadVertex();
  void ReadSurface(char kind);
  void ReadAttributes(View3dSurface* surface);
  Polygon3 CornersByVertices();
  Polygon3 CornersByPosition(char shape);
  void AddSurfaces();
  void AddSurface(const View3dSurface& surface);

  View3dWords words_;
  PolygonSoup soup_;
  bool by_position_ = false;  // format 3a
  std::vector<Vec3> vertices_;
  std::vector<View3dSurface> surfaces_;
};

// Returns false at the line that ends the data.
bool View3dParser::ReadLine() {
  const std::string_view word = words_.Word();
  const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(word.front())));
  switch (kind) {
    case 'V':
      ReadVertex();
      return true;
    case 'S':
    case 'O':
      ReadSurface(kind);
      return true;
    case 'M':
    case 'N':
      throw words_.Error(
          "surfaces that mask a part of another are not supported; divide the base into surfaces around the "
          "opening, and combine them");
    case 'F': {
      const std::string_view format = words_.Word();
      by_position_ = format == "3a" || format == "3A";
      if (format != "3" && !by_position_)
        throw words_.Error(fmt::format("the geometry {} is neither 3 nor 3a", Quoted(format)));
      return true;
    }
    case 'E':
    case '*':
      return false;
    case 'T':
    case 'C':
    case 'X':
    case '/':
      return true;
    default:
      throw words_.Error(
          fmt::format("{} begins no line of View3D; known are T, C, F, V, S, O, E and !", Quoted(word)));
  }
}

void View3dParser::ReadVertex() {
  const double number = words_.Number("the vertex's number");
  if (number != static_cast<double>(vertices_.size() + 1))
    throw words_.Error(
        fmt::format("vertex {:g} should be {}: they are numbered in order", number, vertices_.size() + 1));
  Vec3 vertex;
  for (int axis = 0; axis < 3; ++axis) vertex[axis] = words_.Coordinate(axis, "a coordinate");
  vertices_.push_back(vertex);
}

void View3dParser::ReadSurface(char kind) {
  const double number = words_.Number("the surface's number");
  if (number != static_cast<double>(surfaces_.size() + 1))
    throw words_.Error(
        fmt::format("surface {:g} should be {}: they are numbered in order", number, surfaces_.size() + 1));
  View3dSurface surface;
  surface.line = words_.line();
  surface.obstructs_only = kind == 'O';
  const std::string_view shape = by_position_ ? words_.Word() : std::string_view();
  if (!by_position_) surface.corners = CornersByVertices();
  if (!surface.obstructs_only) ReadAttributes(&surface);
  if (by_position_) {
    if (shape.empty() || !words_.NextLine())
      throw words_.Error("a surface of format 3a has a shape, R, T or Q, and its geometry in the next line");
    surface.corners =
        CornersByPosition(static_cast<char>(std::toupper(static_cast<unsigned char>(shape.front()))));
  }
  if (surface.name.empty())
    surface.name =
        fmt::format("{}-{}", surface.obstructs_only ? "obstruction" : "surface", surfaces_.size() + 1);
  surfaces_.push_back(std::move(surface));
}

void View3dParser::ReadAttributes(View3dSurface* surface) {
  surface->base = words_.Index("the number of the base surface", surfaces_.size());
  surface->combined_with = words_.Index("the number of the surface to combine with", surfaces_.size());
  if (surface->combined_with > 0 && surfaces_[surface->combined_with - 1].combined_with > 0)
    throw words_.Error(fmt::format("surface {} is combined with another itself; name the first of them",
                                   surface->combined_with));
  surface->emittance = words_.Number("the emittance");
  if (surface->emittance <= 0 || surface->emittance > 1)
    throw words_.Error(fmt::format("the emittance {:g} must be above 0 and at most 1", surface->emittance));
  surface->name = words_.Word();
}

Polygon3 View3dParser::CornersByVertices() {
  Polygon3 corners;
  for (int i = 0; i < 4; ++i) {
    const std::size_t vertex = words_.Index("the number of a vertex", vertices_.size());
    if (vertex > 0)
      corners.push_back(vertices_[vertex - 1]);
    else if (i < 3)
      throw words_.Error("the first three vertices of a surface must be given; only the fourth may be 0");
  }
  return corners;
}

// Format 3a: the origin of the surface's frame, the azimuth from +y towards +x and the tilt from the
// horizontal [degrees] of its normal, and the corners in its frame: x to the left of someone who faces the
// normal's azimuth, y up the surface.
Polygon3 View3dParser::CornersByPosition(char shape) {
  constexpr double kDegree = std::numbers::pi / 180;
  Vec3 origin;
  for (int axis = 0; axis < 3; ++axis) origin[axis] = words_.Coordinate(axis, "a coordinate");
  const double azimuth = kDegree * words_.Number("the azimuth"), tilt = kDegree * words_.Number("the tilt");
  const Vec3 right(-std::cos(azimuth), std::sin(azimuth), 0);
  const Vec3 up(-std::cos(tilt) * std::sin(azimuth), -std::cos(tilt) * std::cos(azimuth), std::sin(tilt));
  const auto at = [&](double x, double y) { return Vec3(origin + x * right + y * up); };
  if (shape == 'R') {
    const double width = words_.Number("the width"), height = words_.Number("the height");
    return {at(0, height), at(0, 0), at(width, 0), at(width, height)};
  }
  if (shape != 'T' && shape != 'Q') throw words_.Error("the shape of a surface of format 3a is R, T or Q");
  Polygon3 corners;
  for (int i = 0; i < (shape == 'T' ? 3 : 4); ++i) {
    const double x = words_.Number("a corner's x"), y = words_.Number("a corner's y");
    corners.push_back(at(x, y));
  }
  return corners;
}

// Of faces that overlap in one plane the first is seen. A subsurface comes after its base in the file.
void View3dParser::AddSurfaces() {
  for (const View3dSurface& surface : surfaces_)
    if (surface.combined_with == 0) soup_.ObjectNamed(surface.name);
  for (std::size_t i = surfaces_.size(); i-- > 0;)
    if (surfaces_[i].base > 0) AddSurface(surfaces_[i]);
  for (const View3dSurface& surface : surfaces_)
    if (surface.base == 0) AddSurface(surface);
}

void View3dParser::AddSurface(const View3dSurface& surface) {
  const std::string& name =
      surface.combined_with > 0 ? surfaces_[surface.combined_with - 1].name : surface.name;
  const std::int32_t object = soup_.ObjectNamed(name);
  Material material;
  material.name = surface.obstructs_only ? "black" : fmt::format("emittance_{:g}", surface.emittance);
  material.reflectance = Rgb::Constant(surface.obstructs_only ? 0 : 1 - surface.emittance);
  const std::int32_t index = soup_.MaterialLike(material);
  soup_.Add(surface.corners, index, object, surface.line);
  if (surface.obstructs_only)
    soup_.Add(Polygon3(surface.corners.rbegin(), surface.corners.rend()), index, object, surface.line);
}

class View3dReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"vs3"}; }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    try {
      return ReadView3d(ReadFileBytes(name), name, options);
    } catch (const ReadFailure& failure) {
      throw ErrorAt(name, 0, std::string(failure.what()) + "; give a View3D file that can be read");
    }
  }
};

}  // namespace

Scene ReadView3d(std::string_view text, const std::string& path, const SceneOptions& options) {
  RefuseForeignFormat(text, path, "a View3D file");
  return View3dParser(text, path, options).Parse();
}

SceneReaderRegistry::Method View3dReaderMethod() {
  return {"vs3", "the vertices and surfaces of View3D", {}, [] {
            return std::make_unique<const View3dReader>();
          }};
}

}  // namespace penumbra
