// Writers of meshes and pictures: found by ending, listed, and joined by those of a program.

#include <gtest/gtest.h>

#include <filesystem>

#include "display/image_writers.h"
#include "display/mesh_writers.h"
#include "display/png_image.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/read_file.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

class TriangleCounter final : public MeshWriter {
 public:
  bool HasColours() const override { return false; }
  std::string Bytes(const MeshExport& from) const override {
    return std::to_string(from.mesh.triangles.size());
  }
};

class PlainPixels final : public ImageWriter {
 public:
  using ImageWriter::Bytes;
  bool IsLinear() const override { return false; }
  std::string Bytes(const Srgb8Image& image) const override {
    return {image.pixels.begin(), image.pixels.end()};
  }
};

void AddToyWriters() {
  static const bool added = [] {
    MeshWriters().Add(
        {"count", "how many triangles", {}, [] { return std::make_unique<const TriangleCounter>(); }});
    ImageWriters().Add({"raw", "pixels alone", {}, [] { return std::make_unique<const PlainPixels>(); }});
    return true;
  }();
  EXPECT_TRUE(added);
}

// Writers are listed, each with a line of help; a name that nobody has is refused.
TEST(Writers, AreListed) {
  AddToyWriters();
  EXPECT_EQ(MeshWriters().Names(), (std::vector<std::string>{"vtu", "ply", "glb", "html", "count"}));
  EXPECT_EQ(ImageWriters().Names(), (std::vector<std::string>{"png", "exr", "raw"}));
  for (const auto& method : MeshWriters().methods()) EXPECT_FALSE(method.help.empty());
  for (const auto& method : ImageWriters().methods()) EXPECT_FALSE(method.help.empty());
  EXPECT_THROW(MeshWriters().Find("guess"), InputError);
  EXPECT_THROW(ImageWriters().Find("guess"), InputError);
}

// Each format begins with its mark, even where the mesh is empty.
TEST(Writers, MeshesGoByEnding) {
  AddToyWriters();
  const auto bytes = [](const char* path) {
    const MeshWriterRegistry::Method* format = FindByEnding(MeshWriters(), path);
    return format ? format->make()->Bytes({Scene(), IrradianceMesh(), {}, 1}) : "";
  };
  EXPECT_TRUE(bytes("a.vtu").starts_with("<?xml"));
  EXPECT_TRUE(bytes("a.ply").starts_with("ply\n"));
  EXPECT_TRUE(bytes("a.glb").starts_with("glTF"));
  EXPECT_TRUE(bytes("a.html").starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(bytes("a.count"), "0");
  EXPECT_EQ(bytes("a.obj"), "");
}

// The ending says whether a picture is linear, and a format that a program added is written like the others.
TEST(Writers, PicturesGoByEnding) {
  AddToyWriters();
  EXPECT_TRUE(IsLinearImage("a.exr"));
  EXPECT_FALSE(IsLinearImage("a.png"));
  EXPECT_TRUE(IsScreenImage("a.png"));
  EXPECT_TRUE(IsScreenImage("a.raw"));
  EXPECT_FALSE(IsScreenImage("a.jpg"));
  EXPECT_FALSE(IsLinearImage("a.jpg"));
  EXPECT_EQ(ScreenImageEndings(), (std::vector<std::string>{"png", "raw"}));
  Srgb8Image image;
  image.Resize(2, 1);
  image.pixels = {1, 2, 3, 4, 5, 6};
  const fs::path folder = fs::temp_directory_path() / "penumbra_writers_test";
  fs::create_directory(folder);
  const std::string raw = (folder / "a.raw").string(), png = (folder / "a.png").string(),
                    other = (folder / "b.png").string();
  WriteImageFile(raw, image);
  WriteImageFile(png, image);
  WritePng(other, image);
  EXPECT_EQ(ReadFileBytes(raw), "\1\2\3\4\5\6");
  EXPECT_EQ(ReadFileBytes(png), ReadFileBytes(other));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace penumbra
