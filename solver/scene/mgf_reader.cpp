#include "solver/scene/mgf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/curved_surfaces.h"
#include "solver/scene/file_format.h"
#include "solver/scene/mgf_colour.h"
#include "solver/scene/mgf_contexts.h"
#include "solver/scene/polygon_soup.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/transform_words.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

// Files that include one another stop here.
constexpr int kDeepestInclude = 16;
// Arrays of arrays stop here: no scene of so many statements fits into memory.
constexpr std::int64_t kMostStatements = 100'000'000;

struct MgfStatement {
  int line = 0;
  std::vector<std::string> words;  // the first is the keyword
};

struct MgfFile {
  std::string path;
  std::vector<MgfStatement> statements;
};

using MgfWords = std::span<const std::string_view>;

class MgfParser {
 public:
  MgfParser(const std::string& path, const SceneOptions& options) : options_(options), soup_(path, options) {}

  Scene Parse() {
    Include(soup_.path(), {Placement()});
    soup_.AddStep(placed_ ? Vec3(largest_linear_ * digits_.Step()) : digits_.Step());
    WarnOfLeftOut();
    return soup_.Finish("MGF, emittance `ed` in W/m^2");
  }

 private:
  void Include(const std::string& path, const std::vector<Placement>& placements);
  void RunBlock(const MgfFile& file, std::size_t begin, std::size_t end);
  std::size_t RunTransform(const MgfFile& file, std::size_t at, std::size_t end);
  void Obey(MgfWords words);
  bool ObeyVertex(std::string_view key, MgfWords values);
  bool ObeyColour(std::string_view key, MgfWords values);
  bool ObeyMaterial(std::string_view key, MgfWords values);
  bool ObeyFace(std::string_view key, MgfWords values);
  bool ObeySolid(std::string_view key, MgfWords values);
  void ObeyMix(MgfWords values);
  void ObeyPrism(MgfWords values);
  void ObeyFile(std::string_view key, MgfWords values);
  void EnterObject(MgfWords values);
  void AddPolygons(std::vector<Polygon3> polygons);
  void WarnOfLeftOut();
  void Expect(MgfWords values, std::size_t count) const;
  double NumberOf(std::string_view word) const;
  Rgb Amount(MgfWords values);
  const Vec3& Position(std::string_view name) { return vertices_.Find(name).position; }

  const SceneOptions& options_;
  PolygonSoup soup_;
  MgfContexts<MgfVertex> vertices_;
  MgfContexts<MgfColour> colours_;
  MgfContexts<MgfMaterial> materials_;
  std::vector<std::string> objects_;  // nested, by `o`
  Placement placement_;
  bool placed_ = false;                                       // some polygon is not where its vertices are
  Eigen::Matrix3d largest_linear_ = Eigen::Matrix3d::Zero();  // of the placements, by absolute value
  WrittenDigits digits_;
  std::set<std::string> specular_, transmitting_;  // materials that have such parts
  const MgfFile* file_ = nullptr;
  int line_ = 0, depth_ = 0;
  std::int64_t obeyed_ = 0;  // statements
};

MgfFile ReadMgfFile(const std::string& path) {
  std::string text;
  try {
    text = ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, std::string(failure.what()) + "; give an MGF file that can be read");
  }
  RefuseForeignFormat(text, path, "an MGF file");
  MgfFile file = {path, {}};
  StatementReader reader(text, path);
  while (reader.Next()) {
    MgfStatement statement = {reader.Line(), {std::string(reader.Keyword())}};
    for (const std::string_view word : reader.Values()) statement.words.emplace_back(word);
    file.statements.push_back(std::move(statement));
  }
  return file;
}

void MgfParser::Include(const std::string& path, const std::vector<Placement>& placements) {
  if (depth_ >= kDeepestInclude)
    throw InputError("files include one another more than 16 deep; remove the circle");
  const MgfFile file = ReadMgfFile(path);
  const MgfFile* const outer_file = std::exchange(file_, &file);
  const int outer_line = line_;
  const Placement outer = placement_;
  ++depth_;
  for (const Placement& placement : placements) {
    placement_ = outer.After(placement);
    RunBlock(file, 0, file.statements.size());
  }
  --depth_;
  placement_ = outer;
  line_ = outer_line;
  file_ = outer_file;
}

std::vector<std::string_view> ViewsOf(const std::vector<std::string>& words) {
  return {words.begin(), words.end()};
}

// Obeys the statements of a file. What goes wrong gets its place here.
void MgfParser::RunBlock(const MgfFile& file, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end;) {
    const MgfStatement& statement = file.statements[at];
    line_ = statement.line;
    try {
      if (++obeyed_ > kMostStatements) throw InputError("the arrays make more than 1e8 copies; make fewer");
      if (statement.words[0] == "xf") {
        at = RunTransform(file, at, end);
        continue;
      }
      Obey(ViewsOf(statement.words));
    } catch (const InputError& error) {
      const std::string what = error.what();
      if (what.find(": error: ") != what.npos) throw;
      throw ErrorAt(file.path, statement.line, Quoted(statement.words[0]) + ": " + what);
    }
    ++at;
  }
}

// Obeys what stands between `xf` with a transformation and the `xf` that ends it, for each of its copies.
// Returns the statement behind.
std::size_t MgfParser::RunTransform(const MgfFile& file, std::size_t at, std::size_t end) {
  const std::vector<std::string_view> words = ViewsOf(file.statements[at].words);
  if (words.size() == 1) throw InputError("it ends a transformation that was not begun; remove it");
  std::size_t last = at + 1;
  for (int open = 1; last < end; ++last) {
    if (file.statements[last].words[0] != "xf") continue;
    open += file.statements[last].words.size() > 1 ? 1 : -1;
    if (open == 0) break;
  }
  std::size_t used = 0;
  const std::vector<Placement> placements = ReadPlacements(MgfWords(words).subspan(1), used);
  if (used + 1 < words.size())
    throw InputError(Quoted(words[used + 1]) + " is no option of a transformation");
  const Placement outer = placement_;
  for (const Placement& placement : placements) {
    placement_ = outer.After(placement);
    RunBlock(file, at + 1, last);
  }
  placement_ = outer;
  return std::min(last + 1, end);
}

void MgfParser::Obey(MgfWords words) {
  const std::string_view key = words[0];
  const MgfWords values = words.subspan(1);
  if (ObeyVertex(key, values) || ObeyColour(key, values) || ObeyMaterial(key, values) ||
      ObeyFace(key, values) || ObeySolid(key, values))
    return;
  if (key == "o") return EnterObject(values);
  if (key == "i" || key == "ies") return ObeyFile(key, values);
  throw InputError("this is no keyword of MGF; correct the line or remove it");
}

void MgfParser::Expect(MgfWords values, std::size_t count) const {
  if (values.size() != count)
    throw InputError(fmt::format("it has {} values; give {}", values.size(), count));
}

double MgfParser::NumberOf(std::string_view word) const {
  const std::optional<double> value = ToNumber(word);
  if (!value || !std::isfinite(*value)) throw InputError(Quoted(word) + " is no finite number");
  return *value;
}

bool MgfParser::ObeyVertex(std::string_view key, MgfWords values) {
  if (key == "v") {
    vertices_.Select(values);
    return true;
  }
  if (key != "p" && key != "n") return false;
  Expect(values, 3);
  Vec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = values[static_cast<std::size_t>(axis)];
    vector[axis] = NumberOf(word);
    if (key == "p") digits_.Add(axis, word, vector[axis]);
  }
  (key == "p" ? vertices_.Current().position : vertices_.Current().normal) = vector;
  return true;
}

bool MgfParser::ObeyColour(std::string_view key, MgfWords values) {
  Vec3 xyz = Vec3::Zero();
  if (key == "c") {
    colours_.Select(values);
    return true;
  }
  if (key == "cmix") {
    ObeyMix(values);
    return true;
  }
  if (key == "cxy") {
    Expect(values, 2);
    const double x = NumberOf(values[0]), y = NumberOf(values[1]);
    if (!(x >= 0 && y > 0 && x + y <= 1 + 1e-9))
      throw InputError("no colour has this chromaticity; give x and y of CIE 1931, with x + y up to 1");
    xyz = ChromaticityXyz(x, y);
  } else if (key == "cct") {
    Expect(values, 1);
    const double temperature = NumberOf(values[0]);
    if (!(temperature >= 100 && temperature <= 1e6)) throw InputError("give a temperature from 100 to 1e6 K");
    xyz = BlackBodyXyz(temperature);
  } else if (key == "cspec") {
    if (values.size() < 3) throw InputError("it takes two wavelengths and the values between them");
    std::vector<double> numbers;
    for (const std::string_view word : values) numbers.push_back(NumberOf(word));
    xyz = SpectrumXyz(numbers[0], numbers[1], std::span(numbers).subspan(2));
  } else {
    return false;
  }
  if (!(xyz.y() > 0)) throw InputError("the colour has no luminance; give one that can be seen");
  colours_.Current().xyz = xyz;
  return true;
}

// Shares of luminance.
void MgfParser::ObeyMix(MgfWords values) {
  if (values.empty() || values.size() % 2 != 0)
    throw InputError("it takes pairs of a weight and the name of a colour");
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < values.size(); i += 2)
    sum += NumberOf(values[i]) * colours_.Find(values[i + 1]).xyz;
  if (!(sum.y() > 0)) throw InputError("the weights do not add up to more than 0");
  colours_.Current().xyz = sum / sum.y();
}

// The current colour, as much of it as the value says.
Rgb MgfParser::Amount(MgfWords values) {
  Expect(values, 1);
  const double amount = NumberOf(values[0]);
  if (amount < 0) throw InputError("the value is negative; give 0 or more");
  return MgfRgb(amount * colours_.Current().xyz);
}

bool MgfParser::ObeyMaterial(std::string_view key, MgfWords values) {
  if (key == "m") {
    materials_.Select(values);
    return true;
  }
  MgfMaterial& material = materials_.Current();
  if (key == "sides") {
    Expect(values, 1);
    if (values[0] != "1" && values[0] != "2") throw InputError("a surface has 1 or 2 sides");
    material.sides = values[0] == "1" ? 1 : 2;
  } else if (key == "rd") {
    material.reflectance = Amount(values);
  } else if (key == "ed") {
    material.emittance = Amount(values);
  } else if (key == "td") {
    material.transmits = (Amount(values) > 0).any();
  } else if (key == "rs" || key == "ts") {
    Expect(values, 2);
    (key == "rs" ? material.specular : material.transmits) = NumberOf(values[0]) > 0;
  } else {
    return key == "ir";  // the index of refraction, which only specular parts use
  }
  return true;
}

bool MgfParser::ObeyFace(std::string_view key, MgfWords values) {
  if (key != "f" && key != "fh") return false;
  // In a face with holes, '-' ends the outline and each hole; a doubled edge joins a hole to the outline.
  Polygon3 polygon, hole;
  const auto close_hole = [&] {
    if (hole.empty()) return;
    // Whichever way the file gives it: a hole runs against its outline.
    if (VectorArea(hole).dot(VectorArea(polygon)) > 0) std::reverse(hole.begin(), hole.end());
    const Vec3 back = polygon.back();
    polygon.insert(polygon.end(), hole.begin(), hole.end());
    polygon.push_back(hole.front());
    polygon.push_back(back);
    hole.clear();
  };
  bool in_hole = false;
  for (const std::string_view word : values) {
    if (key == "fh" && word == "-") {
      close_hole();
      in_hole = true;
    } else {
      (in_hole ? hole : polygon).push_back(Position(word));
    }
  }
  if (polygon.size() < 3) throw InputError("a face with fewer than three vertices; give three or more");
  close_hole();
  AddPolygons({polygon});
  return true;
}

// A solid whose radius is negative is seen from the inside.
bool MgfParser::ObeySolid(std::string_view key, MgfWords values) {
  std::vector<Polygon3> polygons;
  bool inside = false;
  const auto radius = [&](std::string_view word) {
    const double value = NumberOf(word);
    inside = inside || value < 0;
    return std::abs(value);
  };
  if (key == "sph") {
    Expect(values, 2);
    polygons = SpherePolygons(Position(values[0]), radius(values[1]));
  } else if (key == "cyl") {
    Expect(values, 3);
    const double r = radius(values[1]);
    polygons = ConePolygons(Position(values[0]), r, Position(values[2]), r);
  } else if (key == "cone") {
    Expect(values, 4);
    const double r0 = radius(values[1]), r1 = radius(values[3]);
    polygons = ConePolygons(Position(values[0]), r0, Position(values[2]), r1);
  } else if (key == "ring" || key == "torus") {
    Expect(values, 3);
    const MgfVertex& vertex = vertices_.Find(values[0]);
    if (vertex.normal.norm() == 0)
      throw InputError("its vertex has no normal; give the vertex one by n x y z");
    const double inner = radius(values[1]), outer = radius(values[2]);
    if (!(inner < outer)) throw InputError("its inner radius is not below its outer radius");
    polygons = key == "ring" ? RingPolygons(vertex.position, vertex.normal, inner, outer)
                             : TorusPolygons(vertex.position, vertex.normal, 0.5 * (inner + outer),
                                             0.5 * (outer - inner));
  } else if (key == "prism") {
    ObeyPrism(values);
    return true;
  } else {
    return false;
  }
  if (polygons.empty()) throw InputError("its radius is 0; give one above 0");
  AddPolygons(inside ? Reversed(std::move(polygons)) : std::move(polygons));
  return true;
}

// The face of the vertices looks outwards; the body extends behind it by the length, which is negative if it
// is seen from the inside.
void MgfParser::ObeyPrism(MgfWords values) {
  if (values.size() < 4) throw InputError("it takes three or more vertices and a length");
  const double length = NumberOf(values.back());
  Polygon3 top, bottom;
  for (const std::string_view name : values.first(values.size() - 1)) top.push_back(Position(name));
  const Vec3 normal = VectorArea(top);
  if (normal.norm() == 0 || length == 0) throw InputError("the prism has no volume; remove it");
  for (const Vec3& corner : top) bottom.push_back(corner - length * normal.normalized());
  std::vector<Polygon3> polygons = {top, {bottom.rbegin(), bottom.rend()}};
  for (std::size_t i = 0; i < top.size(); ++i) {
    const std::size_t next = (i + 1) % top.size();
    polygons.push_back({top[i], bottom[i], bottom[next], top[next]});
  }
  AddPolygons(std::move(polygons));
}

void MgfParser::ObeyFile(std::string_view key, MgfWords values) {
  if (key == "ies")
    throw InputError("luminaires of IES files are not read here; give faces that emit instead");
  if (values.empty()) throw InputError("it has no name; write i FILE");
  std::size_t used = 0;
  const std::vector<Placement> placements = ReadPlacements(values.subspan(1), used);
  if (used + 1 < values.size())
    throw InputError(Quoted(values[used + 1]) + " is no option of a transformation");
  const std::string path = (std::filesystem::path(file_->path).parent_path() / values[0]).string();
  if (options_.before_library) options_.before_library(path);
  Include(path, placements);
}

void MgfParser::EnterObject(MgfWords values) {
  if (!values.empty()) {
    objects_.emplace_back(values[0]);
  } else if (!objects_.empty()) {
    objects_.pop_back();
  } else {
    throw InputError("it ends an object that was not begun; remove it");
  }
}

void MgfParser::AddPolygons(std::vector<Polygon3> polygons) {
  const MgfMaterial& material = materials_.Current();
  const std::string name = materials_.CurrentName().empty() ? "unnamed" : materials_.CurrentName();
  if (material.specular) specular_.insert(name);
  if (material.transmits) transmitting_.insert(name);
  const std::int32_t index = soup_.MaterialLike({name, material.reflectance, material.emittance});
  std::string object;
  for (const std::string& part : objects_) object += (object.empty() ? "" : ".") + part;
  const std::int32_t object_index = soup_.ObjectNamed(object.empty() ? "default" : object);
  largest_linear_ = largest_linear_.cwiseMax(placement_.matrix.linear().cwiseAbs());
  const bool moved = !placement_.matrix.matrix().isIdentity(0);
  placed_ = placed_ || moved;
  const int line = depth_ > 1 ? 0 : line_;  // lines are told of the file that was named
  for (Polygon3& polygon : polygons) {
    if (moved)
      for (Vec3& corner : polygon) corner = placement_.matrix * corner;
    if (placement_.mirrored) std::reverse(polygon.begin(), polygon.end());
    const Polygon3 back(polygon.rbegin(), polygon.rend());
    soup_.Add(std::move(polygon), index, object_index, line);
    // --two-sided gives every face a back.
    if (material.sides == 2 && !options_.two_sided) soup_.Add(back, index, object_index, line);
  }
}

void MgfParser::WarnOfLeftOut() {
  const auto warn = [&](const char* what, const std::set<std::string>& names) {
    if (names.empty()) return;
    soup_.warnings().push_back(
        WarningAt(soup_.path(), 0,
                  fmt::format("left out: the {} parts of {}: {}", what, Plural(Size(names), "material"),
                              QuotedList({names.begin(), names.end()}))));
  };
  warn("specular", specular_);
  warn("transmitting", transmitting_);
}

class MgfReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"mgf"}; }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    return ReadMgf(name, options);
  }
};

}  // namespace

Scene ReadMgf(const std::filesystem::path& path, const SceneOptions& options) {
  return MgfParser(path.string(), options).Parse();
}

SceneReaderRegistry::Method MgfReaderMethod() {
  return {"mgf", "Materials and Geometry Format, as RenderPark reads it", {}, [] {
            return std::make_unique<const MgfReader>();
          }};
}

}  // namespace penumbra
