// Labels and owners of what clipping leaves of a source say what they were made to say.

#include "solver/visibility/point/image_edges.h"

#include <gtest/gtest.h>

#include "solver/visibility/point/image_frame.h"

namespace penumbra {
namespace {

// A label is of one kind, and keeps its numbers, however many occluders there are.
TEST(EdgeLabel, TellsWhatTheEdgeRunsAlong) {
  EXPECT_TRUE(EdgeLabel::Inner().IsInner());
  EXPECT_FALSE(EdgeLabel::Inner().IsOfSource());
  for (int edge = 0; edge < ImagePolygon::kCapacity; ++edge) {
    const EdgeLabel label = EdgeLabel::OfSource(edge);
    EXPECT_TRUE(label.IsOfSource() && !label.IsInner());
    EXPECT_EQ(label.SourceEdge(), edge);
  }
  for (const std::size_t occluder : {std::size_t{0}, std::size_t{1}, std::size_t{200'000'000}})
    for (int plane = 0; plane < 12; ++plane) {
      const EdgeLabel label = EdgeLabel::OfOccluder(occluder, plane);
      EXPECT_TRUE(!label.IsOfSource() && !label.IsInner());
      EXPECT_EQ(label.Occluder(), occluder);
      EXPECT_EQ(label.Plane(), static_cast<std::size_t>(plane));
    }
}

TEST(PieceOwner, TellsPartsFromGroups) {
  EXPECT_FALSE(PieceOwner::Part(0).IsGroup());
  EXPECT_TRUE(PieceOwner::Group(0).IsGroup());
  EXPECT_EQ(PieceOwner::Part(7).Number(), 7);
  EXPECT_EQ(PieceOwner::Group(7).Number(), 7);
}

}  // namespace
}  // namespace penumbra
