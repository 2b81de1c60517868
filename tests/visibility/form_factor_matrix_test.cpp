// The matrix of form factors: closed forms, closure, reciprocity, and agreement with single factors.

#include "solver/visibility/area/form_factor_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/parallel.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// Each patch of the scene is a row.
std::vector<std::vector<AreaPart>> RowOfEachPatch(const Scene& scene) {
  std::vector<std::vector<AreaPart>> rows;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const auto vertices = scene.patches[p].Vertices();
    rows.push_back({{static_cast<PatchId>(p), {vertices.begin(), vertices.end()}}});
  }
  return rows;
}

// The entry of a row and a column; 0 if it is not stored.
double EntryAt(const FormFactorMatrix& matrix, std::size_t row, std::int32_t column) {
  for (std::size_t k = matrix.first[row]; k < matrix.first[row + 1]; ++k)
    if (matrix.column[k] == column) return matrix.factor[k];
  return 0;
}

Scene UnitCube() {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  return scene;
}

// A cube with a smaller, turned one inside: all is seen from somewhere, and shadows lie everywhere.
Scene CubeInCube() {
  Scene scene = UnitCube();
  Scene inner;
  AddMaterial(inner, 0.5, 0);
  AddBox(inner, Vec3::Constant(-0.2), Vec3::Constant(0.15), false, 0);
  Random random(31);
  Motion motion = RandomMotion(random, 0);
  motion.shift = Vec3(0.5, 0.45, 0.55);
  inner = Mapped(inner, motion);
  scene.patches.insert(scene.patches.end(), inner.patches.begin(), inner.patches.end());
  return scene;
}

// In the cube, a face sees the opposite one by (Hottel)
//   2/pi (ln(2/sqrt 3) + 2 sqrt 2 atan(1/sqrt 2) - pi/2),
// the four others equally, and itself not.
TEST(FormFactorMatrix, IsHottelsInACube) {
  const Scene scene = UnitCube();
  const FormFactorMatrix matrix = ComputeFormFactorMatrix(scene, RowOfEachPatch(scene));
  using std::numbers::pi, std::numbers::sqrt2;
  const double opposite = 2 / pi * (std::log(2 / std::sqrt(3.0)) + 2 * sqrt2 * std::atan(1 / sqrt2) - pi / 2);
  const double aside = (1 - opposite) / 4;
  ASSERT_EQ(matrix.Rows(), 6u);
  EXPECT_EQ(matrix.pairs, 15u);
  for (std::size_t row = 0; row < 6; ++row)
    for (std::int32_t column = 0; column < 6; ++column) {
      const bool is_opposite = static_cast<std::size_t>(column ^ 1) == row;
      const double want = is_opposite ? opposite : static_cast<std::size_t>(column) == row ? 0 : aside;
      EXPECT_NEAR(EntryAt(matrix, row, column), want, 1e-9) << row << " to " << column;
    }
}

// In a closed scene all that leaves a row arrives: rows add up to 1 within the stated error, which is at most
// the tolerance; and what passes between two faces is the same either way, to the rounding of a division.
TEST(FormFactorMatrix, ClosesAndIsReciprocal) {
  const Scene scene = CubeInCube();
  FormFactorMatrixOptions options;
  options.tolerance = 1e-6;
  const FormFactorMatrix matrix = ComputeFormFactorMatrix(scene, RowOfEachPatch(scene), options);
  double worst = 0;
  for (std::size_t row = 0; row < matrix.Rows(); ++row) {
    EXPECT_LE(matrix.RowError(row), options.tolerance) << row;
    EXPECT_NEAR(matrix.RowSum(row), 1, matrix.RowError(row) + 1e-13) << row;
    worst = std::max(worst, std::abs(matrix.RowSum(row) - 1));
  }
  EXPECT_LE(matrix.ReciprocityError(), 4e-16);
  std::printf("largest |row sum - 1| %.3g\n", worst);
}

// A row of several faces is their mean by area, sends nothing to itself where they are the sides of a convex
// body, and what its own sides send each other where they are those of a room.
TEST(FormFactorMatrix, AddsUpTheFacesOfObjects) {
  const Scene scene = CubeInCube();
  const std::vector<std::vector<AreaPart>> faces = RowOfEachPatch(scene);
  std::vector<std::vector<AreaPart>> objects(2);
  for (std::size_t p = 0; p < faces.size(); ++p) objects[p < 6 ? 0 : 1].push_back(faces[p][0]);
  const FormFactorMatrix whole = ComputeFormFactorMatrix(scene, objects);
  ASSERT_EQ(whole.Rows(), 2u);
  EXPECT_EQ(EntryAt(whole, 1, 1), 0);
  // The convex body within sees only the room.
  EXPECT_NEAR(EntryAt(whole, 1, 0), 1, 1e-6);
  EXPECT_NEAR(EntryAt(whole, 0, 1), whole.area[1] / whole.area[0], 1e-6);
  EXPECT_NEAR(EntryAt(whole, 0, 0), 1 - whole.area[1] / whole.area[0], 1e-6);
}

// Referred to other areas, exchanges stay, and so does reciprocity; a row with factors never loses its area.
TEST(FormFactorMatrix, RefersToOtherAreas) {
  const Scene scene = UnitCube();
  FormFactorMatrix matrix = ComputeFormFactorMatrix(scene, RowOfEachPatch(scene));
  const double before = EntryAt(matrix, 2, 3);
  matrix.ReferTo({1, 1, 0.5, 1, 1, 0});
  EXPECT_DOUBLE_EQ(EntryAt(matrix, 2, 3), 2 * before);
  EXPECT_EQ(matrix.area[2], 0.5);
  EXPECT_EQ(matrix.area[5], 1);
  EXPECT_LE(matrix.ReciprocityError(), 4e-16);
}

// A single factor and the matrix's entry are the same number within their errors; the matrix does not depend
// on the number of threads.
TEST(FormFactorMatrix, AgreesWithSingleFactorsOnAnyThreads) {
  const Scene scene = CubeInCube();
  const std::vector<std::vector<AreaPart>> rows = RowOfEachPatch(scene);
  FormFactorMatrixOptions options;
  options.tolerance = 1e-5;
  SetThreadCount(1);
  const FormFactorMatrix one = ComputeFormFactorMatrix(scene, rows, options);
  SetThreadCount(3);
  const FormFactorMatrix three = ComputeFormFactorMatrix(scene, rows, options);
  SetThreadCount(0);
  EXPECT_EQ(one.factor, three.factor);
  EXPECT_EQ(one.error, three.error);
  EXPECT_EQ(one.column, three.column);
  AreaFormFactorOptions single;
  single.tolerance = 1e-5;
  for (std::size_t k = one.first[0]; k < one.first[1]; ++k) {
    const FormFactorEstimate alone =
        AreaFormFactor(scene, rows[0], rows[static_cast<std::size_t>(one.column[k])], single);
    EXPECT_NEAR(one.factor[k], alone.factor, one.error[k] + alone.error) << one.column[k];
  }
}

// Where nothing is seen there are no entries, and no area is no error.
TEST(FormFactorMatrix, IsEmptyWhereNothingIsSeen) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), false, 0);
  std::vector<std::vector<AreaPart>> rows = RowOfEachPatch(scene);
  rows.emplace_back();
  const FormFactorMatrix matrix = ComputeFormFactorMatrix(scene, rows);
  EXPECT_EQ(matrix.Rows(), 7u);
  EXPECT_TRUE(matrix.factor.empty());
  EXPECT_EQ(matrix.area[6], 0);
  EXPECT_EQ(matrix.RowSum(6), 0);
}

}  // namespace
}  // namespace penumbra::scene_test
