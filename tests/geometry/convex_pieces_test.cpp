#include "solver/geometry/convex_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

using ::testing::ElementsAre;
using Corners = std::array<std::int32_t, 3>;

TEST(ConvexPieces, QualityOfQuadrilaterals) {
  // A rectangle has quality 1, a rhombus the sine of its angle; straight, concave and clockwise ones have
  // none.
  EXPECT_EQ(QuadrilateralQuality({0, 0}, {3, 0}, {3, 1}, {0, 1}), 1);
  EXPECT_NEAR(QuadrilateralQuality({0, 0}, {1, 0}, {1.5, std::sqrt(0.75)}, {0.5, std::sqrt(0.75)}),
              std::sqrt(0.75), 1e-15);
  EXPECT_EQ(QuadrilateralQuality({0, 0}, {1, 0}, {2, 0}, {0, 1}), 0);
  EXPECT_EQ(QuadrilateralQuality({0, 0}, {2, 0}, {0.1, 0.1}, {0, 2}), 0);
  EXPECT_EQ(QuadrilateralQuality({0, 0}, {0, 1}, {1, 1}, {1, 0}), 0);
}

TEST(ConvexPieces, StraightCornersGoWhereverTheyStand) {
  // Straight corners go, also the first and last; a needle's sharp end is no straight corner; three vertices
  // remain.
  EXPECT_THAT(WithoutStraightCorners(std::vector<Vec2>{{0.5, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {0.2, 0}}),
              ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(WithoutStraightCorners(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1e-12}, {0, 1e-12}}),
              ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(WithoutStraightCorners(std::vector<Vec2>{{0, 0}, {1, 0}, {2, 0}, {3, 0}}).size(), 3u);
}

TEST(ConvexPieces, AFanOfSixIsThreeQuadrilaterals) {
  // A chain of triangles is joined from its ends, so that none is left over.
  std::vector<Vec2> vertices;
  std::vector<Corners> triangles;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * i / 8;
    vertices.push_back({std::cos(angle), std::sin(angle)});
    if (i >= 2) triangles.push_back({0, i - 1, i});
  }
  const std::vector<ConvexPiece> pieces = JoinTriangles(vertices, triangles);
  ASSERT_EQ(pieces.size(), 3u);
  for (const ConvexPiece& piece : pieces) EXPECT_EQ(piece.Size(), 4);
  EXPECT_THAT(pieces[0].vertex, ElementsAre(0, 1, 2, 3));
}

TEST(ConvexPieces, WhatCannotBeJoinedStays) {
  // Triangles that touch in a corner, or would form a triangle, stay triangles.
  const std::vector<Vec2> vertices = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const std::vector<Corners> corner = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(JoinTriangles(vertices, corner).size(), 2u);
  const std::vector<Corners> straight = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(JoinTriangles(vertices, straight).size(), 2u);
  EXPECT_TRUE(JoinTriangles(vertices, {}).empty());
}

}  // namespace
}  // namespace penumbra
