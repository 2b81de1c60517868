#include "solver/scene/obj_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "solver/base/read_file.h"
#include "solver/base/size.h"
#include "solver/scene/mtl_reader.h"
#include "solver/scene/scene_assembler.h"
#include "solver/scene/scene_frame.h"
#include "solver/scene/text_reader.h"
#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

// Statements of the format that add no polygon, or only say how one is shown.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vp",     "s",      "l",          "p",         "mg",     "bevel", "c_interp", "d_interp", "lod",
     "usemap", "maplib", "shadow_obj", "trace_obj", "cstype", "deg",   "bmat",     "step",     "parm",
     "trim",   "hole",   "scrv",       "sp",        "end",    "con",   "ctech",    "stech",
     "t",     // creases of subdivision surfaces
     "vw"});  // weights of joints
// Statements that add surfaces in ways that we do not read.
constexpr auto kNotRead = std::to_array<std::string_view>(
    {"curv", "curv2", "surf", "call", "csh", "bsp", "bzp", "cdc", "cdp", "res", "fo"});

bool Contains(const auto& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::int64_t Size64(const auto& list) { return static_cast<std::int64_t>(list.size()); }

// A face as it was read; its vertices may stand further down.
struct FaceLine {
  int line = 0;
  std::size_t first = 0;      // of its corners
  std::int32_t material = 0;  // in the order of `usemtl`; -1 for none
  std::int32_t object = 0;
};

// A name that `usemtl` asks for.
struct UsedMaterial {
  std::string name;
  int first_line = 0;
};

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view file, const MtlSource& mtl_source,
            const SceneOptions& options)
      : reader_(text, file), mtl_source_(mtl_source), options_(options), assembler_(file, options, scene_) {}

  Scene Parse();

 private:
  void ReadStatement();
  void ReadVertex();
  void ReadTextureVertex();
  void ReadFace();
  void ReadCorner(std::string_view word);
  void ReadLibraries();
  bool ReadLibrary(std::string_view name);
  void MissLibrary(std::string_view name);
  void Define(DefinedMaterial&& material, const std::string& file);
  void UseMaterial();
  void EnterObject();
  void EnterGroups();
  std::int32_t ObjectIndex(std::string_view name);
  std::vector<std::int32_t> ResolveMaterials();
  void CheckSize() const;
  void MakeFaces();
  std::size_t EndOfCorners(std::size_t face) const;
  Polygon3 MakePolygon(std::size_t face) const;
  std::vector<Vec2> TextureCoordinates(std::size_t face) const;
  void WarnOfStatements();
  // What strict reading refuses.
  void Refuse(int line, std::string_view message) const { assembler_.Refuse(line, message); }

  StatementReader reader_;
  const MtlSource& mtl_source_;
  const SceneOptions& options_;
  Scene scene_;
  SceneAssembler assembler_;
  std::vector<Vec3> vertices_;  // [m], z up
  std::vector<FaceLine> face_lines_;
  std::vector<std::int64_t> corners_;  // of all faces: 0-based vertices
  std::vector<Vec2> texture_vertices_;
  std::vector<std::int64_t> texture_corners_;  // of all faces: 0-based texture vertices, negative for none
  std::vector<UsedMaterial> used_;
  std::map<std::string, std::int32_t, std::less<>> used_index_, material_index_, object_index_;
  std::map<std::string, std::string, std::less<>> defined_at_;  // FILE:LINE of each material
  std::set<std::string, std::less<>> libraries_;                // read or missed
  std::int32_t material_ = -1;                                  // of the last `usemtl`
  std::int32_t object_ = -1;                                    // of the last `o`
  std::vector<std::int32_t> groups_;                            // of the last `g`
  Tally not_read_, missing_libraries_;
  std::vector<std::string> missing_library_names_;
  int redefined_ = 0;         // materials
  std::string redefinition_;  // the warning of the first one
  SceneFrame frame_ = {options_.unit.value_or(LengthUnit{"m"}), options_.up.value_or(UpAxis::kZ)};
  WrittenDigits digits_;
};

Scene ObjParser::Parse() {
  scene_.name = std::filesystem::path(reader_.File()).stem().string();
  while (reader_.Next()) ReadStatement();
  CheckSize();
  MakeFaces();
  WarnOfStatements();
  assembler_.Finish(frame_.Step(digits_.Step()));
  return std::move(scene_);
}

void ObjParser::ReadStatement() {
  const std::string_view keyword = reader_.Keyword();
  if (keyword == "v") return ReadVertex();
  if (keyword == "vt") return ReadTextureVertex();
  if (keyword == "vn") return;
  if (keyword == "f") return ReadFace();
  if (keyword == "o") return EnterObject();
  if (keyword == "g") return EnterGroups();
  if (keyword == "usemtl") return UseMaterial();
  if (keyword == "mtllib") return ReadLibraries();
  if (Contains(kNotRead, keyword)) {
    Refuse(reader_.Line(), Quoted(keyword) + " adds a surface in a way that is not read; export polygons");
    return not_read_.Add(reader_.Line());
  }
  if (keyword == "newmtl")
    throw reader_.Error("newmtl belongs into a material library; give the OBJ file that names it by mtllib");
  if (!Contains(kPassedOver, keyword))
    throw reader_.Error(Quoted(keyword) + " is no OBJ keyword; correct the line or remove it");
}

// x y z, and perhaps a weight or a colour, which mean nothing here.
void ObjParser::ReadVertex() {
  constexpr std::size_t kMost = 8;  // with a weight and a colour of four channels
  const std::vector<std::string_view> words = reader_.Values();
  if (words.size() < 3 || words.size() > kMost)
    throw reader_.Error("a vertex with " + Plural(Size(words), "number") + "; write v x y z");
  Vec3 vertex;
  for (int axis = 0; axis < 3; ++axis) {
    vertex[axis] = reader_.Number(words[axis]);
    if (std::abs(vertex[axis]) > kLargestCoordinate)
      throw reader_.Error(Quoted(words[axis]) +
                          " is too large for a coordinate, which may be up to 1e36; lengths are in metres");
    digits_.Add(axis, words[axis], vertex[axis]);
  }
  vertices_.push_back(frame_.Position(vertex));
}

// u and perhaps v; what is no number is not a number here either, and no error, since few uses need it.
void ObjParser::ReadTextureVertex() {
  Vec2 place(std::numeric_limits<double>::quiet_NaN(), 0);
  const std::vector<std::string_view> words = reader_.Values();
  for (std::size_t i = 0; i < std::min<std::size_t>(words.size(), 2); ++i) {
    double value = 0;
    const auto [last, error] = std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
    const bool fine = error == std::errc() && last == words[i].data() + words[i].size();
    place[static_cast<Eigen::Index>(i)] = fine ? value : std::numeric_limits<double>::quiet_NaN();
  }
  texture_vertices_.push_back(place);
}

// True if the text is empty or an integer: numbers of texture vertices and normals.
bool IsIndex(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return text.find_first_not_of("0123456789") == text.npos;
}

// The 0-based number of a texture vertex; negative for none, or one that cannot be.
std::int64_t TextureIndex(std::string_view text, std::int64_t above) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t index = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), index).ec != std::errc()) return -1;
  return index > 0 ? index - 1 : index < 0 ? above + index : -1;
}

// v, v/vt, v//vn or v/vt/vn: the vertex goes to the corners, the texture vertex to the texture corners.
void ObjParser::ReadCorner(std::string_view word) {
  const std::size_t end = std::min(word.find('/'), word.size());
  std::string_view rest = word.substr(end), digits = word.substr(0, end), texture;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  std::int64_t index = 0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  bool fine = !digits.empty() && error == std::errc() && last == digits.data() + digits.size();
  for (int part = 0; part < 2 && !rest.empty(); ++part) {
    rest.remove_prefix(1);
    const std::size_t stop = std::min(rest.find('/'), rest.size());
    fine = fine && IsIndex(rest.substr(0, stop));
    if (part == 0) texture = rest.substr(0, stop);
    rest.remove_prefix(stop);
  }
  if (!fine || !rest.empty())
    throw reader_.Error(Quoted(word) +
                        " is no vertex of a face; write v, v/vt, v//vn or v/vt/vn with integers");
  const std::int64_t above = Size64(vertices_);
  if (index == 0)
    throw reader_.Error("the vertex index 0 is out of range; the first vertex is 1, the last one above -1");
  if (index < 0 && index + above < 0)
    throw reader_.Error("the vertex index " + std::to_string(index) + " is out of range; there are " +
                        std::to_string(above) + " vertices above to count back from -1");
  corners_.push_back(index > 0 ? index - 1 : above + index);
  texture_corners_.push_back(TextureIndex(texture, Size64(texture_vertices_)));
}

void ObjParser::ReadFace() {
  FaceLine face;
  face.line = reader_.Line();
  face.first = corners_.size();
  for (const std::string_view word : reader_.Values()) ReadCorner(word);
  // Two vertices are an edge, as some modellers write it; a face without area to us.
  if (corners_.size() - face.first < (options_.strict ? 3 : 2))
    throw reader_.Error("a face with fewer than three vertices; give three or more");
  face.material = material_;
  std::vector<std::int32_t> owners = groups_;
  if (object_ >= 0) owners.insert(owners.begin(), object_);
  if (owners.empty()) owners.push_back(ObjectIndex("default"));
  face.object = owners.front();
  std::sort(owners.begin(), owners.end());
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  for (const std::int32_t owner : owners) scene_.objects[owner].faces.push_back(Size(face_lines_));
  face_lines_.push_back(face);
}

// The names on a line: each ends in ".mtl" or at the end, since names may hold blanks.
std::vector<std::string_view> LibraryNames(std::string_view arguments,
                                           const std::vector<std::string_view>& words) {
  constexpr std::string_view kEnding = ".mtl";
  std::vector<std::string_view> names;
  const char* begin = arguments.data();
  for (const std::string_view word : words) {
    const char* const end = word.data() + word.size();
    const std::string_view ending = word.substr(word.size() - std::min(word.size(), kEnding.size()));
    const bool is_end =
        std::equal(ending.begin(), ending.end(), kEnding.begin(), kEnding.end(),
                   [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    if (!is_end && end != arguments.data() + arguments.size()) continue;
    names.emplace_back(begin, static_cast<std::size_t>(end - begin));
    begin =
        std::find_if(end, arguments.data() + arguments.size(), [](char c) { return c != ' ' && c != '\t'; });
  }
  return names;
}

// One library whose name may hold blanks, or several.
void ObjParser::ReadLibraries() {
  const std::string_view arguments = reader_.Arguments();
  if (arguments.empty()) throw reader_.Error("mtllib without a name; write mtllib FILE.mtl");
  if (ReadLibrary(arguments)) return;
  const std::vector<std::string_view> words = reader_.Words();
  for (const std::string_view name : LibraryNames(arguments, words)) {
    if (ReadLibrary(name)) continue;
    bool any = false;
    for (const std::string_view word : words)
      if (word.data() >= name.data() && word.data() < name.data() + name.size() && word.size() < name.size())
        any = ReadLibrary(word) || any;
    if (!any) MissLibrary(name);
  }
}

// The names under which a library may lie beside the scene: as written, with blanks that are not escaped,
// with the separators of this system, and, where a path leads to another machine, by its last part.
std::vector<std::string> PlacesOf(std::string_view name) {
  if (name.size() > 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (!name.substr(i).starts_with("\\ ")) plain += name[i];
  std::string here = plain;
  std::replace(here.begin(), here.end(), '\\', '/');
  std::vector<std::string> places = {std::string(name), plain, here, here.substr(here.rfind('/') + 1)};
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

// False if there is no such library.
bool ObjParser::ReadLibrary(std::string_view name) {
  if (libraries_.contains(name)) return true;
  for (const std::string& place : PlacesOf(name)) {
    if (place.empty()) continue;
    const std::optional<std::string> text = mtl_source_(place);
    if (!text) continue;
    libraries_.emplace(name);
    if (!libraries_.insert(place).second && place != name) return true;
    const std::string file = (std::filesystem::path(reader_.File()).parent_path() / place).string();
    for (DefinedMaterial& material : ReadMtlText(*text, file, options_, scene_.warnings))
      Define(std::move(material), file);
    return true;
  }
  return false;
}

void ObjParser::MissLibrary(std::string_view name) {
  libraries_.emplace(name);
  Refuse(reader_.Line(), "the material library " + Quoted(name) +
                             " cannot be read; put it beside the scene or correct its name");
  missing_libraries_.Add(reader_.Line());
  missing_library_names_.emplace_back(name);
}

void ObjParser::Define(DefinedMaterial&& defined, const std::string& file) {
  const std::string name = defined.material.name;
  const auto [at, is_new] = material_index_.try_emplace(name, Size(scene_.materials));
  if (is_new) {
    scene_.materials.push_back(std::move(defined.material));
  } else {
    const std::string told =
        "the material " + Quoted(name) + " is defined a second time, after " + defined_at_[name];
    if (options_.strict) throw ErrorAt(file, defined.line, told + "; remove one, or rename it");
    if (redefined_++ == 0)
      redefinition_ = WarningAt(file, defined.line, told + "; this definition counts, the last of a name");
    scene_.materials[at->second] = std::move(defined.material);
  }
  defined_at_[name] = PlaceOf(file, defined.line);
}

void ObjParser::UseMaterial() {
  const std::string_view name = reader_.Arguments();
  auto found = used_index_.find(name);
  if (found == used_index_.end()) {
    found = used_index_.emplace(std::string(name), Size(used_)).first;
    used_.push_back({std::string(name), reader_.Line()});
  }
  material_ = found->second;
}

// Of each name that was used, the material. What is not defined is grey.
std::vector<std::int32_t> ObjParser::ResolveMaterials() {
  std::vector<std::int32_t> materials;
  std::vector<std::string> unknown;
  int first_line = 0;
  for (const UsedMaterial& used : used_) {
    const auto found = material_index_.find(used.name);
    if (found != material_index_.end()) {
      materials.push_back(found->second);
      continue;
    }
    if (used.name.empty()) {  // without a name: no material, unless a library defines one without a name
      materials.push_back(-1);
      continue;
    }
    Refuse(used.first_line, "the material " + Quoted(used.name) +
                                " is not defined; name its library with mtllib, or correct the name");
    if (unknown.empty()) first_line = used.first_line;
    unknown.push_back(used.name);
    materials.push_back(Size(scene_.materials));
    scene_.materials.emplace_back().name = used.name;
  }
  if (!unknown.empty())
    scene_.warnings.push_back(
        WarningAt(reader_.File(), first_line,
                  (unknown.size() == 1 ? "the material " : Plural(Size(unknown), "material") + ": ") +
                      QuotedList(unknown) + (unknown.size() == 1 ? " is" : ": are") +
                      " not defined, and 50 % grey; name the library with mtllib, or correct the name"));
  return materials;
}

// All that faces refer to lies in a box that is large enough.
void ObjParser::CheckSize() const {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const std::int64_t corner : corners_) {
    if (corner >= Size64(vertices_)) return;  // MakeFaces() tells
    low = low.cwiseMin(vertices_[corner]);
    high = high.cwiseMax(vertices_[corner]);
  }
  if (!corners_.empty()) assembler_.CheckSize(low, high);
}

std::size_t ObjParser::EndOfCorners(std::size_t face) const {
  return face + 1 < face_lines_.size() ? face_lines_[face + 1].first : corners_.size();
}

// The texture coordinates of a face's corners; none if one is missing.
std::vector<Vec2> ObjParser::TextureCoordinates(std::size_t face) const {
  std::vector<Vec2> places;
  for (std::size_t i = face_lines_[face].first; i < EndOfCorners(face); ++i) {
    const std::int64_t index = texture_corners_[i];
    if (index < 0 || index >= Size64(texture_vertices_) || !texture_vertices_[index].allFinite()) return {};
    places.push_back(texture_vertices_[index]);
  }
  return places;
}

// The vertices of a face, looked up. Throws InputError if one is not there.
Polygon3 ObjParser::MakePolygon(std::size_t face) const {
  const std::size_t end = EndOfCorners(face);
  Polygon3 polygon;
  polygon.reserve(end - face_lines_[face].first);
  for (std::size_t i = face_lines_[face].first; i < end; ++i) {
    if (corners_[i] >= Size64(vertices_))
      throw ErrorAt(reader_.File(), face_lines_[face].line,
                    "the vertex index " + std::to_string(corners_[i] + 1) + " is out of range; " +
                        (vertices_.empty() ? "the file has no vertices"
                                           : "use 1 to " + std::to_string(vertices_.size()) +
                                                 " for the vertices of the file, or count back from -1"));
    polygon.push_back(vertices_[corners_[i]]);
  }
  return polygon;
}

void ObjParser::MakeFaces() {
  assembler_.SetRounding(frame_.Step(digits_.Step()).norm());
  const std::vector<std::int32_t> materials = ResolveMaterials();
  std::int32_t without = -1;  // the material of faces without one
  scene_.faces.reserve(face_lines_.size());
  for (std::size_t i = 0; i < face_lines_.size(); ++i) {
    const FaceLine& line = face_lines_[i];
    Face face;
    face.vertices = MakePolygon(i);
    face.uv = TextureCoordinates(i);
    face.object = line.object;
    const std::int32_t material = line.material < 0 ? -1 : materials[line.material];
    if (material < 0 && without < 0) {
      without = Size(scene_.materials);
      scene_.materials.emplace_back().name = "default";
    }
    face.material = material < 0 ? without : material;
    assembler_.Add(std::move(face), line.line);
  }
}

std::int32_t ObjParser::ObjectIndex(std::string_view name) {
  const auto found = object_index_.find(name);
  if (found != object_index_.end()) return found->second;
  const auto index = static_cast<std::int32_t>(scene_.objects.size());
  object_index_.emplace(name, index);
  scene_.objects.push_back({std::string(name), {}});
  return index;
}

void ObjParser::EnterObject() {
  object_ = reader_.Arguments().empty() ? -1 : ObjectIndex(reader_.Arguments());
  groups_.clear();
}

void ObjParser::EnterGroups() {
  groups_.clear();
  for (const std::string_view name : reader_.Words()) groups_.push_back(ObjectIndex(name));
}

void ObjParser::WarnOfStatements() {
  if (reader_.LineEndedByCr() > 0)
    scene_.warnings.push_back(WarningAt(reader_.File(), reader_.LineEndedByCr(), kLinesEndInCr));
  if (missing_libraries_.count > 0)
    scene_.warnings.push_back(WarningAt(reader_.File(), missing_libraries_.first_line,
                                        Plural(missing_libraries_.count, "material librar", "y", "ies") +
                                            " cannot be read: " + QuotedList(missing_library_names_) +
                                            "; put it beside the scene, or correct the name"));
  if (redefined_ > 0)
    scene_.warnings.push_back(
        redefinition_ +
        (redefined_ > 1 ? "; " + std::to_string(redefined_ - 1) + " more are defined again below" : ""));
  assembler_.Warn(not_read_, "statement", "that only free-form surfaces or included files use, passed over");
}

class ObjReader final : public SceneReader {
 public:
  std::vector<std::string> Endings() const override { return {"obj"}; }
  Scene Read(const std::string& name, const SceneOptions& options) const override {
    return ReadObj(name, options);
  }
};

// The text of a library; nothing if there is none, or none that may be read.
std::optional<std::string> ReadLibraryFile(const std::filesystem::path& path) {
  try {
    return ReadFileBytes(path.string());
  } catch (const ReadFailure& failure) {
    if (!failure.Opened()) return std::nullopt;
    throw ErrorAt(path.string(), 0, failure.what());
  }
}

}  // namespace

Scene ReadObjText(std::string_view text, std::string_view file_name, const MtlSource& mtl_source,
                  const SceneOptions& options) {
  RefuseForeignFormat(text, file_name, "an OBJ file");
  return ObjParser(text, file_name, mtl_source, options).Parse();
}

Scene ReadObj(const std::filesystem::path& path, const SceneOptions& options) {
  std::string text;
  try {
    text = ReadFileBytes(path.string());
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path.string(), 0, std::string(failure.what()) + "; give an OBJ file that can be read");
  }
  const MtlSource beside = [&](std::string_view name) {
    const std::filesystem::path library = path.parent_path() / name;
    if (options.before_library) options.before_library(library.string());
    return ReadLibraryFile(library);
  };
  return ReadObjText(text, path.string(), beside, options);
}

SceneReaderRegistry::Method ObjReaderMethod() {
  return {"obj", "Wavefront OBJ with MTL; files that no other reader recognises, too", {}, [] {
            return std::make_unique<const ObjReader>();
          }};
}

}  // namespace penumbra
