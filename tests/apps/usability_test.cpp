// The command line as people type it: slips, pipes, several scenes at once, names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// Two squares that face each other a metre apart: a lamp of 1, 2 and 3 W/m^2 over a black floor.
constexpr const char* kSquares =
    "mtllib squares.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
    "o floor\nusemtl black\nf 1 2 3 4\no lamp\nusemtl glow\nf 5 6 7 8\n";
constexpr const char* kSquaresLibrary = "newmtl black\nKd 0 0 0\nnewmtl glow\nKd 0 0 0\nKe 1 2 3\n";

void WriteSquares(const Sandbox& sandbox) {
  sandbox.Write("squares.obj", kSquares);
  sandbox.Write("squares.mtl", kSquaresLibrary);
}

// What the registries hold is listed by kind, and what one lists exists: each name is taken where it is
// chosen.
TEST(Methods, AreListedByKind) {
  const Sandbox sandbox;
  const Outcome outcome = sandbox.Run({"methods", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json kinds = json::parse(outcome.out);
  for (const char* kind : {"solver", "form-factors", "oracle", "occlusion", "discontinuities",
                           "reconstruction", "reader", "writer", "image-writer", "overlay"}) {
    ASSERT_TRUE(kinds.contains(kind)) << kind;
    ASSERT_FALSE(kinds[kind].empty()) << kind;
    for (const json& method : kinds[kind]) {
      EXPECT_FALSE(method.at("name").get<std::string>().empty());
      EXPECT_FALSE(method.at("help").get<std::string>().empty()) << method;
      for (const json& parameter : method.at("parameters"))
        for (const char* key : {"name", "unit", "default", "help"})
          EXPECT_TRUE(parameter.contains(key)) << key;
    }
  }
  WriteSquares(sandbox);
  for (const json& method : kinds["occlusion"]) {
    sandbox.Write("p.csv", "x,y,z\n0.5,0.5,0\n");
    EXPECT_EQ(sandbox
                  .Run({"probe", "squares.obj", "--points", "p.csv", "--direct", "--method",
                        method["name"].get<std::string>()})
                  .status,
              0)
        << method;
  }
  const Outcome text = sandbox.Run({"methods"});
  EXPECT_THAT(text.out, HasSubstr("hierarchical"));
  EXPECT_THAT(text.out, HasSubstr("eps [W/m^2]"));
}

// A slip is answered with what was meant, on one line; what is like nothing gets no proposal.
TEST(Slips, AreAnsweredWithWhatWasMeant) {
  const Sandbox sandbox;
  WriteSquares(sandbox);
  const std::vector<std::pair<std::vector<std::string>, std::string>> slips = {
      {{"rendr", "cornell"}, "did you mean 'render'?"},
      {{"probe", "cornell", "--point", "p.csv"}, "did you mean '--points'?"},
      {{"info", "cornel"}, "did you mean 'cornell'?"},
      {{"info", "squares.obj", "--emittance", "glwo=1,1,1"}, "did you mean 'glow'?"},
      {{"form-factor", "squares.obj", "--from", "flor", "--to", "lamp"}, "did you mean 'floor'?"}};
  for (const auto& [arguments, meant] : slips) {
    const Outcome outcome = sandbox.Run(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr(meant));
    EXPECT_EQ(Lines(outcome.err).size(), 1u) << outcome.err;
  }
  EXPECT_THAT(sandbox.Run({"xyzzyplugh"}).err, Not(HasSubstr("did you mean")));
  EXPECT_THAT(sandbox.Run({"render", "squares.obj", "--false-color"}).err, Not(HasSubstr("no option")));
}

// Points come through a pipe, and take the normals of the faces on which they lie; each of several scenes
// gives its own table, in order.
TEST(Points, ComeThroughAPipeWithoutNormals) {
  const Sandbox sandbox;
  WriteSquares(sandbox);
  const Outcome given = sandbox.RunScript(
      "printf 'x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n0.2,0.3,1,0,0,-1\n' | penumbra probe squares.obj --points - "
      "--direct");
  ASSERT_EQ(given.status, 0) << given.err;
  const Outcome taken = sandbox.RunScript(
      "printf 'x,y,z\n0.5,0.5,0\n0.2,0.3,1\n' | penumbra probe squares.obj --points - --direct");
  EXPECT_EQ(given.out, taken.out);
  const Outcome twice = sandbox.RunScript(
      "printf 'x,y,z,nx,ny,nz\n0.5,0.5,0,,,\n0.2,0.3,1\n' | penumbra probe squares.obj squares.obj --points "
      "- --direct");
  EXPECT_EQ(twice.out, given.out + given.out);
  const Outcome nowhere = sandbox.RunScript(
      "printf 'x,y,z\n0.5,0.5,0\n\n0.5,0.5,0.5\n' | penumbra probe squares.obj --points - --direct");
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_EQ(nowhere.out, "");
  EXPECT_THAT(nowhere.err, HasSubstr("standard input:4: error: "));
  const Outcome closed = sandbox.RunScript("penumbra probe squares.obj --points - --direct <&-");
  EXPECT_EQ(closed.status, 1);
  EXPECT_THAT(closed.err, HasSubstr("standard input"));
  const Outcome one_file =
      sandbox.Run({"probe", "squares.obj", "squares.obj", "--points", "/dev/null", "-o", "x.csv"});
  EXPECT_EQ(one_file.status, 2);
}

// Lux are the eye's weights of the three channels times 179 lm/W.
TEST(Points, AreMeasuredInLux) {
  const Sandbox sandbox;
  WriteSquares(sandbox);
  sandbox.Write("p.csv", "x,y,z\n0.5,0.25,0\n");
  const std::vector<std::string> how = {"probe", "squares.obj", "--points", "p.csv", "--direct", "--parts"};
  std::vector<std::string> in_lux = how;
  in_lux.push_back("--photometric");
  const Outcome watts = sandbox.Run(how), lux = sandbox.Run(in_lux);
  ASSERT_EQ(lux.status, 0) << lux.err;
  EXPECT_EQ(Lines(lux.out)[0],
            "x,y,z,nx,ny,nz,patch,exact_lux,interp_lux,direct_lux,grad_lux_x,grad_lux_y,grad_lux_z");
  const std::vector<std::string> w = Fields(Lines(watts.out)[1]), l = Fields(Lines(lux.out)[1]);
  const auto expect_lux = [&](const std::string& value, std::size_t r, std::size_t g, std::size_t b) {
    const double want = 179 * (0.265 * std::stod(w[r]) + 0.670 * std::stod(w[g]) + 0.065 * std::stod(w[b]));
    EXPECT_NEAR(std::stod(value), want, 1e-12 * std::abs(want));
  };
  expect_lux(l[7], 7, 8, 9);
  expect_lux(l[9], 13, 14, 15);
  for (std::size_t axis = 0; axis < 3; ++axis) expect_lux(l[10 + axis], 16 + axis, 19 + axis, 22 + axis);
}

// Objects, materials and faces are named; of several scenes the one after the other is told.
TEST(Info, NamesWhatIsThere) {
  const Sandbox sandbox;
  WriteSquares(sandbox);
  const Outcome outcome = sandbox.Run({"info", "squares.obj", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json info = json::parse(outcome.out);
  ASSERT_EQ(info["objects"].size(), 2u);
  EXPECT_EQ(info["objects"][1]["name"], "lamp");
  EXPECT_EQ(info["objects"][1]["face_numbers"], json({1}));
  ASSERT_EQ(info["materials"].size(), 2u);
  EXPECT_EQ(info["materials"][1]["name"], "glow");
  EXPECT_EQ(info["materials"][1]["emittance"], json({1.0, 2.0, 3.0}));
  EXPECT_DOUBLE_EQ(info["emitted_lumens"], 179 * (0.265 * 1 + 0.670 * 2 + 0.065 * 3));
  ASSERT_EQ(info["face_list"].size(), 2u);
  EXPECT_EQ(info["face_list"][1]["object"], "lamp");
  EXPECT_EQ(info["face_list"][1]["material"], "glow");
  EXPECT_EQ(info["face_list"][1]["area"], 1.0);
  EXPECT_EQ(info["face_list"][1]["normal"], json({0.0, 0.0, -1.0}));
  const Outcome text = sandbox.Run({"info", "squares.obj", "cornell"});
  EXPECT_THAT(text.out, HasSubstr("2: black and glow"));
  EXPECT_LT(text.out.find("floor and lamp"), text.out.find("tall_block"));
}

}  // namespace
}  // namespace penumbra
