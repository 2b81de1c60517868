#include "solver/scene/obj_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "solver/base/size.h"
#include "solver/scene/face_check.h"
#include "solver/scene/mtl_reader.h"
#include "solver/scene/patch_builder.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// Products of three coordinates and their squares stay finite.
constexpr double kLargestCoordinate = 1e50;

// Statements of the format that add no polygon, or only say how one is shown.
constexpr auto kPassedOver = std::to_array<std::string_view>(
    {"vp",     "s",      "l",          "p",         "mg",     "bevel", "c_interp", "d_interp", "lod",
     "usemap", "maplib", "shadow_obj", "trace_obj", "cstype", "deg",   "bmat",     "step",     "parm",
     "trim",   "hole",   "scrv",       "sp",        "end",    "con",   "ctech",    "stech"});
// Statements that add surfaces in ways that we do not read.
constexpr auto kNotRead = std::to_array<std::string_view>(
    {"curv", "curv2", "surf", "call", "csh", "bsp", "bzp", "cdc", "cdp", "res", "fo"});

bool Contains(const auto& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

std::string Plural(int count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

// How often something happened, and where first.
struct Tally {
  int count = 0, first_line = 0;

  void Add(int line) {
    if (count++ == 0) first_line = line;
  }
};

class ObjParser {
 public:
  ObjParser(std::string_view text, std::string_view file, const MtlSource& mtl_source,
            const SceneOptions& options)
      : reader_(text, file), mtl_source_(mtl_source), options_(options) {}

  Scene Parse();

 private:
  void ReadStatement();
  void ReadVertex();
  void ReadFace();
  std::int64_t ReadVertexIndex(std::string_view word) const;
  std::int64_t Resolve(std::int64_t index, std::int64_t count, std::string_view what,
                       std::string_view many) const;
  void ReadLibraries();
  void ReadLibrary(std::string_view name, const std::string& text);
  void UseMaterial();
  void EnterObject();
  void EnterGroups();
  std::int32_t DefaultMaterial();
  std::int32_t ObjectIndex(std::string_view name);
  void AddBacks();
  void BuildScenePatches();
  void Warn(const Tally& tally, std::string_view what, std::string_view outcome);

  StatementReader reader_;
  const MtlSource& mtl_source_;
  const SceneOptions& options_;
  Scene scene_;
  std::vector<Vec3> vertices_;
  std::int64_t texture_vertices_ = 0, normals_ = 0;  // that there are; nothing else of them is read
  std::vector<int> face_lines_;
  std::map<std::string, std::int32_t, std::less<>> material_index_, object_index_;
  std::set<std::string, std::less<>> libraries_;
  std::int32_t material_ = -1, default_material_ = -1;
  std::int32_t object_ = -1;          // of the last `o`
  std::vector<std::int32_t> groups_;  // of the last `g`
  Tally repeated_, flat_, not_read_;
};

Scene ObjParser::Parse() {
  scene_.name = std::filesystem::path(reader_.File()).stem().string();
  while (reader_.Next()) ReadStatement();
  if (options_.flip)
    for (Face& face : scene_.faces) std::reverse(face.vertices.begin(), face.vertices.end());
  if (options_.two_sided) AddBacks();
  Warn(repeated_, "face", "with repeated vertices, which were left out");
  Warn(flat_, "face", "without area dropped");
  Warn(not_read_, "statement", "that only free-form surfaces or included files use, passed over");
  BuildScenePatches();
  return std::move(scene_);
}

void ObjParser::ReadStatement() {
  const std::string_view keyword = reader_.Keyword();
  if (keyword == "v") return ReadVertex();
  if (keyword == "vt") return void(++texture_vertices_);
  if (keyword == "vn") return void(++normals_);
  if (keyword == "f") return ReadFace();
  if (keyword == "o") return EnterObject();
  if (keyword == "g") return EnterGroups();
  if (keyword == "usemtl") return UseMaterial();
  if (keyword == "mtllib") return ReadLibraries();
  if (Contains(kNotRead, keyword)) return not_read_.Add(reader_.Line());
  if (!Contains(kPassedOver, keyword))
    throw reader_.Error(Quoted(keyword) + " is no OBJ keyword; correct the line or remove it");
}

// x y z, and perhaps a weight or a colour, which mean nothing here.
void ObjParser::ReadVertex() {
  const std::vector<std::string_view> words = reader_.Words();
  if (words.size() < 3 || words.size() > 8)
    throw reader_.Error("a vertex with " + Plural(Size(words), "number") + "; write v x y z");
  Vec3 vertex;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double number = reader_.Number(words[i]);
    if (i >= 3) continue;
    if (std::abs(number) > kLargestCoordinate)
      throw reader_.Error(Quoted(words[i]) + " is too large for a coordinate; lengths are in metres");
    vertex[static_cast<Eigen::Index>(i)] = number;
  }
  vertices_.push_back(vertex);
}

// The 0-based vertex that v, v/vt, v//vn or v/vt/vn refers to.
std::int64_t ObjParser::ReadVertexIndex(std::string_view word) const {
  std::array<std::optional<std::int64_t>, 3> index;
  std::string_view rest = word;
  bool fine = true;
  for (int part = 0; part < 3; ++part) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const char* const stop = rest.data() + end;
    if (end > 0) {
      const auto [last, error] = std::from_chars(rest.data(), stop, index[part].emplace());
      fine = fine && error == std::errc() && last == stop;
    } else {
      fine = fine && part > 0;
    }
    const bool more = end < rest.size();
    rest.remove_prefix(more ? end + 1 : end);
    if (!more) break;
    fine = fine && part < 2;
  }
  if (!fine)
    throw reader_.Error(Quoted(word) +
                        " is no vertex of a face; write v, v/vt, v//vn or v/vt/vn with integers");
  if (index[1]) Resolve(*index[1], texture_vertices_, "texture vertex", "texture vertices");
  if (index[2]) Resolve(*index[2], normals_, "normal", "normals");
  return Resolve(*index[0], Size(vertices_), "vertex", "vertices");
}

// The 0-based place that an index means, of so many above it.
std::int64_t ObjParser::Resolve(std::int64_t index, std::int64_t count, std::string_view what,
                                std::string_view many) const {
  const std::int64_t place = index > 0 ? index - 1 : count + index;
  if (index != 0 && place >= 0 && place < count) return place;
  const std::string wrong =
      "the " + std::string(what) + " index " + std::to_string(index) + " is out of range; ";
  if (count == 0)
    throw reader_.Error(wrong + "there are no " + std::string(many) + " above; define them before the face");
  throw reader_.Error(wrong + "use 1 to " + std::to_string(count) + " for the " + std::string(many) +
                      " above, or count back from -1");
}

void ObjParser::ReadFace() {
  Face face;
  const std::vector<std::string_view> words = reader_.Words();
  for (const std::string_view word : words) face.vertices.push_back(vertices_[ReadVertexIndex(word)]);
  if (words.size() < 3) throw reader_.Error("a face with fewer than three vertices; give three or more");
  if (RemoveRepeatedVertices(face.vertices) > 0) repeated_.Add(reader_.Line());
  switch (CheckFace(face.vertices)) {
    case FaceCondition::kFine:
      break;
    case FaceCondition::kZeroArea:
      flat_.Add(reader_.Line());
      face.vertices.clear();
      break;
    case FaceCondition::kNotPlanar:
      throw reader_.Error("the face is not planar to 1e-6 of its diameter; split it into triangles");
    case FaceCondition::kSelfCrossing:
      throw reader_.Error("the face crosses itself; put its vertices in order, or split it");
  }
  face.material = material_ >= 0 ? material_ : DefaultMaterial();
  std::vector<std::int32_t> owners = groups_;
  if (object_ >= 0) owners.insert(owners.begin(), object_);
  if (owners.empty()) owners.push_back(ObjectIndex("default"));
  face.object = owners.front();
  std::sort(owners.begin(), owners.end());
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  for (const std::int32_t owner : owners)
    scene_.objects[owner].faces.push_back(static_cast<std::int32_t>(scene_.faces.size()));
  face_lines_.push_back(reader_.Line());
  scene_.faces.push_back(std::move(face));
}

// One library whose name may hold blanks, or several.
void ObjParser::ReadLibraries() {
  if (reader_.Arguments().empty()) throw reader_.Error("mtllib without a name; write mtllib FILE.mtl");
  if (libraries_.contains(reader_.Arguments())) return;
  if (const auto text = mtl_source_(reader_.Arguments())) return ReadLibrary(reader_.Arguments(), *text);
  for (const std::string_view name : reader_.Words()) {
    if (libraries_.contains(name)) continue;
    const auto text = mtl_source_(name);
    if (!text)
      throw reader_.Error("the material library " + Quoted(name) +
                          " cannot be read; put it beside the scene or correct its name");
    ReadLibrary(name, *text);
  }
}

void ObjParser::ReadLibrary(std::string_view name, const std::string& text) {
  libraries_.emplace(name);
  const std::string file = (std::filesystem::path(reader_.File()).parent_path() / name).string();
  for (Material& material : ReadMtlText(text, file, options_, scene_.warnings)) {
    material_index_[material.name] = static_cast<std::int32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
  }
}

void ObjParser::UseMaterial() {
  const auto found = material_index_.find(reader_.Arguments());
  if (found == material_index_.end())
    throw reader_.Error("the material " + Quoted(reader_.Arguments()) +
                        " is not defined; name its library with mtllib above, or correct the name");
  material_ = found->second;
}

std::int32_t ObjParser::DefaultMaterial() {
  if (default_material_ < 0) {
    default_material_ = static_cast<std::int32_t>(scene_.materials.size());
    scene_.materials.emplace_back();
    scene_.materials.back().name = "default";
  }
  return default_material_;
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

void ObjParser::AddBacks() {
  const auto count = static_cast<std::int32_t>(scene_.faces.size());
  for (std::int32_t i = 0; i < count; ++i) {
    Face back = scene_.faces[i];
    std::reverse(back.vertices.begin(), back.vertices.end());
    scene_.faces.push_back(std::move(back));
  }
  for (Object& object : scene_.objects) {
    const std::vector<std::int32_t> fronts = object.faces;
    for (const std::int32_t face : fronts) object.faces.push_back(count + face);
  }
}

void ObjParser::BuildScenePatches() {
  if (options_.change_materials) options_.change_materials(scene_.materials);
  Tally overlaps;
  std::set<std::int32_t> faces;  // a face and its back count once
  for (const std::int32_t face : BuildPatches(scene_).cut_faces) faces.insert(face % Size(face_lines_));
  for (const std::int32_t face : faces) overlaps.Add(face_lines_[face]);
  Warn(overlaps, "face", "cut where others lie in the same plane and look the same way");
}

void ObjParser::Warn(const Tally& tally, std::string_view what, std::string_view outcome) {
  if (tally.count == 0) return;
  scene_.warnings.push_back(WarningAt(reader_.File(), tally.first_line,
                                      Plural(tally.count, what) + " " + std::string(outcome) +
                                          (tally.count == 1 ? "" : "; the first is here")));
}

std::optional<std::string> ReadWholeFile(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

}  // namespace

Scene ReadObjText(std::string_view text, std::string_view file_name, const MtlSource& mtl_source,
                  const SceneOptions& options) {
  return ObjParser(text, file_name, mtl_source, options).Parse();
}

Scene ReadObj(const std::filesystem::path& path, const SceneOptions& options) {
  const std::optional<std::string> text = ReadWholeFile(path);
  if (!text)
    throw ErrorAt(path.string(), 0, "cannot be opened; check the name and the permission to read it");
  const MtlSource beside = [&](std::string_view name) {
    const std::filesystem::path library = path.parent_path() / name;
    if (options.before_library) options.before_library(library.string());
    return ReadWholeFile(library);
  };
  return ReadObjText(*text, path.string(), beside, options);
}

}  // namespace penumbra
