// Tables of triangles.

#include <gtest/gtest.h>

#include <fstream>

#include "solver/base/check.h"
#include "solver/scene/named_scene.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

using TriangleTableTest = scene_test::TestWithFolder;

// Two triangles of one material are one square; a lamp is another material; what is no triangle is refused
// with its line.
TEST_F(TriangleTableTest, IsRead) {
  const Scene scene = ReadNamedScene(Write("a.triangles",
                                           "0,0,0,1,0,0,1,1,0,0.5,0\n"
                                           "0,0,0,1,1,0,0,1,0,0.5,0\n"
                                           "0,0,1,0,1,1,1,0,1,0,10\n"),
                                     {});
  ASSERT_EQ(scene.patches.size(), 2U);
  EXPECT_EQ(scene.patches[0].area, 1);
  EXPECT_EQ(scene.MaterialOf(1).emittance[0], 10);
  try {
    ReadNamedScene(Write("b.triangles", "0,0,0,1,0,0,1,1,0,0.5,0\n1,2\n"), {});
    FAIL() << "half a triangle was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("b.triangles:2: error: no triangle"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace penumbra
