// Worlds and entities of Ashdown's book: counts and areas of its scenes, the order of transformations, and
// what its parser tolerates.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/check.h"
#include "solver/scene/ashdown_reader.h"
#include "solver/scene/named_scene.h"
#include "solver/scene/scene_readers.h"
#include "test_paths.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

using scene_test::TestWithFolder;
using testing::HasSubstr;

std::string PathOfBook(const std::string& name) {
  return std::string(PENUMBRA_SOURCE_DIR) + "/scenes/ashdown/" + name;
}

double AreaOfFaces(const Scene& scene) {
  double area = 0;
  for (const Face& face : scene.faces) area += VectorArea(face.vertices).norm();
  return area;
}

struct BookScene {
  const char* file;
  const char* counts;
  std::size_t faces;
  double area;  // [m^2]
};

// Areas of the stretched cubes: twice the sum of products of two factors of scaling. The light's sides are
// 0.02 high; the bench has an outline of 5 x 2.5 with an opening of 4.6 x 2.3, and is 2.5 deep: sides and
// top, the faces of the opening, and two feet.
const BookScene kBookScenes[] = {
    {"room.wld", "9 instances, 22 surfaces, 48 patches, 197 elements, 326 vertices", 48, 9.624352},
    {"col_cube.wld", "2 instances, 12 surfaces, 12 patches, 12 elements, 48 vertices", 12, 22 + 5.5},
    {"chair.wld", "6 instances, 36 surfaces, 36 patches, 36 elements, 144 vertices", 36, 8.8 + 14 + 4 * 1.54},
    {"square.wld", "2 instances, 2 surfaces, 2 patches, 2 elements, 8 vertices", 2, 2},
    {"ray_test.wld", "2 instances, 2 surfaces, 2 patches, 2 elements, 8 vertices", 2, 1 + 1e-8},
    {"bench.ent", "1 instance, 4 surfaces, 14 patches, 19 elements, 30 vertices", 14,
     2 * (5 * 2.5 - 4.6 * 2.3) + 2.5 * (10 + 9.2 + 0.4)},
    {"light.ent", "1 instance, 6 surfaces, 14 patches, 14 elements, 40 vertices", 14, 2 + 4 * 0.02},
    {"w_wall.ent", "1 instance, 1 surface, 1 patch, 25 elements, 36 vertices", 1, 1},
    {"r_wall.ent", "1 instance, 1 surface, 1 patch, 25 elements, 36 vertices", 1, 1},
    {"floor.ent", "1 instance, 1 surface, 1 patch, 25 elements, 36 vertices", 1, 1},
    {"ceiling.ent", "1 instance, 1 surface, 1 patch, 25 elements, 36 vertices", 1, 1},
    {"square.ent", "1 instance, 1 surface, 1 patch, 1 element, 4 vertices", 1, 1},
    {"col_cube.ent", "1 instance, 6 surfaces, 6 patches, 6 elements, 24 vertices", 6, 6},
};

TEST(AshdownReader, ScenesOfTheBookHaveTheirCountsAndAreas) {
  for (const BookScene& expected : kBookScenes) {
    const Scene scene = ReadNamedScene(PathOfBook(expected.file), {});
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_THAT(scene.warnings.front(), HasSubstr(expected.counts));
    EXPECT_EQ(scene.faces.size(), expected.faces) << expected.file;
    EXPECT_NEAR(AreaOfFaces(scene), expected.area, 1e-12 * expected.area) << expected.file;
    for (const Patch& patch : scene.patches) EXPECT_GT(patch.area, 0) << expected.file;
  }
}

TEST(AshdownReader, TheRoomIsClosedAndLitByItsLamps) {
  const Scene scene = ReadNamedScene(PathOfBook("room.wld"), {});
  ASSERT_EQ(scene.objects.size(), 9U);
  EXPECT_EQ(scene.objects[7].name, "light_2");
  Rgb power = Rgb::Zero();
  Vec3 walls = Vec3::Zero();
  double inwards = 0;
  for (std::size_t i = 0; i < scene.faces.size(); ++i) {
    const Face& face = scene.faces[i];
    const Vec3 area = VectorArea(face.vertices);
    power += area.norm() * scene.materials[static_cast<std::size_t>(face.material)].emittance;
    if (face.object > 5) continue;
    walls += area;
    inwards += area.dot(Vec3(0.5, 0.8, 0.5) - face.vertices[0]);
  }
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(power[channel], 0.12, 1e-15);
  EXPECT_LE(walls.norm(), 1e-15);
  EXPECT_NEAR(inwards, 3 * 1.6, 1e-14) << "thrice the volume that the fronts of the six walls look into";
  const auto [low, high] = scene.Bounds();
  EXPECT_EQ(low, Vec3(0, 0, 0)) << "turns by multiples of 90 degrees are exact";
  EXPECT_EQ(high, Vec3(1, 1.6, 1));
}

constexpr const char* kSquareEntity =
    "ENTITY square\nVERTEX\n< 1 2 0 >\n< 2 2 0 >\n< 2 3 0 >\n< 1 3 0 >\nEND_VERT\n"
    "SURFACE\n[ .5 .5 .5 ] [ 1 2 3 ]\nEND_SURF\nPATCH\n0 { 0 1 2 3 }\nEND_PATCH\n"
    "ELEMENT\n0 { 0 1 2 2 }\n0 { 0 2 3 3 }\nEND_ELEM\nEND_ENTITY\n";

class AshdownFiles : public TestWithFolder {
 protected:
  std::string World(const std::string& instances) const {
    return Write("a.wld", "WORLD\n" + instances + "END_FILE\n");
  }
  // The message of the error, without the folder's path; empty if the scene is read.
  std::string ErrorOf(const std::string& path) const {
    try {
      ReadNamedScene(path, {});
    } catch (const InputError& error) {
      const std::string message = error.what(), folder = Path("").string();
      const std::size_t at = message.find(folder);
      return at == message.npos ? message : message.substr(at + folder.size());
    }
    return "";
  }
  std::string EntityError(const std::string& text) const { return ErrorOf(Write("e.ent", text)); }
};

// First scaled, then turned about x, y and z, then moved: applied one after the other to a corner.
TEST_F(AshdownFiles, TransformsInTheOrderOfTheBook) {
  Write("square.ent", kSquareEntity);
  const Scene scene = ReadNamedScene(World("square.ent\n< 2 3 4 >\n< 30 45 60 >\n< 7 8 9 >\n"), {});
  const Vec3 start(2 * 1, 3 * 2, 0);
  const double x = 30 * std::numbers::pi / 180, y = 45 * std::numbers::pi / 180,
               z = 60 * std::numbers::pi / 180;
  Vec3 p(start.x(), std::cos(x) * start.y() - std::sin(x) * start.z(),
         std::sin(x) * start.y() + std::cos(x) * start.z());
  p = Vec3(std::cos(y) * p.x() + std::sin(y) * p.z(), p.y(), -std::sin(y) * p.x() + std::cos(y) * p.z());
  p = Vec3(std::cos(z) * p.x() - std::sin(z) * p.y(), std::sin(z) * p.x() + std::cos(z) * p.y(), p.z());
  p += Vec3(7, 8, 9);
  ASSERT_EQ(scene.faces.size(), 1U);
  EXPECT_LE((scene.faces[0].vertices[0] - p).norm(), 1e-14);
}

TEST_F(AshdownFiles, AreReadAsTheBooksParserReadsThem) {
  std::string entity = kSquareEntity;
  entity = "any words\nCOMMENT of this line nothing is read\nCOMMENTS: nor of this one\n\n" +
           entity.substr(entity.find("VERTEX")) + "what follows is not read\n";
  for (const auto& [from, to] :
       {std::pair("END_VERT\n", "END_VERTICES\n"), std::pair("< 1 2 0 >", "\t( 1 2 0]"),
        std::pair("0 { 0 1 2 3 }", "0{0   1 2 3}")})
    entity.replace(entity.find(from), std::string(from).size(), to);
  Write("Square.ENT", entity);
  const std::string world =
      Write("ROOM.WLD",
            "WORLD\r\nCOMMENT first\r\nSQUARE.ent\r\n<1 1 1>\r\n< 0 0 0>\r\n< 0 0 0 >\r\n"
            ".\\square.ENT\r\n< 1 1 1 >\r\n< 0 0 0 >\r\n< 0 0 1 >\r\nEND_FILE\r\nrest\r\n");
  const Scene scene = ReadNamedScene(world, {});
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].name, "Square");
  EXPECT_EQ(scene.objects[1].name, "Square_2");
  ASSERT_EQ(scene.faces.size(), 2U);
  EXPECT_EQ(scene.materials.size(), 1U) << "instances share their materials";
  EXPECT_EQ(scene.materials[0].emittance[2], 3);
  EXPECT_EQ(scene.faces[1].vertices[2], Vec3(2, 3, 1));
}

TEST_F(AshdownFiles, TrianglesRepeatTheirThirdVertex) {
  std::string entity = kSquareEntity;
  entity.replace(entity.find("0 { 0 1 2 3 }"), 13, "0 { 0 1 2 2 }");
  const Scene scene = ReadNamedScene(Write("e.ent", entity), {});
  ASSERT_EQ(scene.faces.size(), 1U);
  EXPECT_EQ(scene.faces[0].vertices.size(), 3U);
  EXPECT_EQ(scene.warnings.size(), 1U) << "a triangle is no face that needs a repair";
}

TEST_F(AshdownFiles, NegativeFactorsAreWarnedAbout) {
  Write("square.ent", kSquareEntity);
  const Scene scene = ReadNamedScene(World("square.ent\n< -1 1 1 >\n< 0 0 0 >\n< 0 0 0 >\n"), {});
  ASSERT_EQ(scene.patches.size(), 1U);
  EXPECT_EQ(scene.patches[0].normal, Vec3(0, 0, -1));
  EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
    return warning.find("a.wld:3: warning: a negative factor") != warning.npos;
  }));
}

TEST_F(AshdownFiles, WrongEntitiesAreRefusedWithTheirLine) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string entity = kSquareEntity;
    return entity.replace(entity.find(from), from.size(), to);
  };
  EXPECT_THAT(
      EntityError(changed("0 { 0 1 2 3 }", "1 { 0 1 2 3 }")),
      HasSubstr("e.ent:12: error: the first number of a patch is 1; it must be a whole number from 0 to 0"));
  EXPECT_THAT(EntityError(changed("0 { 0 1 2 3 }", "0 { 0 1 2 4 }")),
              HasSubstr("e.ent:12: error: a vertex of a patch is 4; it must be a whole number from 0 to 3"));
  EXPECT_THAT(EntityError(changed("0 { 0 1 2 2 }", "1 { 0 1 2 2 }")),
              HasSubstr("e.ent:15: error: the first number of an element is 1"));
  EXPECT_THAT(EntityError(changed("0 { 0 2 3 3 }", "0 { 0 2 3 1.5 }")), HasSubstr("e.ent:16: error"));
  EXPECT_THAT(EntityError(changed("< 2 2 0 >", "< 2 2 >")), HasSubstr("e.ent:4: error: a number is missing"));
  EXPECT_THAT(EntityError(changed("< 2 2 0 >", "< 2 2 0 0 >")),
              HasSubstr("e.ent:4: error: a bracket is missing"));
  EXPECT_THAT(EntityError(changed("< 2 2 0 >", "< 2 2 1e999 >")), HasSubstr("e.ent:4: error"));
  EXPECT_THAT(EntityError(changed("SURFACE\n", "")),
              HasSubstr("e.ent:8: error: the line SURFACE is missing, which begins a section"));
  EXPECT_THAT(EntityError(changed("[ .5 .5 .5 ] [ 1 2 3 ]\n", "")),
              HasSubstr("e.ent:9: error: the section SURFACE has no items"));
  EXPECT_THAT(EntityError(changed("END_ELEM\nEND_ENTITY\n", "")),
              HasSubstr("the file ends within the section"));
  EXPECT_THAT(EntityError(changed("[ .5 .5 .5 ]", "[ 1 .5 .5 ]")), HasSubstr("reflectance"));
  EXPECT_THAT(EntityError(""), HasSubstr("the file is empty"));
}

TEST_F(AshdownFiles, WrongWorldsAreRefusedWithTheirLine) {
  Write("square.ent", kSquareEntity);
  EXPECT_THAT(ErrorOf(World("none.ent\n< 1 1 1 >\n< 0 0 0 >\n< 0 0 0 >\n")),
              HasSubstr("a.wld:2: error: the entity file '"));
  EXPECT_THAT(ErrorOf(World("square.ent\n< 1 1 1 >\n< 0 0 0 >\n")),
              HasSubstr("a.wld:5: error: a bracket is missing before 'END_FILE'"));
  EXPECT_THAT(ErrorOf(Write("b.wld", "WORLD\nsquare.ent\n< 1 1 1 >\n< 0 0 0 >\n< 0 0 0 >\n")),
              HasSubstr("b.wld:5: error: the file ends without the line END_FILE"));
  EXPECT_THAT(ErrorOf(Write("c.wld", "")), HasSubstr("the file is empty"));
}

// An output file must not overwrite an entity: the program is asked before it is opened.
TEST_F(AshdownFiles, EntitiesAreAnnounced) {
  Write("square.ent", kSquareEntity);
  std::vector<std::string> announced;
  SceneOptions options;
  options.before_library = [&](const std::string& path) { announced.push_back(path); };
  ReadNamedScene(
      World("square.ent\n< 1 1 1 >\n< 0 0 0 >\n< 0 0 0 >\nsquare.ent\n< 1 1 1 >\n< 0 0 0 >\n< 0 0 1 >\n"),
      options);
  EXPECT_EQ(announced, std::vector<std::string>{Path("square.ent").string()});
}

}  // namespace
}  // namespace penumbra
