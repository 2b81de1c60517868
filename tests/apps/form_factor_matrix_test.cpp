// `penumbra form-factor --all`: rows of what nothing covers, and what cannot be meant.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

// A room of 3 by 2 by 1 m; a box of 1 by 1 by 0.5 m stands on its floor, with or without a bottom.
std::string RoomWithBox(bool has_bottom) {
  std::string text =
      "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 3 2 0\nv 0 0 1\nv 3 0 1\nv 0 2 1\nv 3 2 1\n"
      "v 1 .5 0\nv 2 .5 0\nv 1 1.5 0\nv 2 1.5 0\nv 1 .5 .5\nv 2 .5 .5\nv 1 1.5 .5\nv 2 1.5 .5\n"
      "o floor\nf 1 2 4 3\no room\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
      "o box\nf 13 14 16 15\nf 9 10 14 13\nf 12 11 15 16\nf 11 9 13 15\nf 10 12 16 14\n";
  if (has_bottom) text += "f 9 11 12 10\n";
  return text;
}

// The sums of rows of a matrix in CSV.
std::map<std::string, double> RowSums(const std::string& csv) {
  std::map<std::string, double> sums;
  const std::vector<std::string> lines = Lines(csv);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = Fields(lines[i]);
    sums[fields[0]] += std::stod(fields[2]);
  }
  return sums;
}

// In a closed room every row adds up to 1, the floor's, too: it counts what the box leaves of it. What the
// floor sends of that area is, by reciprocity, what single factors tell of the whole floor.
TEST(FormFactorMatrixCommand, CountsWhatNothingCovers) {
  for (const bool has_bottom : {false, true}) {
    const Sandbox sandbox;
    sandbox.Write("room.obj", RoomWithBox(has_bottom));
    const Outcome all = sandbox.Run({"form-factor", "room.obj", "--all"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_THAT(all.err, HasSubstr("that other faces cover"));
    const std::map<std::string, double> sums = RowSums(all.out);
    EXPECT_EQ(sums.size(), 11u);  // the bottom sends nothing
    for (const auto& [row, sum] : sums) EXPECT_NEAR(sum, 1, 1e-6) << row << (has_bottom ? ", bottom" : "");
    const Outcome single = sandbox.Run({"form-factor", "room.obj", "--from", "0", "--to", "1"});
    double to_ceiling = 0;
    for (const std::string& line : Lines(all.out))
      if (line.starts_with("0,1,")) to_ceiling = std::stod(Fields(line)[2]);
    EXPECT_NEAR(to_ceiling * 5, std::stod(single.out) * 6, 1e-6);
  }
}

// Objects of a room send each other what they do not keep; without a room a plate in the sky keeps its area.
TEST(FormFactorMatrixCommand, AddsUpObjects) {
  const Sandbox sandbox;
  sandbox.Write("room.obj", RoomWithBox(true));
  const Outcome all = sandbox.Run({"form-factor", "room.obj", "--all", "--by", "object", "-o", "F.csv"});
  ASSERT_EQ(all.status, 0) << all.err;
  for (const auto& [row, sum] : RowSums(ReadBytes(sandbox.Path("F.csv")))) EXPECT_NEAR(sum, 1, 1e-6) << row;
  sandbox.Write("plate.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome plate = sandbox.Run({"form-factor", "plate.obj", "--all"});
  EXPECT_EQ(plate.out, "from,to,F,error\n");
  EXPECT_THAT(plate.err, HasSubstr("area           1 m^2, without 0 m^2"));
}

TEST(FormFactorMatrixCommand, RefusesWhatCannotBeMeant) {
  const Sandbox sandbox;
  sandbox.Write("room.obj", RoomWithBox(true));
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{},
                                             {"--from", "0"},
                                             {"--all", "--from", "0", "--to", "1"},
                                             {"--from", "0", "--to", "1", "--by", "object"},
                                             {"--from", "0", "--to", "1", "-o", "F.csv"},
                                             {"--all", "--method", "monte-carlo"},
                                             {"--all", "-o", "F.txt"}}) {
    std::vector<std::string> arguments = {"form-factor", "room.obj"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(sandbox.Run(arguments).status, 2);
  }
  EXPECT_THAT(sandbox.Files(), testing::ElementsAre("room.obj"));
}

}  // namespace
}  // namespace penumbra
