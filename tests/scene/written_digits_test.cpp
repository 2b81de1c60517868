#include "solver/scene/written_digits.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "solver/base/random.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

Vec3 StepOf(const std::vector<std::string>& words) {
  WrittenDigits digits;
  for (std::size_t i = 0; i < words.size(); ++i)
    digits.Add(static_cast<int>(i % 3), words[i], *ToNumber(words[i]));
  return digits.Step();
}

// Random coordinates of a room, as a format of printf writes them, perhaps without zeros at the end.
Vec3 StepOfFormat(const char* format, bool trimmed, double size = 4) {
  Random random(29);
  std::vector<std::string> words;
  for (int i = 0; i < 300; ++i) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, i % 7 == 0 ? 0.5 * size : random.Uniform(-size, size));
    std::string word = text.data();
    if (trimmed && word.find('.') != std::string::npos)
      while (word.back() == '0') word.pop_back();
    words.push_back(word);
  }
  return StepOf(words);
}

TEST(WrittenDigits, AreTheUnitThatTheWriterRoundedTo) {
  // A fixed number of decimals, with zeros at the end or without, and a number of significant digits, are
  // found again.
  for (const bool trimmed : {false, true}) {
    EXPECT_NEAR(StepOfFormat("%.3f", trimmed)[0], 1e-3, 1e-15);
    EXPECT_NEAR(StepOfFormat("%.6f", trimmed)[1], 1e-6, 1e-15);
    EXPECT_NEAR(StepOfFormat("%.9f", trimmed)[2], 1e-9, 1e-15);
    EXPECT_NEAR(StepOfFormat("%.6f", trimmed, 4e5)[0], 1e-6, 1e-15);
  }
  EXPECT_NEAR(StepOfFormat("%.6g", false)[0], 1e-5, 1e-15);
  EXPECT_NEAR(StepOfFormat("%.6g", false, 400)[0], 1e-3, 1e-15);
  EXPECT_NEAR(StepOfFormat("%.8e", false, 400)[0], 1e-6, 1e-15);
  EXPECT_LT(StepOfFormat("%.17g", false)[0], 1e-15);
}

TEST(WrittenDigits, OfSinglePrecisionAreThose) {
  // Numbers of single precision, however many digits are printed of them, tell no more than that.
  Random random(31);
  for (const char* format : {"%.9g", "%.17g", "%.12f"}) {
    WrittenDigits digits;
    for (int i = 0; i < 300; ++i) {
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), format,
                    static_cast<double>(static_cast<float>(random.Uniform(-4, 4))));
      digits.Add(i % 3, text.data(), *ToNumber(text.data()));
    }
    EXPECT_EQ(digits.Step(), Vec3::Constant(2 * 0x1p-23)) << format;
  }
}

TEST(WrittenDigits, OfFewNumbersAreTheFinest) {
  // One number with many decimals tells that all are exact to so many, noise of a cosine included.
  EXPECT_EQ(StepOf({"0", "0", "0"}), Vec3::Zero());
  EXPECT_NEAR(StepOf({"0.2", "1", ".5000000001"})[0], 1e-10, 1e-20);
  EXPECT_LT(StepOf({"6.123e-17", "0.5488", "0.5496"})[1], 1e-7);
  EXPECT_NEAR(StepOf({"1", "2.25", "3"})[0], 0.01, 1e-15);
}

}  // namespace
}  // namespace penumbra
