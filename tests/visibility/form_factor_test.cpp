// The form factor of a point to a polygon of directions.

#include "solver/visibility/point/form_factor.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <vector>

#include "solver/visibility/point/form_factor_batch.h"
#include "tests/cases.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

double OfParts(const Vec3& base, const std::array<Vec3, 3>& offset, const Vec3& normal, int halvings) {
  if (halvings == 0) return FormFactorByQuadrature(base, offset, normal);
  const Vec3 &a = offset[0], &b = offset[1], &c = offset[2];
  const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return OfParts(base, {a, ab, ca}, normal, halvings - 1) + OfParts(base, {ab, b, bc}, normal, halvings - 1) +
         OfParts(base, {ca, bc, c}, normal, halvings - 1) + OfParts(base, {ab, bc, ca}, normal, halvings - 1);
}

// By quadrature a polygon's form factor is the sum of those of its parts, and the parts are so small that
// their quadrature is exact but for rounding.
TEST(FormFactor, QuadratureOfPartsAddsUp) {
  Random random(511);
  double worst = 0;
  for (int i = 0; i < CaseCount(1000); ++i) {
    const double size = random.LogUniform(0.005, 1);
    const Vec3 base = RandomDirection(random), normal = (base + RandomDirection(random)).normalized();
    std::array<Vec3, 3> offset = {Vec3::Zero(), size * RandomDirection(random),
                                  size * RandomDirection(random)};
    if (offset[1].cross(offset[2]).dot(base) < 0) std::swap(offset[1], offset[2]);
    const bool above =
        normal.dot(base) > 0 && normal.dot(base + offset[1]) > 0 && normal.dot(base + offset[2]) > 0;
    // Seen too flatly, roundings of the vertices decide.
    if (!above || offset[1].cross(offset[2]).dot(base) < 0.01 * size * size) continue;
    const double parts = OfParts(base, offset, normal, 5);
    worst = std::max(worst, std::abs(FormFactorByQuadrature(base, offset, normal) / parts - 1));
  }
  std::printf("seed 511, largest error %.2g (bound %.2g)\n", worst, kFormFactorError);
  EXPECT_LE(worst, kFormFactorError);
}

// The sum over the edges with its way out where it cancels, pure quadrature, and the vectorised batch give
// the same to the stated bound, from 1e-3 to 1e3 in size and distance, no flatter than 0.01 on either side.
TEST(FormFactor, SumQuadratureAndBatchAgree) {
  Random random(512);
  PolygonBatch batch;
  std::vector<double> wanted, summed;
  std::vector<Vec3> normals;
  double by_sum = 0, by_batch = 0;
  int cancelled = 0;
  const int polygons = CaseCount(50000);
  for (int i = 0; i < polygons; ++i) {
    const Vec3 towards = random.LogUniform(1e-3, 1e3) * RandomDirection(random);
    const double size = random.LogUniform(1e-3, 1e3);
    const Vec3 u = size * RandomDirection(random),
               v = size * random.LogUniform(0.1, 1) * RandomDirection(random);
    Polygon3 polygon = {towards - u - v, towards + u - v, towards + u + v, towards - u + v};
    if (random.Index(3) == 0) polygon.pop_back();
    // Counter-clockwise about a normal that points to the origin.
    if (VectorArea(polygon).dot(polygon[0]) > 0) std::reverse(polygon.begin(), polygon.end());
    const double slant =
        -VectorArea(polygon).dot(polygon[0]) / (VectorArea(polygon).norm() * polygon[0].norm());
    if (!(slant > 0.01)) continue;
    // As low over the horizon as it comes.
    Vec3 normal = RandomDirection(random);
    if (random.Index(2) == 0)
      normal = (normal - normal.dot(towards) / towards.squaredNorm() * towards).normalized();
    double lowest = 1;
    for (const Vec3& p : polygon) lowest = std::min(lowest, normal.dot(p) / p.norm());
    if (lowest < 0.01) continue;
    const DirectionPolygon seen = Seen({Vec3::Zero(), normal, Vec3::Zero(), 0}, polygon, true);
    std::vector<Vec3> offset;
    for (int k = 0; k < seen.size(); ++k) offset.push_back(seen[k] - seen[0]);
    const double want = FormFactorByQuadrature(seen[0], offset, normal);
    batch.Add(polygon);
    normals.push_back(normal);
    wanted.push_back(want);
    by_sum = std::max(by_sum, std::abs(FormFactor(seen, normal) / want - 1));
    cancelled += want < 1e-3;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    double got = 0;
    FormFactors(batch, i, i + 1, Vec3::Zero(), normals[i], &got);
    by_batch = std::max(by_batch, std::abs(got / wanted[i] - 1));
    FormFactorSums sums;
    sums.Find(batch, i, i + 1, Vec3::Zero(), normals[i]);
    const double scale =
        std::max(wanted[i], sums.SizeAdded(0) / (2 * std::numbers::pi * kFormFactorCancellation));
    EXPECT_NEAR(sums.Factor(0), wanted[i], 2 * kFormFactorError * scale);
  }
  std::printf("seed 512, %zu polygons, %d below 1e-3: sum off by %.2g, batch by %.2g (bound %.2g each)\n",
              wanted.size(), cancelled, by_sum, by_batch, kFormFactorError);
  EXPECT_GT(wanted.size(), static_cast<std::size_t>(polygons) / 20);
  EXPECT_LE(by_sum, 2 * kFormFactorError);
  EXPECT_LE(by_batch, 2 * kFormFactorError);
}

// Parts of a whole need digits relative to the whole only: a square in 64 x 64 adds up to its form factor.
TEST(FormFactorBatch, PartsAddUpToTheWhole) {
  Random random(513);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const double height = random.LogUniform(1e-3, 10);
    const Vec3 corner(random.Uniform(-1, 0), random.Uniform(-1, 0), height);
    const Vec3 normal = (Vec3(random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 1)).normalized();
    if (normal.dot(corner) <= 0 || normal.dot(corner + Vec3(1, 0, 0)) <= 0 ||
        normal.dot(corner + Vec3(0, 1, 0)) <= 0 || normal.dot(corner + Vec3(1, 1, 0)) <= 0)
      continue;
    constexpr int kParts = 64;
    PolygonBatch whole, parts;
    const auto add = [&](PolygonBatch& batch, double x, double y, double size) {
      // Its front looks down.
      const Vec3 a = corner + Vec3(x, y, 0);
      const Polygon3 square = {a, a + Vec3(0, size, 0), a + Vec3(size, size, 0), a + Vec3(size, 0, 0)};
      batch.Add(square);
    };
    add(whole, 0, 0, 1);
    for (int k = 0; k < kParts * kParts; ++k)
      add(parts, static_cast<double>(k % kParts) / kParts, static_cast<double>(k / kParts) / kParts,
          1.0 / kParts);
    double want = 0, sum = 0;
    FormFactors(whole, 0, 1, Vec3::Zero(), normal, &want);
    FormFactorSums sums;
    sums.Find(parts, 0, parts.size(), Vec3::Zero(), normal);
    for (std::size_t k = 0; k < parts.size(); ++k) sum += sums.Factor(k);
    worst = std::max(worst, std::abs(sum / want - 1));
  }
  std::printf("seed 513: sums off by %.2g (bound %.2g)\n", worst, kFormFactorError);
  EXPECT_LE(worst, kFormFactorError);
}

}  // namespace
}  // namespace penumbra::scene_test
