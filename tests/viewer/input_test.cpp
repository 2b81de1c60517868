// Keys are called by what they print, whatever the keyboard: each chord of the menus can be typed.

#include "display/viewer/input.h"

#include <gtest/gtest.h>

namespace penumbra::viewer {
namespace {

TEST(Keys, AreCalledByWhatTheyType) {
  // American, German, French.
  EXPECT_EQ(ChordOf("/", kShift, '?'), (KeyChord{"?", kNoModifier}));
  EXPECT_EQ(ChordOf("=", kShift, '+'), (KeyChord{"+", kNoModifier}));
  EXPECT_EQ(ChordOf("-", kShift, '?'), (KeyChord{"?", kNoModifier}));
  EXPECT_EQ(ChordOf("]", kNoModifier, '+'), (KeyChord{"+", kNoModifier}));
  EXPECT_EQ(ChordOf("y", kNoModifier, 'z'), (KeyChord{"z", kNoModifier}));
  EXPECT_EQ(ChordOf("1", kShift, '1'), (KeyChord{"1", kNoModifier}));
  EXPECT_EQ(ChordOf("", kNoModifier, '<'), (KeyChord{"<", kNoModifier}));
}

// Letters have one name; what the layout does not print, or another alphabet prints, is called by its place.
TEST(Keys, KeepTheirNamesWhereNothingElseIsTyped) {
  EXPECT_EQ(ChordOf("a", kShift, 'A'), (KeyChord{"a", kShift}));
  EXPECT_EQ(ChordOf("a", kNoModifier, 'A'), (KeyChord{"a", kNoModifier}));  // caps lock
  EXPECT_EQ(ChordOf("s", kCtrl, 0), (KeyChord{"s", kCtrl}));
  EXPECT_EQ(ChordOf("/", kShift, 0), (KeyChord{"/", kShift}));
  EXPECT_EQ(ChordOf("space", kNoModifier, ' '), (KeyChord{"space", kNoModifier}));
  EXPECT_EQ(ChordOf("a", kNoModifier, 0x444), (KeyChord{"a", kNoModifier}));
}

}  // namespace
}  // namespace penumbra::viewer
