// The classic form factors and solvers, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

// F and its error, as form-factor prints them.
std::pair<double, double> PrintedFactor(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  double factor = -1, error = -1;
  EXPECT_EQ(std::sscanf(outcome.out.c_str(), "%lg %lg", &factor, &error), 2) << outcome.out;
  return {factor, error};
}

// Two opposite and two adjoining faces of a closed cube, by every method and within four stated errors. Both
// names of the option mean the same.
TEST(ClassicFormFactors, OfACube) {
  const Sandbox sandbox;
  sandbox.Write("cube.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n");
  constexpr double kOpposite = 0.1998248957, kAdjoining = 0.2000437761;
  for (const char* method : {"cubature", "exact", "hemicube", "cubic-tetrahedron", "single-plane",
                             "two-planes", "rays", "rays-book", "malley", "monte-carlo", "contour"}) {
    const auto of = [&](const char* option, const char* to) {
      std::vector<std::string> arguments = {"form-factor", "cube.obj", "--from", "0",
                                            "--to",        to,         option,   method};
      for (const char* by_rays : {"rays", "rays-book", "malley", "monte-carlo"})
        if (method == std::string(by_rays)) arguments.insert(arguments.end(), {"--rays", "100000"});
      return PrintedFactor(sandbox.Run(arguments));
    };
    const auto [opposite, error] = of("--form-factors", "1");
    EXPECT_NEAR(opposite, kOpposite, 4 * error + 1e-10) << method;
    const auto [adjoining, other] = of("--method", "2");
    EXPECT_NEAR(adjoining, kAdjoining, 4 * other + 1e-10) << method;
  }
}

// More cells and more rays come closer, and options of other methods are refused.
TEST(ClassicFormFactors, TakeTheirOptions) {
  const Sandbox sandbox;
  const auto with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"form-factor", "furnace", "--from", "0", "--to", "1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return sandbox.Run(arguments);
  };
  const auto error_of = [&](const std::vector<std::string>& options) {
    return PrintedFactor(with(options)).second;
  };
  EXPECT_LT(error_of({"--method", "hemicube", "--resolution", "300"}),
            error_of({"--method", "hemicube", "--resolution", "10"}));
  EXPECT_LT(error_of({"--method", "malley", "--rays", "100000"}),
            error_of({"--method", "malley", "--rays", "100"}));
  EXPECT_NE(with({"--method", "malley", "--seed", "1", "--rays", "1000"}).out,
            with({"--method", "malley", "--seed", "2", "--rays", "1000"}).out);
  EXPECT_EQ(with({"--method", "hemicube", "--rays", "10"}).status, 2);
  EXPECT_EQ(with({"--method", "rays", "--resolution", "10"}).status, 2);
  EXPECT_EQ(with({"--method", "contour", "--rays", "10"}).status, 2);
}

// Every classic solver solves, reports what it was told, and finds the furnace's irradiance at a point;
// rayrad less of it, since its vertices lose light where walls meet.
TEST(ClassicSolvers, SolveFromTheCommandLine) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.4,0.45,0,0,0,1\n");
  const std::string truth =
      sandbox.Run({"probe", "furnace", "--points", "points.csv", "--error", "0.05"}).out;
  const double wanted = std::stod(Fields(Lines(truth).at(1)).at(7));
  for (const std::string solver : {"progressive", "full-matrix", "stochastic", "rayrad"}) {
    std::vector<std::string> arguments = {
        "probe",    "furnace", "--points", "points.csv", "--solver",          solver, "--divisions", "2",
        "--report", "r.json",  "--error",  "0.1",        "--relative-cutoff", "1e-5"};
    if (solver == "progressive") arguments.insert(arguments.end(), {"--overshoot", "--ambient"});
    if (solver == "rayrad") arguments.insert(arguments.end(), {"--rays", "64"});
    const Outcome outcome = sandbox.Run(arguments);
    ASSERT_EQ(outcome.status, 0) << solver << ": " << outcome.err;
    const double found = std::stod(Fields(Lines(outcome.out).at(1)).at(7));
    EXPECT_NEAR(found, wanted, (solver == "rayrad" ? 0.4 : 0.05) * wanted) << solver;
    const auto report = nlohmann::json::parse(ReadBytes(sandbox.Path("r.json")));
    EXPECT_EQ(report.at("options").at("solver"), solver);
    EXPECT_EQ(report.at("options").at("divisions"), 2);
    EXPECT_FALSE(report.at("iterations").empty());
    EXPECT_EQ(report.at("options").contains("overshoot"), solver == "progressive");
  }
}

// Steps can be counted, and options of other solvers are refused.
TEST(ClassicSolvers, CountTheirSteps) {
  const Sandbox sandbox;
  EXPECT_EQ(sandbox
                .Run({"solve", "cornell", "--solver", "progressive", "--form-factors", "hemicube",
                      "--resolution", "20", "--divisions", "1", "--shots", "3", "--error", "0.5",
                      "--error-points", "0", "--report", "r.json"})
                .status,
            0);
  const auto report = nlohmann::json::parse(ReadBytes(sandbox.Path("r.json")));
  EXPECT_EQ(report.at("iterations").size(), 3U);
  EXPECT_EQ(report.at("options").at("resolution"), 20);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--solver", "full-matrix", "--overshoot"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--solver", "stochastic", "--form-factors", "exact"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--resolution", "20"}).status, 2);
  EXPECT_EQ(sandbox.Run({"solve", "furnace", "--shots", "20"}).status, 2);
}

}  // namespace
}  // namespace penumbra
