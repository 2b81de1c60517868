// What a user who misspelt a name may have meant.

#include "solver/base/similar_names.h"

#include <gtest/gtest.h>

#include "solver/base/random.h"

namespace penumbra {
namespace {

// The distance is a metric: 0 only for equal texts, symmetric, and no detour is shorter.
TEST(SimilarNames, HaveADistance) {
  std::vector<std::string> words;
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    std::string word;
    for (int letters = static_cast<int>(6 * random.Uniform()); letters > 0; --letters)
      word += static_cast<char>('a' + static_cast<int>(3 * random.Uniform()));
    words.push_back(word);
  }
  for (const std::string& a : words)
    for (const std::string& b : words) {
      EXPECT_EQ(EditDistance(a, b) == 0, a == b) << a << " " << b;
      EXPECT_EQ(EditDistance(a, b), EditDistance(b, a));
      for (const std::string& c : words)
        EXPECT_LE(EditDistance(a, c), EditDistance(a, b) + EditDistance(b, c)) << a << " " << b << " " << c;
    }
  EXPECT_EQ(EditDistance("", "lamp"), 4u);
  EXPECT_EQ(EditDistance("flor", "floor"), 1u);
}

// One slip in three letters is forgiven, capitals do not count, and a word like none gets no proposal.
TEST(SimilarNames, AreProposed) {
  const std::vector<std::string> names = {"floor", "ceiling", "Left_Wall"};
  EXPECT_EQ(DidYouMean("flor", names), "; did you mean 'floor'?");
  EXPECT_EQ(DidYouMean("left_wall", names), "; did you mean 'Left_Wall'?");
  EXPECT_EQ(DidYouMean("cieling", names), "; did you mean 'ceiling'?");
  EXPECT_EQ(DidYouMean("sphere", names), "");
  EXPECT_EQ(DidYouMean("x", {}), "");
  EXPECT_EQ(NearestFirst("ceilin", names).front(), "ceiling");
}

}  // namespace
}  // namespace penumbra
