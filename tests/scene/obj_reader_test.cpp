#include "solver/scene/obj_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <set>

#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/scene/face_check.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

constexpr std::string_view kMtl =
    "# a comment\n"
    "newmtl red\n"
    "Ns 10\n"
    "Kd 0.5 0.25 0.125\n"
    "newmtl lamp\n"
    "Kd 0\n"
    "Ke 1 2 3\n";

constexpr std::string_view kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Scene Read(std::string_view text, const SceneOptions& options = {}, std::string_view mtl = kMtl) {
  const MtlSource source = [&](std::string_view name) -> std::optional<std::string> {
    if (name == "a.mtl" || name == "with blank.mtl") return std::string(mtl);
    return std::nullopt;
  };
  return ReadObjText(text, "dir/scene.obj", source, options);
}

std::string ErrorOf(std::string_view text, const SceneOptions& options = {}, std::string_view mtl = kMtl) {
  try {
    Read(text, options, mtl);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ObjReader, ReadsFacesMaterialsAndNames) {
  // Every form of a face's vertices, comments, continued lines, CR LF and unread keywords are understood.
  const Scene scene = Read(
      "# scene\r\nmtllib a.mtl\r\no room\r\nv 0 0 0\r\nv 1 0 0 # corner\r\nv 1 1 0\r\nv 0 1 0\r\nvt 0 "
      "0\r\nvn 0 0 1\r\n"
      "usemtl red\r\ns off\r\nf 1 2 3 4\r\nf 1/1 2/1 3/1\r\nf -4//1 -3//1 -2//1\r\nusemtl lamp\r\n"
      "f 1/1/1 \\\r\n  2/1/1 \\\r\n  4/1/1\r\nl 1 2\r\n");
  ASSERT_EQ(scene.faces.size(), 4u);
  EXPECT_EQ(scene.name, "scene");
  EXPECT_THAT(scene.faces[0].vertices,
              ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(scene.faces[1].vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)));
  EXPECT_EQ(scene.faces[2].vertices, scene.faces[1].vertices);
  EXPECT_THAT(scene.faces[3].vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  const Material& red = scene.materials[scene.faces[0].material];
  EXPECT_EQ(red.name, "red");
  EXPECT_TRUE((red.reflectance == Rgb(0.5, 0.25, 0.125)).all());
  EXPECT_TRUE((red.emittance == 0).all());
  const Material& lamp = scene.materials[scene.faces[3].material];
  EXPECT_TRUE((lamp.emittance == Rgb(1, 2, 3)).all());
  EXPECT_TRUE((lamp.reflectance == 0).all());
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "room");
  EXPECT_THAT(scene.objects[0].faces, ElementsAre(0, 1, 2, 3));
}

TEST(ObjReader, WithoutMaterialGreyAndWithoutFacesDark) {
  // A face without a material is 50 % grey; a scene without faces is valid.
  const Scene scene = Read(std::string(kSquare) + "f 1 2 3 4");
  EXPECT_TRUE((scene.materials[scene.faces[0].material].reflectance == 0.5).all());
  EXPECT_EQ(scene.objects[scene.faces[0].object].name, "default");
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(Read("").patches, IsEmpty());
  EXPECT_THAT(Read("# nothing\n").warnings, IsEmpty());
}

TEST(ObjReader, ObjectsAndGroupsAreBothFound) {
  // A face is listed under its object and under each of its groups; its own name is the object's.
  const Scene scene =
      Read(std::string(kSquare) +
           "g a b\nf 1 2 3\no desk top\nf 1 2 3\ng leg\nf 1 2 3\no leg\nf 1 2 3\ng\nf 1 2 4\n");
  const auto faces = [&](std::string_view name) {
    for (const Object& object : scene.objects)
      if (object.name == name) return object.faces;
    return std::vector<std::int32_t>{-1};
  };
  EXPECT_THAT(faces("a"), ElementsAre(0));
  EXPECT_THAT(faces("b"), ElementsAre(0));
  EXPECT_THAT(faces("desk top"), ElementsAre(1, 2));
  EXPECT_THAT(faces("leg"), ElementsAre(2, 3, 4));
  EXPECT_EQ(scene.objects[scene.faces[0].object].name, "a");
  EXPECT_EQ(scene.objects[scene.faces[2].object].name, "desk top");
}

TEST(ObjReader, NumbersAreCorrectlyRounded) {
  // Decimal numbers halfway between doubles, denormal and huge ones get the nearest double.
  const Scene scene = Read(
      "v 0.1 +0.2 .3\nv 1.00000000000000011102230246251565 1.00000000000000011102230246251566 "
      "9007199254740993\n"
      "v 4.9e-324 1e-400 -0.30000000000000004\nv 1e22 3.0e0 7.2057594037927933e16\nf 1 2 3\nf 1 2 4\n");
  const Polygon3& a = scene.faces[0].vertices;
  EXPECT_EQ(a[0], Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(a[1], Vec3(1, std::nextafter(1, 2), 9007199254740992));
  EXPECT_EQ(a[2], Vec3(std::numeric_limits<double>::denorm_min(), 0, -0.30000000000000004));
  EXPECT_EQ(scene.faces[1].vertices[2], Vec3(1e22, 3, 72057594037927936));
}

TEST(ObjReader, OptionsChangeLightAndReflectance) {
  // Radiance times pi is emittance; too large reflectances are clamped where that is asked for, and said.
  const std::string text = "mtllib a.mtl\n" + std::string(kSquare) + "usemtl lamp\nf 1 2 3 4\n";
  const Scene radiance = Read(text, {.emission_is_radiance = true});
  EXPECT_TRUE((radiance.materials[1].emittance == Rgb(1, 2, 3) * std::numbers::pi).all());
  const Scene clamped = Read(text, {.max_reflectance = 0.9}, "newmtl lamp\nKd 1.5 0.5 1\n");
  EXPECT_TRUE((clamped.materials[0].reflectance == Rgb(0.9, 0.5, 0.9)).all());
  EXPECT_THAT(clamped.warnings, ElementsAre(StartsWith("dir/a.mtl:2: warning: 1 reflectance")));
}

TEST(ObjReader, TwoSidedRepeatsFacesReversed) {
  // The back of face i has the index n + i, its vertices reversed, and belongs to the same objects.
  const Scene scene =
      Read("o wall\n" + std::string(kSquare) + "f 1 2 3 4\nf 1 1 1\nf 1 2 3\n", {.two_sided = true});
  ASSERT_EQ(scene.faces.size(), 6u);
  EXPECT_THAT(scene.faces[3].vertices,
              ElementsAre(Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)));
  EXPECT_THAT(scene.faces[4].vertices, IsEmpty());
  EXPECT_THAT(scene.objects[0].faces, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(scene.warnings, testing::Contains(StartsWith("dir/scene.obj:8: warning: 1 face cut")));
}

// Texture coordinates stay with their vertices: through repeated vertices, numbers from the end and reversed
// faces. A face has none if one of its corners has none, or one that is no number.
TEST(ObjReader, TextureCoordinatesStayWithTheirVertices) {
  const std::string text = std::string(kSquare) +
                           "vt 0 0\nvt 1 0 0.5\nvt 1 1\nvt 0.25\nvt x 1\n"
                           "f 1/1 2/2 2/3 3/3/ 4/4/1\n"  // the second of two equal vertices goes
                           "f 1/-5 2/-4 3/-3 4/-2\n"
                           "f 1/1 2/2 3/3 4\n"
                           "f 1/1 2/2 3/3 4/5\n"
                           "f 1/1 2/2 3/3 4/9\n"
                           "f 1//1 2//1 3//1\n";
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0.25, 0}};
  const Scene scene = Read(text);
  EXPECT_EQ(scene.faces[0].uv, square);
  EXPECT_EQ(scene.faces[1].uv, square);
  for (std::size_t f = 2; f < 6; ++f) EXPECT_THAT(scene.faces[f].uv, IsEmpty());
  SceneOptions flip, two_sided;
  flip.flip = two_sided.two_sided = true;
  EXPECT_EQ(Read(text, flip).faces[0].uv, (std::vector<Vec2>(square.rbegin(), square.rend())));
  const Scene both = Read(text, two_sided);
  EXPECT_EQ(both.faces[0].uv, square);
  EXPECT_THAT(both.faces[6].uv, IsEmpty());
}

TEST(ObjReader, RepairsAreCountedAndNumbersKept) {
  // Repeated vertices and flat faces are mended or dropped with one warning a kind; a dropped face keeps its
  // number.
  const Scene scene =
      Read(std::string(kSquare) + "v 2 0 0\nv 0 0 0\nf 1 2 5\nf 1 1 2 3\nf 6 2 3 1\nf 1 2\\\n 1\nf 3 4 1\n");
  ASSERT_EQ(scene.faces.size(), 5u);
  EXPECT_THAT(scene.faces[0].vertices, IsEmpty());
  EXPECT_THAT(scene.faces[1].vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)));
  EXPECT_EQ(scene.faces[2].vertices.size(), 3u);
  EXPECT_THAT(scene.faces[3].vertices, IsEmpty());
  EXPECT_EQ(scene.faces[4].vertices.size(), 3u);
  ASSERT_EQ(scene.warnings.size(), 3u);
  EXPECT_THAT(scene.warnings[0], StartsWith("dir/scene.obj:8: warning: 3 faces with repeated vertices"));
  EXPECT_THAT(scene.warnings[1], StartsWith("dir/scene.obj:7: warning: 2 faces without area dropped"));
  EXPECT_THAT(scene.warnings[2], StartsWith("dir/scene.obj:9: warning: 1 face cut"));
}

TEST(ObjReader, LibrariesWithBlanksAndLists) {
  // A library's name may hold blanks; several may stand on a line, and again on others.
  EXPECT_EQ(Read("mtllib with blank.mtl\nusemtl red\n").materials.size(), 2u);
  EXPECT_EQ(Read("mtllib a.mtl a.mtl\nmtllib a.mtl\nusemtl red\n").materials.size(), 2u);
}

struct Bad {
  const char* name;
  std::string text;
  const char* start;
  const char* holds;
  std::string mtl = std::string(kMtl);
};

class ObjReaderErrors : public testing::TestWithParam<Bad> {};

TEST_P(ObjReaderErrors, NameTheLine) {
  // Each kind of bad input gets one line that begins with the file, the line and "error:".
  const std::string error = ErrorOf(GetParam().text, {}, GetParam().mtl);
  EXPECT_THAT(error, StartsWith(std::string(GetParam().start) + ": error: "));
  EXPECT_THAT(error, HasSubstr(GetParam().holds));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  std::printf("%s\n", error.c_str());
}

const std::string kS(kSquare);
const std::string kLib = "mtllib a.mtl\n";

INSTANTIATE_TEST_SUITE_P(
    Kinds, ObjReaderErrors,
    testing::Values(
        Bad{"unknown_keyword", "v 0 0 0\nhello world\n", "dir/scene.obj:2", "'hello'"},
        Bad{"binary", "\x01\x02PNG\r\n\x1a\n", "dir/scene.obj:1", "'\\x01\\x02PNG' is no OBJ keyword"},
        Bad{"other_format", "\x89PNG\r\n\x1a\n", "dir/scene.obj", "this is a PNG image"},
        Bad{"library_as_scene", "# x\nnewmtl red\nKd 0 0 0\n", "dir/scene.obj:2", "mtllib"},
        Bad{"short_vertex", "v 0 0 0\n\n# x\nv 1 2\n", "dir/scene.obj:4", "v x y z"},
        Bad{"short_face", kS + "f 1\n", "dir/scene.obj:5", "three"},
        Bad{"face_without_vertices", kS + "f\n", "dir/scene.obj:5", "three"},
        Bad{"face_syntax", kS + "f 1 2 3/\n f 1 2 x\n", "dir/scene.obj:6", "'x'"},
        Bad{"face_slashes", kS + "f 1/1/1/1 2 3\n", "dir/scene.obj:5", "v/vt/vn"},
        Bad{"face_fraction", kS + "f 1 2 3.5\n", "dir/scene.obj:5", "integers"},
        Bad{"index_huge", kS + "f 1 2 99999999999999999999\n", "dir/scene.obj:5", "integers"},
        Bad{"index_zero", kS + "f 0 1 2\n", "dir/scene.obj:5", "out of range"},
        Bad{"texture_word", kS + "f 1/a 2 3\n", "dir/scene.obj:5", "v/vt/vn"},
        Bad{"index_large", kS + "f 1 2 5\n", "dir/scene.obj:5", "out of range"},
        Bad{"index_without_vertices", "f 1 2 3\n", "dir/scene.obj:1", "no vertices"},
        Bad{"index_negative", kS + "f -1 -2 -5\n", "dir/scene.obj:5", "out of range"},
        Bad{"no_number", "v 0 zero 0\n", "dir/scene.obj:1", "'zero' is not a number"},
        Bad{"half_a_number", "v 0 1.5x 0\n", "dir/scene.obj:1", "not a number"},
        Bad{"decimal_comma", "v 0 1,5 0\n", "dir/scene.obj:1", "not a number"},
        Bad{"nan", "v 0 nan 0\n", "dir/scene.obj:1", "not finite"},
        Bad{"infinity", "v 0 0 -inf\n", "dir/scene.obj:1", "not finite"},
        Bad{"overflow", "v 0 0 1e999\n", "dir/scene.obj:1", "too large"},
        Bad{"beyond_coordinates", "v 0 0 1e60\n", "dir/scene.obj:1", "too large"},
        Bad{"beyond_1e36", "v 0 0 1.1e36\n", "dir/scene.obj:1", "too large"},
        Bad{"smaller_than_all", "v 0 0 0\nv 1e-37 0 0\nv 0 1e-37 0\nf 1 2 3\n", "dir/scene.obj", "1e-36"},
        Bad{"folded", kS + "v 0 1 0.4\nf 1 2 3 5\n", "dir/scene.obj:6", "planar"},
        Bad{"uneven_bow_tie", "v 0 0 0\nv 4 4 0.02\nv 4 0 0\nv 0 1 0\nf 1 2 3 4\n", "dir/scene.obj:5",
            "crosses itself"},
        Bad{"uneven_pentagram", "v 0 3 0.1\nv -2 -2 0\nv 3 1 0\nv -3 1 0\nv 2 -2 0\nf 1 2 3 4 5\n",
            "dir/scene.obj:6", "crosses"},
        Bad{"bow_tie", kS + "f 1 3 2 4\n", "dir/scene.obj:5", "crosses itself"},
        Bad{"lopsided_bow_tie", "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 1 0\nf 1 2 3 4", "dir/scene.obj:5",
            "crosses"},
        Bad{"pentagram", "v 0 3 0\nv -2 -2 0\nv 3 1 0\nv -3 1 0\nv 2 -2 0\nf 1 2 3 4 5\n", "dir/scene.obj:6",
            "crosses"},
        Bad{"spectral", kLib, "dir/a.mtl:2", "spectrum", "newmtl a\nKd spectral file.rfl\n"},
        Bad{"cie_xyz", kLib, "dir/a.mtl:2", "XYZ", "newmtl a\nKd xyz 0.5 0.5 0.5\n"},
        Bad{"wide_library", kLib, "dir/a.mtl", "UTF-16", std::string("\xff\xfen\0e\0w\0", 8)},
        Bad{"continued", kS + "f 1 2 \\\n 9\nv 0 0 0\n", "dir/scene.obj:5", "out of range"},
        Bad{"reflectance_one", kLib, "dir/a.mtl:2", "max-reflectance", "newmtl a\nKd 0.5 1 0.5\n"},
        Bad{"reflectance_negative", kLib, "dir/a.mtl:3", "negative", "newmtl a\n\nKd 0.5 0.5 -0.1\n"},
        Bad{"emittance_negative", kLib, "dir/a.mtl:2", "negative", "newmtl a\nKe 0 -1 0\n"},
        Bad{"emittance_nan", kLib, "dir/a.mtl:2", "finite", "newmtl a\nKe 0 NaN 0\n"},
        Bad{"colour_no_number", kLib, "dir/a.mtl:2", "not a number", "newmtl a\nKd a b c\n"},
        Bad{"colour_of_two", kLib, "dir/a.mtl:2", "three", "newmtl a\nKd 0.5 0.5\n"},
        Bad{"colour_before_material", kLib, "dir/a.mtl:1", "newmtl", "Kd 0.5 0.5 0.5\n"}),
    [](const auto& kind) { return std::string(kind.param.name); });

TEST(ObjReader, MissingFile) {
  // A file that is not there, or is a directory, is told as what it is, without a line.
  for (const auto& [path, why] : {std::pair<std::string, std::string>("no/such/file.obj", "no such file"),
                                  {".", "it is a directory"}}) {
    try {
      ReadObj(path, {});
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(path + ": error: "));
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
}

TEST(ObjReader, FileWithLibraryBesideIt) {
  // Libraries are looked for beside the scene, not in the current folder.
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "penumbra_obj_reader_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.mtl") << kMtl;
  std::ofstream(folder / "a.obj") << "mtllib a.mtl\n" << kSquare << "usemtl lamp\nf 1 2 3 4\n";
  const Scene scene = ReadObj(folder / "a.obj", {});
  EXPECT_EQ(scene.MaterialOf(0).name, "lamp");
  std::filesystem::remove_all(folder);
}

TEST(ObjReader, NearlyPlanarFacesKeepTheirVertices) {
  // A face within 1e-6 of its diameter from its plane is accepted, and its vertices are not moved.
  const Scene scene = Read("v 0 0 1e-7\nv 1 0 0\nv 1 1 1e-7\nv 0 1 0\nf 1 2 3 4\n");
  ASSERT_EQ(scene.patches.size(), 1u);
  EXPECT_EQ(scene.patches[0].vertex[0], Vec3(0, 0, 1e-7));
  EXPECT_EQ(scene.patches[0].vertex[2], Vec3(1, 1, 1e-7));
}

TEST(ObjReader, FacesWithABridgeToTheirHole) {
  // A hole joined to the outline by a doubled edge is no crossing, and stays open.
  const Scene scene =
      Read("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nf 1 2 3 4 1 5 6 7 8 5\n");
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  EXPECT_NEAR(area, 12, 1e-14);
  EXPECT_EQ(scene.patches.size(), 4u);
}

SceneOptions Strict() {
  SceneOptions options;
  options.strict = true;
  return options;
}

TEST(ObjReader, NamesMayHoldHashes) {
  // Only a # that begins a line is a comment; behind numbers it is a remark.
  const Scene scene = Read(
      "  # comment \\\nmtllib a.mtl\no wall #1\nv 0 0 0 # corner\nv 1 0 0\nv 0 1 0\nusemtl Material #26\n"
      "f 1 2 3 # floor\nusemtl Material #25\nf 1 2 3\n",
      {}, "newmtl Material #25\nKd 0 0 0 # black\nnewmtl Material #26\nKe 1 1 1\n");
  ASSERT_EQ(scene.faces.size(), 2u);
  EXPECT_EQ(scene.materials[scene.faces[0].material].name, "Material #26");
  EXPECT_EQ(scene.materials[scene.faces[1].material].name, "Material #25");
  EXPECT_EQ(scene.objects[0].name, "wall #1");
}

TEST(ObjReader, ADefinitionMayFollowItsUse) {
  // Vertices, libraries and materials may stand below the faces that name them; a negative index counts back
  // from where it stands.
  const Scene scene = Read(
      "usemtl lamp\nf 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 4\nf 1//9 2//8 3/7/6\nv 0 0 1\nmtllib "
      "a.mtl\n");
  ASSERT_EQ(scene.faces.size(), 3u);
  EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("cut where others lie")));
  EXPECT_THAT(scene.faces[0].vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(scene.faces[1].vertices, ElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)));
  EXPECT_EQ(scene.MaterialOf(0).name, "lamp");
}

TEST(ObjReader, WhatIsNotDefinedIsGrey) {
  // Without its library a scene is grey, and says so; strict reading refuses it.
  const std::string text = "mtllib b.mtl\n" + std::string(kSquare) + "usemtl blue\nf 1 2 3\n";
  const Scene scene = Read(text);
  EXPECT_TRUE((scene.MaterialOf(0).reflectance == 0.5).all());
  EXPECT_TRUE((scene.MaterialOf(0).emittance == 0).all());
  EXPECT_THAT(scene.warnings, ElementsAre(StartsWith("dir/scene.obj:6: warning: the material 'blue'"),
                                          StartsWith("dir/scene.obj:1: warning: 1 material library")));
  EXPECT_THAT(ErrorOf(text, Strict()), StartsWith("dir/scene.obj:1: error: the material library 'b.mtl'"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "usemtl blue\nf 1 2 3\n", Strict()),
              StartsWith("dir/scene.obj:5: error: the material 'blue'"));
}

TEST(ObjReader, OfTwoDefinitionsTheLastCounts) {
  // A material that is defined twice is told, with both places.
  const std::string mtl = "newmtl a\nKd 0 0 0\nnewmtl b\nnewmtl a\nKd 0.25 0.25 0.25\n";
  const std::string text = "mtllib a.mtl\n" + std::string(kSquare) + "usemtl a\nf 1 2 3\n";
  const Scene scene = Read(text, {}, mtl);
  EXPECT_TRUE((scene.MaterialOf(0).reflectance == 0.25).all());
  EXPECT_THAT(
      scene.warnings,
      ElementsAre("dir/a.mtl:4: warning: the material 'a' is defined a second time, after dir/a.mtl:1; "
                  "this definition counts, the last of a name"));
  EXPECT_THAT(ErrorOf(text, Strict(), mtl), StartsWith("dir/a.mtl:4: error: "));
}

TEST(ObjReader, UnevenFacesAreCutAlongTheBetterDiagonal) {
  // A quadrilateral that is not planar becomes the two better shaped triangles; its back the same, reversed;
  // its number is still one; strict reading refuses it.
  const std::string text = "v 0 0 0\nv 2 0 0\nv 3 2 0.1\nv 0 1 0\nf 1 2 3 4\n";
  const Scene scene = Read(text, {.two_sided = true});
  ASSERT_EQ(scene.faces.size(), 2u);
  ASSERT_EQ(scene.patches.size(), 4u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_THAT(scene.patches[i].faces, ElementsAre(0));
    EXPECT_THAT(scene.patches[2 + i].faces, ElementsAre(1));
    EXPECT_NEAR(scene.patches[2 + i].normal.dot(scene.patches[i].normal), -1, 1e-15);
    EXPECT_EQ(scene.patches[2 + i].area, scene.patches[i].area);
    for (const Vec3& v : scene.patches[i].Vertices())
      EXPECT_THAT(scene.faces[0].vertices, testing::Contains(v));
  }
  // From the second vertex to the fourth.
  EXPECT_NEAR(scene.patches[0].area + scene.patches[1].area,
              1 + (Vec3(1, 2, 0.1).cross(Vec3(-2, 1, 0))).norm() / 2, 1e-14);
  EXPECT_THAT(scene.warnings,
              ElementsAre(MatchesRegex("dir/scene.obj:5: warning: 1 face not planar .* cut into "
                                       "triangles, at most [0-9.]+ m and [0-9.]+ % .*")));
  EXPECT_THAT(ErrorOf(text, Strict()), StartsWith("dir/scene.obj:5: error: the face is not planar"));
}

TEST(ObjReader, UnevenPolygonsAreCutIntoTriangles) {
  // The triangles of a surveyed floor of an L's shape, a corner 1 mm high, fill it.
  const Scene scene = Read("v 0 0 0\nv 4 0 0.001\nv 4 2 0\nv 2 2 0\nv 2 4 0\nv 0 4 0\nf 1 2 3 4 5 6\n");
  double area = 0;
  for (const Patch& patch : scene.patches) {
    EXPECT_EQ(patch.size, 3);
    EXPECT_GT(patch.normal.z(), 0.999);
    area += patch.area;
  }
  EXPECT_EQ(scene.patches.size(), 4u);
  EXPECT_NEAR(area, 12, 1e-5);
}

TEST(ObjReader, FacesMayBeFartherOffTheirPlane) {
  // A quadrilateral whose corners rise and fall by h is cut into two triangles that fill it: by the default
  // up to 5 % of the diameter, and as far as the user says.
  const std::string text = "v 0 0 0.2\nv 1 0 -0.2\nv 1 1 0.2\nv 0 1 -0.2\nf 1 2 3 4\n";
  EXPECT_THAT(ErrorOf(text), HasSubstr("--max-off-plane"));
  EXPECT_THAT(ErrorOf(text, {.max_off_plane = 0.1}), HasSubstr("is not planar"));
  const Scene scene = Read(text, {.max_off_plane = 0.2});
  ASSERT_EQ(scene.patches.size(), 2u);
  // Two sides of either triangle rise by 0.4 m over 1 m.
  for (const Patch& patch : scene.patches)
    EXPECT_NEAR(patch.area, 0.5 * Vec3(1, 0, -0.4).cross(Vec3(0, 1, -0.4)).norm(), 1e-15);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("cut into triangles, at most 0.2 m")));
}

TEST(ObjReader, FacesThatRoundingMadeCrossThemselves) {
  // What is no wider than the digits written is no crossing: such a face keeps its area, or has none.
  const std::string lines =
      "v 0.000000 0.000000 0.000000\nv 2.000000 0.000000 0.000000\nv 2.000000 1.000000 0.000000\n"
      "v 1.000000 -0.000001 0.000000\nv 0.000000 1.000000 0.000000\n";
  const Scene scene = Read(lines + "f 1 2 3 4 5\n");  // the notch's tip lies a unit beyond the base
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  EXPECT_NEAR(area, 1, 1e-5);
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(ErrorOf(lines + "v 1 -0.01 0\nf 1 2 3 6 5\n"), HasSubstr("crosses itself"));
  const Scene sliver = Read(
      "v 0.000001 0.000000 1.000000\nv 1.000000 0.000000 1.000000\nv 3.000000 0.000001 1.000000\n"
      "v 2.000000 0.000000 1.000001\nv 0.500000 0.000001 1.000000\nf 1 3 2 4 5\n");
  EXPECT_TRUE(sliver.patches.empty());
  EXPECT_THAT(sliver.warnings, ElementsAre(HasSubstr("1 face without area dropped")));
}

TEST(ObjReader, EdgesAndMaterialsWithoutNames) {
  // A face of two vertices is an edge: it has no area, and keeps its number. Materials need no name.
  const std::string text =
      "mtllib a.mtl\n" + std::string(kSquare) + "usemtl\nf 1 2\nf 1 2 3\nusemtl b\nf 1 3 4\n";
  const std::string library = "newmtl \nKd 0.25\nnewmtl b\nKd 0.125\n";
  const Scene scene = Read(text, {}, library);
  ASSERT_EQ(scene.faces.size(), 3u);
  EXPECT_TRUE(scene.faces[0].vertices.empty());
  EXPECT_EQ(scene.MaterialOf(0).reflectance[0], 0.25);
  EXPECT_EQ(scene.MaterialOf(1).reflectance[0], 0.125);
  EXPECT_THAT(scene.warnings, ElementsAre(StartsWith("dir/a.mtl:1: warning: newmtl without a name"),
                                          StartsWith("dir/scene.obj:7: warning: 1 face without area")));
  EXPECT_THAT(ErrorOf(text, Strict(), library), StartsWith("dir/a.mtl:1: error: newmtl without a name"));
  EXPECT_THAT(ErrorOf(std::string(kSquare) + "f 1 2\n", Strict()), HasSubstr("fewer than three"));
  // Without such a material, a face has none.
  EXPECT_EQ(Read("mtllib a.mtl\n" + std::string(kSquare) + "usemtl \nf 1 2 3 4\n").MaterialOf(0).name,
            "default");
}

TEST(ObjReader, StatementsOfSubdividersAndAnimators) {
  // Creases, weights of joints, curves and points add no face; blanks in a library's name may be escaped.
  const Scene scene = Read("mtllib with\\ blank.mtl\n" + std::string(kSquare) +
                           "vw 0 0 0.5 1 0.5\nt crease 2/1/0 1 2 3.5\np 1 2\nl 1 2 3\ncstype rat bspline\n"
                           "usemtl red\nf 1 2 3 4\n");
  ASSERT_EQ(scene.patches.size(), 1u);
  EXPECT_EQ(scene.MaterialOf(0).name, "red");
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(ObjReader, AFaceIsCutAlikeHoweverItIsWritten) {
  // Begun at any vertex, and reversed, an uneven face has the same triangles.
  Random random(1);
  for (int run = 0; run < 200; ++run) {
    Polygon3 face;
    const int size = 4 + static_cast<int>(random.Index(5));
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.8 * random.Uniform()) / size;
      face.push_back({std::cos(angle), std::sin(angle), 0.02 * random.Uniform()});
    }
    using Triangles = std::set<std::set<std::array<double, 3>>>;
    const auto triangles = [](const Polygon3& polygon) {
      Triangles set;
      for (const Polygon3& piece : FlatPieces(polygon)) {
        std::set<std::array<double, 3>> corners;
        for (const Vec3& v : piece) corners.insert({v.x(), v.y(), v.z()});
        set.insert(corners);
      }
      return set;
    };
    const Triangles as_is = triangles(face);
    EXPECT_EQ(as_is.size(), face.size() - 2);
    for (int turn = 0; turn < size; ++turn) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      EXPECT_EQ(triangles(face), as_is);
      EXPECT_EQ(triangles(Polygon3(face.rbegin(), face.rend())), as_is);
    }
  }
}

TEST(ObjReader, LineEndsOfOldMacintoshes) {
  // A CR alone ends a line, and is told.
  std::string text = "# x\n" + std::string(kSquare) + "f 1 2 3 4\n";
  std::replace(text.begin(), text.end(), '\n', '\r');
  const Scene scene = Read(text);
  EXPECT_EQ(scene.patches.size(), 1u);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("CR alone")));
  EXPECT_THAT(ErrorOf(text + "f 1 2 9\r"), StartsWith("dir/scene.obj:7: error: "));
  EXPECT_THAT(Read("v 0 0 0\r\r\nv 1 0 0\r\r\n").warnings, IsEmpty());
}

TEST(ObjReader, WhatExportersWrite) {
  // Statements and forms seen in files of many programs are read, or passed over.
  const Scene scene = Read(
      "\xef\xbb\xbf# Blender\nmtllib .\\library\\a.mtl\nmtllib \"with blank.mtl\"\no Cube.001 (copy)\n"
      "v 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0 1 0.5 -nan(ind) 0.5\nv 0 1 0  \nvt 0\nvt 0 -nan 0\nvn nan 0 "
      "1\n"
      "vp 0 0\ng  \ng a b c\ns off\ns 1\nmg 0\nusemtl red \nf 1/ 2/ 3/ 4/\nf 1// 2// 3//\nl 1/1 2/2\np 1 2\n"
      "usemtl\nf +1 +2 +3 \\ \n +4\ncurv 0 1 1 2\ncstype bezier\nend\n#MRGB 0\n#\n");
  ASSERT_EQ(scene.faces.size(), 3u);
  EXPECT_EQ(scene.materials[scene.faces[0].material].name, "red");
  EXPECT_EQ(scene.materials[scene.faces[2].material].name, "default");
  EXPECT_EQ(scene.faces[2].vertices.size(), 4u);
}

TEST(ObjReader, LibrariesAsPathsOfOtherMachines) {
  // A path leads to the file of that name beside the scene; names with blanks may stand in a list.
  EXPECT_EQ(Read("mtllib C:\\models\\my scene\\a.mtl\nusemtl red\n").materials.size(), 2u);
  EXPECT_EQ(Read("mtllib /home/me/a.mtl\nusemtl red\n").materials.size(), 2u);
  EXPECT_THAT(Read("mtllib a.mtl with blank.mtl none.mtl\nusemtl red\n").warnings,
              testing::Contains(HasSubstr("cannot be read: 'none.mtl'")));
}

TEST(ObjReader, HugeFacesTakeLinearTime) {
  // A polygon of 100,000 vertices, and a face that repeats its vertices a million times, are read at once.
  std::string circle, repeated = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  constexpr int kVertices = 100'000, kRepeats = 1'000'000;
  std::string face = "f";
  for (int i = 0; i < kVertices; ++i) {
    const double angle = 2 * std::numbers::pi * i / kVertices, radius = i % 2 == 0 ? 1 : 0.9;
    circle += "v " + std::to_string(radius * std::cos(angle)) + " " +
              std::to_string(radius * std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  for (int i = 0; i < kRepeats; ++i) repeated += i % 2 == 0 ? " 1" : " 2";
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_GT(Read(circle + face + "\n").patches.size(), 40'000u);
  EXPECT_EQ(Read(repeated + " 3\n").patches.size(), 1u);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("%.2f s\n", seconds);
  EXPECT_LT(seconds, 60);  // by the square of the size it would be hours under a sanitizer
}

TEST(ObjReader, MessagesHoldNoControlCharacters) {
  // Names from files are escaped, and long ones cut.
  const std::string error = ErrorOf("v 0 0 0\n\x1b[31mred\x07" + std::string(100'000, 'x') + "\n");
  EXPECT_THAT(error, HasSubstr("'\\x1b[31mred\\x07xxx"));
  EXPECT_LT(error.size(), 200u);
  EXPECT_THAT(Printable("a\n\t\x7f\xc2\x85\xe2\x80\xae\xc3\xa4\xff", 99),
              "a\\n\\t\\x7f\\xc2\\x85\\xe2\\x80\\xae\xc3\xa4\\xff");
}

TEST(ObjReader, FormatsAreToldByTheirFirstBytes) {
  // Whoever gives a file of another program is told which one it is.
  using std::string_literals::operator""s;
  const std::vector<std::pair<std::string, std::string>> files = {
      {"BLENDER-v280RENDH", "a Blender file; export OBJ"},
      {"glTF\x02\0\0\0"s, "a glTF file (GLB); export OBJ"},
      {"{\"asset\": {\"version\": \"2.0\"}}", "a glTF file; export OBJ"},
      {"ply\nformat ascii 1.0\n", "a PLY file"},
      {"solid cube\nfacet normal 0 0 1\n", "an STL file"},
      {std::string(80, '\0') + "\x02\0\0\0"s + std::string(100, '\0'), "an STL file"},
      {"Kaydara FBX Binary  \0\x1a\0"s, "an FBX file"},
      {"MM\x20\0\0\0\x02\0\x0a\0\0\0"s, "a 3D Studio file"},
      {"PK\x03\x04rest", "a ZIP archive; unpack it"},
      {"\x1f\x8b\x08rest", "a gzip file; unpack it"},
      {"\x89HDF\r\n\x1a\n", "an HDF5 file"},
      {"\x89PNG\r\n\x1a\n", "a PNG image"},
      {"\xff\xfe#\0"s, "UTF-16; save it as UTF-8"},
      {"v\0 \0000\0 \0000\0 \0000\0\n\0v\0 \0001\0"s, "UTF-16; save it as UTF-8"},
      {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"x\">", "a COLLADA file"},
      {"\n<!DOCTYPE html>\n<html>", "a web page"},
      {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"}};
  for (const auto& [bytes, words] : files) {
    EXPECT_THAT(ErrorOf(bytes), StartsWith("dir/scene.obj: error: "));
    EXPECT_THAT(ErrorOf(bytes), HasSubstr(words));
  }
}

}  // namespace
}  // namespace penumbra
