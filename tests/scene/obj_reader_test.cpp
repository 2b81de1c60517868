#include "solver/scene/obj_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "solver/base/check.h"

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
        Bad{"missing_library", "\nmtllib b.mtl\n", "dir/scene.obj:2", "'b.mtl'"},
        Bad{"unknown_material", kLib + "usemtl blue\n", "dir/scene.obj:2", "'blue'"},
        Bad{"material_without_library", "usemtl red\n", "dir/scene.obj:1", "mtllib"},
        Bad{"unknown_keyword", "v 0 0 0\nhello world\n", "dir/scene.obj:2", "'hello'"},
        Bad{"binary", "\x89PNG\r\n\x1a\n", "dir/scene.obj:1", "keyword"},
        Bad{"short_vertex", "v 0 0 0\n\n# x\nv 1 2\n", "dir/scene.obj:4", "v x y z"},
        Bad{"short_face", kS + "f 1 2\n", "dir/scene.obj:5", "three"},
        Bad{"face_without_vertices", kS + "f\n", "dir/scene.obj:5", "three"},
        Bad{"face_syntax", kS + "f 1 2 3/\n f 1 2 x\n", "dir/scene.obj:6", "'x'"},
        Bad{"face_slashes", kS + "f 1/1/1/1 2 3\n", "dir/scene.obj:5", "v/vt/vn"},
        Bad{"face_fraction", kS + "f 1 2 3.5\n", "dir/scene.obj:5", "integers"},
        Bad{"index_huge", kS + "f 1 2 99999999999999999999\n", "dir/scene.obj:5", "integers"},
        Bad{"index_zero", kS + "f 0 1 2\n", "dir/scene.obj:5", "out of range"},
        Bad{"texture_index", kS + "vt 0 0\nf 1/1 2/2 3/1\n", "dir/scene.obj:6",
            "texture vertex index 2 is out of"},
        Bad{"normal_index", kS + "f 1//-1 2 3\n", "dir/scene.obj:5", "normal index -1 is out of"},
        Bad{"texture_zero", kS + "vt 0 0\nf 1/1 2/0 3/1\n", "dir/scene.obj:6",
            "texture vertex index 0 is out of"},
        Bad{"normal_zero", kS + "vn 0 0 1\nf 1//1 2//1 3//0\n", "dir/scene.obj:6",
            "normal index 0 is out of"},
        Bad{"texture_none", kS + "f 1/1 2 3\n", "dir/scene.obj:5", "there are no texture vertices above"},
        Bad{"index_large", kS + "f 1 2 5\n", "dir/scene.obj:5", "out of range"},
        Bad{"index_negative", kS + "f -1 -2 -5\n", "dir/scene.obj:5", "out of range"},
        Bad{"no_number", "v 0 zero 0\n", "dir/scene.obj:1", "'zero' is not a number"},
        Bad{"half_a_number", "v 0 1.5x 0\n", "dir/scene.obj:1", "not a number"},
        Bad{"decimal_comma", "v 0 1,5 0\n", "dir/scene.obj:1", "not a number"},
        Bad{"nan", "v 0 nan 0\n", "dir/scene.obj:1", "not finite"},
        Bad{"infinity", "v 0 0 -inf\n", "dir/scene.obj:1", "not finite"},
        Bad{"overflow", "v 0 0 1e999\n", "dir/scene.obj:1", "too large"},
        Bad{"beyond_coordinates", "v 0 0 1e60\n", "dir/scene.obj:1", "too large"},
        Bad{"not_planar", kS + "v 0 1 1e-5\nf 1 2 3 5\n", "dir/scene.obj:6", "planar"},
        Bad{"bow_tie", kS + "f 1 3 2 4\n", "dir/scene.obj:5", "crosses itself"},
        Bad{"lopsided_bow_tie", "v 0 0 0\nv 4 4 0\nv 4 0 0\nv 0 1 0\nf 1 2 3 4", "dir/scene.obj:5",
            "crosses"},
        Bad{"pentagram", "v 0 3 0\nv -2 -2 0\nv 3 1 0\nv -3 1 0\nv 2 -2 0\nf 1 2 3 4 5\n", "dir/scene.obj:6",
            "crosses"},
        Bad{"continued", kS + "f 1 2 \\\n 9\nv 0 0 0\n", "dir/scene.obj:5", "out of range"},
        Bad{"reflectance_one", kLib, "dir/a.mtl:2", "max-reflectance", "newmtl a\nKd 0.5 1 0.5\n"},
        Bad{"reflectance_negative", kLib, "dir/a.mtl:3", "negative", "newmtl a\n\nKd 0.5 0.5 -0.1\n"},
        Bad{"emittance_negative", kLib, "dir/a.mtl:2", "negative", "newmtl a\nKe 0 -1 0\n"},
        Bad{"emittance_nan", kLib, "dir/a.mtl:2", "finite", "newmtl a\nKe 0 NaN 0\n"},
        Bad{"colour_no_number", kLib, "dir/a.mtl:2", "not a number", "newmtl a\nKd a b c\n"},
        Bad{"colour_of_two", kLib, "dir/a.mtl:2", "three", "newmtl a\nKd 0.5 0.5\n"},
        Bad{"colour_before_material", kLib, "dir/a.mtl:1", "newmtl", "Kd 0.5 0.5 0.5\n"},
        Bad{"material_without_name", kLib, "dir/a.mtl:1", "name", "newmtl\n"}),
    [](const auto& kind) { return std::string(kind.param.name); });

TEST(ObjReader, MissingFile) {
  // A file that is not there, or is a folder, gets the line 0.
  for (const std::string path : {"no/such/file.obj", "."}) {
    try {
      ReadObj(path, {});
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(path + ":0: error: cannot be opened"));
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

}  // namespace
}  // namespace penumbra
