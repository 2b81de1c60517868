#include "solver/scene/assimp_import.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <Eigen/LU>
#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>
#include <system_error>

#include "solver/base/read_file.h"
#include "solver/base/size.h"

namespace penumbra {
namespace {

// A file in memory.
class HeldFile final : public Assimp::MemoryIOStream {
 public:
  explicit HeldFile(std::string bytes) : HeldFile(std::make_unique<std::string>(std::move(bytes))) {}

 private:
  explicit HeldFile(std::unique_ptr<std::string> bytes)
      : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()),
        bytes_(std::move(bytes)) {}
  std::unique_ptr<std::string> bytes_;
};

// Gives Assimp the scene from memory, and files beside it from the disk; remembers which.
class FilesForAssimp final : public Assimp::IOSystem {
 public:
  FilesForAssimp(std::string main_path, const std::string& main_bytes, std::vector<std::string>& opened)
      : main_path_(std::move(main_path)), main_bytes_(main_bytes), opened_(opened) {}

  bool Exists(const char* path) const override {
    std::error_code ignored;
    return path == main_path_ || std::filesystem::is_regular_file(path, ignored);
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    if (path == main_path_) return new HeldFile(main_bytes_);
    if (!Exists(path)) return nullptr;
    try {
      auto* const file = new HeldFile(ReadFileBytes(path));
      opened_.emplace_back(path);
      return file;
    } catch (const ReadFailure&) {
      return nullptr;
    }
  }
  void Close(Assimp::IOStream* file) override { delete file; }

 private:
  std::string main_path_;
  const std::string& main_bytes_;
  std::vector<std::string>& opened_;
};

Eigen::Matrix4d MatrixOf(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column) matrix(row, column) = static_cast<double>(m[row][column]);
  return matrix;
}

Vec3 VecOf(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Vec3 RoundedToSingle(const Vec3& v) {
  return v.unaryExpr([](double x) { return static_cast<double>(static_cast<float>(x)); });
}

Rgb ColourOf(const aiMaterial& material, const char* key, const Rgb& otherwise) {
  aiColor3D colour;
  if (material.Get(key, 0, 0, colour) != AI_SUCCESS) return otherwise;
  return {static_cast<double>(colour.r), static_cast<double>(colour.g), static_cast<double>(colour.b)};
}

bool HasTexture(const aiMaterial& material) {
  for (unsigned i = 0; i < material.mNumProperties; ++i) {
    const aiMaterialProperty& property = *material.mProperties[i];
    if (std::string_view(property.mKey.C_Str()) != "$tex.file") continue;
    aiString file;
    if (material.Get("$tex.file", property.mSemantic, property.mIndex, file) == AI_SUCCESS && file.length > 0)
      return true;
  }
  return false;
}

ForeignMaterial MaterialOf(const aiMaterial& from) {
  ForeignMaterial material;
  material.name = from.GetName().C_Str();
  material.diffuse = ColourOf(from, "$clr.base", ColourOf(from, "$clr.diffuse", material.diffuse));
  material.emission = ColourOf(from, "$clr.emissive", Rgb::Zero());
  // FBX files of some writers give the emission by its older name only.
  if ((material.emission == 0).all()) material.emission = ColourOf(from, "$raw.Emissive", Rgb::Zero());
  material.textured = HasTexture(from);
  float opacity = 1;
  material.transparent = from.Get("$mat.opacity", 0, 0, opacity) == AI_SUCCESS && opacity < 1;
  int two_sided = 0;
  material.two_sided = from.Get("$mat.twosided", 0, 0, two_sided) == AI_SUCCESS && two_sided != 0;
  return material;
}

class Flattener {
 public:
  Flattener(const aiScene& from, const AssimpImport& how, ForeignScene& to)
      : from_(from), how_(how), to_(to) {}

  void Run() {
    for (unsigned i = 0; i < from_.mNumMaterials && how_.has_materials; ++i)
      to_.materials.push_back(MaterialOf(*from_.mMaterials[i]));
    Eigen::Matrix4d to_file = Eigen::Matrix4d::Identity();
    if (how_.turned) to_file.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    to_file.topRows<3>() /= how_.applied_unit;
    if (from_.mRootNode) AddNode(*from_.mRootNode, to_file);
    to_.cameras = static_cast<std::int32_t>(from_.mNumCameras);
    to_.animations = static_cast<std::int32_t>(from_.mNumAnimations);
    for (unsigned i = 0; i < from_.mNumMeshes; ++i)
      to_.coloured_meshes += from_.mMeshes[i]->HasVertexColors(0) ? 1 : 0;
    for (unsigned i = 0; i < from_.mNumLights; ++i)
      if (from_.mLights[i]->mType != aiLightSource_AMBIENT)
        to_.lights.emplace_back(from_.mLights[i]->mName.C_Str());
    if (!from_.mMetaData || how_.ending != "fbx") return;
    float centimetres = 0;
    if (from_.mMetaData->Get("UnitScaleFactor", centimetres))
      to_.centimetres = static_cast<double>(centimetres);
    from_.mMetaData->Get("UpAxis", to_.up);
  }

 private:
  void AddNode(const aiNode& node, const Eigen::Matrix4d& above) {
    const Eigen::Matrix4d matrix = above * MatrixOf(node.mTransformation);
    std::int32_t object = -1;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= from_.mNumMeshes)
        throw std::runtime_error("a node has a mesh that is not there");
      const aiMesh& mesh = *from_.mMeshes[node.mMeshes[i]];
      if (object < 0) object = NewObject(node.mName.length > 0 ? node.mName : mesh.mName);
      AddMesh(mesh, matrix, object);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) AddNode(*node.mChildren[i], matrix);
  }

  std::int32_t NewObject(const aiString& wanted) {
    const std::string base = wanted.length > 0 ? wanted.C_Str() : "default";
    std::string name = base;
    for (int k = 2; !names_.insert(name).second; ++k) name = base + "_" + std::to_string(k);
    to_.objects.push_back(name);
    return Size(to_.objects) - 1;
  }

  void AddMesh(const aiMesh& mesh, const Eigen::Matrix4d& matrix, std::int32_t object) {
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    const Vec3 shift = matrix.topRightCorner<3, 1>();
    const bool mirrored = linear.determinant() < 0;
    Vec3 largest = Vec3::Zero();
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& from = mesh.mFaces[f];
      if (from.mNumIndices < 3) {
        ++to_.lines_and_points;
        continue;
      }
      ForeignFace face = {Size(to_.corners), static_cast<std::int32_t>(from.mNumIndices), MaterialFor(mesh),
                          object};
      for (unsigned i = 0; i < from.mNumIndices; ++i) {
        if (from.mIndices[i] >= mesh.mNumVertices)
          throw std::runtime_error("a face has a vertex that is not there");
        const Vec3 local = VecOf(mesh.mVertices[from.mIndices[i]]);
        largest = largest.cwiseMax(local.cwiseAbs());
        to_.corners.push_back(RoundedToSingle(linear * local + shift));
        to_.places.push_back(PlaceOnPicture(mesh, from.mIndices[i]));
      }
      if (mirrored) std::reverse(to_.corners.end() - face.size, to_.corners.end());
      if (mirrored) std::reverse(to_.places.end() - face.size, to_.places.end());
      to_.faces.push_back(face);
    }
    AddRounding(linear.cwiseAbs() * largest + shift.cwiseAbs());
  }

  // Texture coordinates of the second set, where programs keep those of light maps, or else of the first.
  static Vec2 PlaceOnPicture(const aiMesh& mesh, unsigned vertex) {
    const unsigned set = mesh.HasTextureCoords(1) ? 1 : 0;
    if (!mesh.HasTextureCoords(set)) return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    return {mesh.mTextureCoords[set][vertex].x, mesh.mTextureCoords[set][vertex].y};
  }

  // -1 for the materials that Assimp makes up.
  std::int32_t MaterialFor(const aiMesh& mesh) const {
    const unsigned known = from_.mNumMaterials - (how_.has_default && from_.mNumMaterials > 0 ? 1 : 0);
    return how_.has_materials && mesh.mMaterialIndex < known ? static_cast<std::int32_t>(mesh.mMaterialIndex)
                                                             : -1;
  }

  // One unit of the last bit of the largest number that took part in an axis.
  void AddRounding(const Vec3& largest) {
    for (int axis = 0; axis < 3; ++axis)
      if (largest[axis] > 0 && std::isfinite(largest[axis]))
        to_.rounding[axis] =
            std::max(to_.rounding[axis], std::exp2(std::ilogb(largest[axis])) *
                                             static_cast<double>(std::numeric_limits<float>::epsilon()));
  }

  const aiScene& from_;
  const AssimpImport& how_;
  ForeignScene& to_;
  std::set<std::string> names_;
};

}  // namespace

ForeignScene ImportByAssimp(const std::string& bytes, const std::string& path, const AssimpImport& how) {
  ForeignScene scene;
  Assimp::Importer importer;
  // The importer owns and deletes it. The name's ending tells the format.
  const std::string main_path = path + "." + how.ending;
  importer.SetIOHandler(new FilesForAssimp(main_path, bytes, scene.files));
  importer.SetPropertyInteger(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  const aiScene* const from = importer.ReadFile(main_path, 0);
  if (!from) throw std::runtime_error(importer.GetErrorString());
  Flattener(*from, how, scene).Run();
  return scene;
}

}  // namespace penumbra
