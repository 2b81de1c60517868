// View3D's files: fronts, areas, names, subsurfaces and combined surfaces mean the same here as there.

#include <gtest/gtest.h>

#include "solver/base/check.h"
#include "solver/scene/view3d_reader.h"

namespace penumbra {
namespace {

// A closed box of 3 x 4 x 5 m by its eight corners, seen from inside.
constexpr const char* kBox =
    "T a box\nC encl=1 eps=1.0e-4\nF 3\n! the corners\n"
    "V 1 0 0 0\nV 2 3. 0 0\nV 3 3. 4 0\nV 4 0 4. 0\nV 5 0 0 5\nV 6 3 0 5\nV 7 3 4 5\nV 8 0 4 5\n"
    "S 1 1 2 3 4 0 0 0.9 floor   ! seen from above\nS 2 8 7 6 5 0 0 0.8 ceiling\n"
    "s 3 1 5 6 2 0 0 0.7 south\ns 4 3 7 8 4 0 0 0.7 north\n"
    "s 5 1 4 8 5 0 0 0.7 west\ns 6 2 6 7 3 0 0 0.7 east\n";

double AreaOfBox(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area;
}

// Three times the volume that fronts look into; negative if they look outwards.
double ThriceInside(const Scene& scene) {
  double sum = 0;
  for (const Patch& patch : scene.patches) sum -= patch.area * patch.normal.dot(patch.Vertices()[0]);
  return sum;
}

std::string View3dError(const std::string& text) {
  try {
    ReadView3d(text, "a.vs3", {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(View3dReader, FrontsLookIntoTheBox) {
  const Scene scene = ReadView3d(kBox, "box.vs3", {});
  ASSERT_EQ(scene.faces.size(), 6U);
  EXPECT_NEAR(AreaOfBox(scene), 2 * (12 + 15 + 20), 1e-12);
  EXPECT_NEAR(ThriceInside(scene), 3 * 60, 1e-12);
  EXPECT_EQ(scene.objects[1].name, "ceiling");
  EXPECT_NEAR(scene.materials[static_cast<std::size_t>(scene.faces[1].material)].reflectance[0], 0.2, 1e-15);
}

// The same box by positions, azimuths and tilts: an azimuth of 0 is +y, a tilt of 0 looks up.
TEST(View3dReader, PositionsGiveTheSameBox) {
  const Scene scene = ReadView3d(
      "F 3a\nS 1 R 0 0 0.9 south\n 3 0 0  0 90  3 5\nS 2 R 0 0 0.9 north\n 0 4 0  180 90  3 5\n"
      "S 3 R 0 0 0.9 west\n 0 0 0  90 90  4 5\nS 4 R 0 0 0.9 east\n 3 4 0  270 90  4 5\n"
      "S 5 Q 0 0 0.9 floor\n 0 0 0  180 0  0 0 3 0 3 4 0 4\n"
      "S 6 T 0 0 0.9 ceiling\n 3 0 5  0 180  0 0 3 0 3 4\nS 7 T 0 6 0.9 half\n 3 0 5  0 180  0 0 3 4 0 "
      "4\n*\nS 9",
      "box.vs3", {});
  EXPECT_NEAR(AreaOfBox(scene), 94, 1e-12);
  EXPECT_NEAR(ThriceInside(scene), 180, 1e-12);
  ASSERT_EQ(scene.objects.size(), 6U) << "the two halves of the ceiling are one object";
  EXPECT_EQ(scene.objects[5].faces.size(), 2U);
}

// A subsurface covers its part of the base; an obstruction has two sides.
TEST(View3dReader, SubsurfacesCoverAndObstructionsHaveTwoSides) {
  const Scene scene = ReadView3d(std::string(kBox) +
                                     "V 9 1 1 0\nV 10 2 1 0\nV 11 2 2 0\nS 7 9 10 11 0 1 0 0.5 rug\n"
                                     "V 12 1 1 1\nV 13 2 1 1\nV 14 2 2 1\nO 8 12 13 14 0\nEnd of data\nS x",
                                 "box.vs3", {});
  EXPECT_EQ(scene.objects[0].name, "floor");
  double rug = 0, floor = 0, obstruction = 0;
  for (const Patch& patch : scene.patches) {
    const Face& face = scene.faces[static_cast<std::size_t>(patch.faces.front())];
    const std::string& name = scene.objects[static_cast<std::size_t>(face.object)].name;
    (name == "rug"     ? rug
     : name == "floor" ? floor
                       : obstruction) +=
        name == "rug" || name == "floor" || name == "obstruction-8" ? patch.area : 0;
  }
  EXPECT_NEAR(rug, 0.5, 1e-12);
  EXPECT_NEAR(floor, 11.5, 1e-12);
  EXPECT_NEAR(obstruction, 1, 1e-12);
}

// What cannot be read is refused with its line.
TEST(View3dReader, ErrorsTellTheLine) {
  EXPECT_NE(View3dError("V 1 0 0 0\nV 3 0 0 0\n").find("a.vs3:2: error: vertex 3 should be 2"),
            std::string::npos);
  EXPECT_NE(View3dError("V 1 0 0 zero\n").find("'zero'"), std::string::npos);
  EXPECT_NE(View3dError("V 1 0 0 0\nS 1 1 1 2 0 0 0 .9 a\n").find("must be 0 to 1"), std::string::npos);
  EXPECT_NE(View3dError(std::string(kBox) + "M 7 1 2 3 4 1 0 .9 a\n").find("mask"), std::string::npos);
  EXPECT_NE(View3dError(std::string(kBox) + "S 7 1 2 3 4 0 0 0 a\n").find("emittance 0"), std::string::npos);
  EXPECT_NE(View3dError("F 2\n").find("neither 3 nor 3a"), std::string::npos);
  EXPECT_NE(View3dError("hello\n").find("'hello' begins no line"), std::string::npos);
  EXPECT_NE(View3dError("F 3a\nS 1 R 0 0 .9 a\n").find("next line"), std::string::npos);
}

}  // namespace
}  // namespace penumbra
