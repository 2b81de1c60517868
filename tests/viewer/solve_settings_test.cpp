// The options of a solve in the window: each has a setting, which says and sets what the table says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

using viewer_test::Options;
using viewer_test::ShadowScene;

// Texts of values that the option may have.
std::vector<std::string> Texts(const OptionField& field) {
  switch (field.kind) {
    case OptionKind::kInteger:
      return {std::to_string(field.integers.high), std::to_string(field.integers.low)};
    case OptionKind::kNumber:
      return {ValueText(field, field.numbers.high), ValueText(field, field.numbers.low)};
    case OptionKind::kFlag:
    case OptionKind::kChoice:
      break;
  }
  return field.choices();
}

// Each option can be set in the window, under its name and by its words, and no value that it may not have.
TEST(SolveSettings, EveryOptionHasOne) {
  Viewer viewer(ShadowScene(), Options(false));
  for (const SolveOption& option : OptionTable()) {
    SCOPED_TRACE(option.name);
    const std::string name = SettingName(option);
    const Setting* setting = viewer.settings().Find(name);
    ASSERT_NE(setting, nullptr);
    EXPECT_EQ(setting->group, option.group == OptionGroup::kStudies ? "For studies" : "Solving");
    if (!option.solver.empty()) viewer.Set("solver", option.solver);
    if (!option.form_factors.empty()) viewer.Set("form-factors", option.form_factors.front());
    for (const std::string& text : Texts(option.field)) {
      viewer.Set(name, text);
      EXPECT_EQ(setting->get(), text);
      EXPECT_EQ(option.field.get(viewer.solving()), ParseValue(option.field, text));
    }
    EXPECT_THROW(viewer.Set(name, "?"), InputError);
    if (option.field.optional) {
      viewer.Set(name, "auto");
      EXPECT_FALSE(option.field.get(viewer.solving()));
    }
  }
}

// What is left out shows what it comes to.
TEST(SolveSettings, WhatIsLeftOutShowsItsValue) {
  Viewer viewer(ShadowScene(), Options(false));
  const auto shown = [&](const char* name) { return viewer.settings().Find(name)->get(); };
  EXPECT_THAT(shown("eps"), testing::MatchesRegex("auto \\(.*\\)"));
  EXPECT_EQ(shown("relative-cutoff"), "auto (0.0005)");
  EXPECT_EQ(shown("weight"), "auto");
  EXPECT_EQ(shown("time-limit"), "none");
}

// What the dense solver is told is kept while another one is chosen, and may be told before it is chosen.
TEST(SolveSettings, OptionsOfASolverAreKept) {
  Viewer viewer(ShadowScene(), Options(false));
  const auto shown = [&](const char* name) { return viewer.settings().Find(name)->get(); };
  viewer.Set("basis", "linear");
  viewer.Set("divisions", "2");
  EXPECT_EQ(shown("basis"), "linear");
  EXPECT_EQ(viewer.solving().SolverName(), "hierarchical");
  viewer.Set("solver", "dense");
  EXPECT_EQ(shown("basis"), "linear");
  EXPECT_EQ(FindOption("basis")->field.get(viewer.solving()), OptionValue("linear"));
  viewer.Set("basis", "quadratic");
  viewer.Set("solver", "hierarchical");
  EXPECT_EQ(shown("basis"), "quadratic");
  EXPECT_EQ(shown("divisions"), "2");
  viewer.Set("solver", "dense");
  EXPECT_EQ(FindOption("basis")->field.get(viewer.solving()), OptionValue("quadratic"));
}

}  // namespace
}  // namespace penumbra::viewer
