// The viewer without a window: everything that a user can do, done.

#include "display/viewer/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <thread>

#include "display/exr_image.h"
#include "display/opengl_passes.h"
#include "display/viewer/analyses.h"
#include "display/viewer/line_plot.h"
#include "display/viewer/script.h"
#include "display/viewer/selection.h"
#include "display/viewer/user_files.h"
#include "solver/base/check.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

using testing::HasSubstr;
using viewer_test::Click;
using viewer_test::Drag;
using viewer_test::Options;
using viewer_test::PlaceOf;
using viewer_test::Settle;
using viewer_test::ShadowScene;

// Pixels that differ.
std::size_t Difference(const Srgb8Image& a, const Srgb8Image& b) {
  if (a.pixels.size() != b.pixels.size()) return std::max(a.pixels.size(), b.pixels.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
  return count;
}

class SolvedViewer : public testing::Test {
 protected:
  SolvedViewer() : viewer(ShadowScene(), Options(true)) { EXPECT_TRUE(Settle(viewer)); }
  Viewer viewer;
};

TEST_F(SolvedViewer, FollowsTheSolutionToItsInterpolants) {
  EXPECT_TRUE(viewer.snapshot().converged);
  EXPECT_TRUE(viewer.snapshot().Mesh(MeshKind::kInterpolant));
  EXPECT_EQ(viewer.picture().drawn_kind(), MeshKind::kInterpolant);
}

// OpenGL draws what the rasteriser draws, edges aside, and so it does again after a change of the mesh.
TEST_F(SolvedViewer, OpenGlDrawsThePassesAsWell) {
  try {
    OpenGlPasses({});
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  for (const char* mode : {"interpolant", "flat"}) {
    viewer.Set("mode", mode);
    viewer.Set("backend", "software");
    EXPECT_TRUE(Settle(viewer));
    const Srgb8Image before = viewer.Frame(96, 64, 0);
    viewer.Set("backend", "opengl");
    const Srgb8Image after = viewer.Frame(96, 64, 0);
    EXPECT_EQ(viewer.view().backend, Backend::kOpenGl);
    EXPECT_EQ(viewer.message(), "");
    std::size_t different = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i)
      different += std::abs(before.pixels[i] - after.pixels[i]) > 1 ? 1 : 0;
    EXPECT_LT(different, before.pixels.size() / 100) << mode;
  }
}

// The picture is a function of state and view: the way to them does not matter.
TEST_F(SolvedViewer, ThePictureDependsOnStateAndViewAlone) {
  const Srgb8Image before = viewer.Frame(96, 64, 0);
  Drag(viewer, MouseButton::kLeft, 20, 20, 60, 40);
  viewer.Set("element-mesh", "on");
  viewer.Set("mode", "flat");
  EXPECT_TRUE(Settle(viewer));
  EXPECT_GT(Difference(before, viewer.Frame(96, 64, 0)), 100U);
  viewer.Frame(31, 77, 0);
  viewer.RunMenu("Viewing/Home");
  viewer.Set("element-mesh", "off");
  viewer.Set("mode", "interpolant");
  EXPECT_TRUE(Settle(viewer));
  EXPECT_EQ(Difference(before, viewer.Frame(96, 64, 0)), 0U);
}

TEST_F(SolvedViewer, EveryMenuItemRuns) {
  const std::vector<MenuItem> items = viewer.menu().items();
  std::set<std::string> keys;
  for (const MenuItem& item : items) {
    if (!item.key.empty()) {
      EXPECT_TRUE(ParseChord(item.key)) << item.key;
      EXPECT_TRUE(keys.insert(item.key).second) << "two items for " << item.key;
    }
    SCOPED_TRACE(item.path);
    viewer.RunMenu(item.path);
    viewer.Frame(48, 32, 0.01);
    EXPECT_TRUE(Settle(viewer, 48, 32));
    EXPECT_EQ(viewer.message(), "");
  }
}

TEST_F(SolvedViewer, EverySettingTakesBackWhatItGives) {
  for (const Setting& setting : viewer.settings().all()) {
    if (setting.group == "Files" || setting.automatic) continue;
    SCOPED_TRACE(setting.name);
    const std::string value = setting.get();
    EXPECT_NO_THROW(viewer.Set(setting.name, value));
    EXPECT_EQ(setting.get(), value);
    EXPECT_THROW(viewer.Set(setting.name, "?"), InputError);
    EXPECT_EQ(setting.get(), value);
  }
  EXPECT_THROW(viewer.Set("no-such-option", "1"), InputError);
  EXPECT_THROW(viewer.RunMenu("No/Such/Item"), InputError);
}

TEST_F(SolvedViewer, EveryModeAndSizeDraws) {
  for (const char* mode : {"flat", "gouraud", "gouraud-mesh", "interpolant", "exact", "lerp", "rho", "nodal",
                           "gouraud-screen", "bilinear", "bicubic"})
    for (const char* split : {"off", "on"}) {
      viewer.Set("mode", mode);
      viewer.Set("split", split);
      ASSERT_TRUE(Settle(viewer));
      EXPECT_EQ(viewer.picture().drawn_kind(), MeshOf(viewer.view().mode));
      for (const auto& [w, h] : {std::pair{1, 1}, {1, 50}, {50, 1}, {2, 3}, {97, 33}}) {
        const Srgb8Image& picture = viewer.Frame(w, h, 0.01);
        EXPECT_EQ(picture.width, w);
        EXPECT_EQ(picture.height, h);
      }
    }
}

// What was done is taken back, whatever it was, and done again: the pictures are the same to the last bit.
TEST_F(SolvedViewer, UndoTakesBackSettingsSelectionsAndSolverSteps) {
  viewer.Set("mode", "flat");
  viewer.Set("isolate", "off");
  ASSERT_TRUE(Settle(viewer));
  const Srgb8Image flat = viewer.Frame(96, 64, 0);
  viewer.Set("element-mesh", "on");
  viewer.Set("mesh-depth", "1");
  const ScreenPoint at = PlaceOf(viewer, Vec3(-0.8, -0.7, 0));
  Click(viewer, MouseButton::kLeft, at.x, at.y);
  ASSERT_TRUE(viewer.view().selection);
  const auto light = viewer.snapshot().light;
  const auto mesh = viewer.snapshot().Mesh(MeshKind::kInterpolant);
  viewer.RunMenu("Iteration/Link");  // throws away all that was solved
  ASSERT_TRUE(Settle(viewer));
  ASSERT_NE(viewer.snapshot().light, light);
  const Srgb8Image last = viewer.Frame(96, 64, 0);
  Drag(viewer, MouseButton::kMiddle, 20, 20, 60, 40);  // the camera is no part of it
  const Vec3 eye = viewer.view().camera.eye;
  viewer.Undo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().light, light);
  EXPECT_EQ(viewer.snapshot().Mesh(MeshKind::kInterpolant), mesh);
  EXPECT_TRUE(viewer.snapshot().converged);
  EXPECT_EQ(viewer.view().camera.eye, eye);
  EXPECT_TRUE(viewer.view().selection);
  viewer.Undo();
  EXPECT_FALSE(viewer.view().selection);
  viewer.Undo();
  EXPECT_NE(viewer.view().overlays.mesh_depth, 1);
  viewer.Undo();
  viewer.RunMenu("Viewing/Home");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(Difference(flat, viewer.Frame(96, 64, 0)), 0U);
  for (int i = 0; i < 4; ++i) viewer.RunMenu("Edit/Redo");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_NE(viewer.snapshot().light, light);
  EXPECT_EQ(Difference(last, viewer.Frame(96, 64, 0)), 0U);
  viewer.Redo();  // there is nothing more
  EXPECT_EQ(viewer.message(), "");
}

// Options of the solve come back with undo, and the solution is still theirs: nothing is computed anew.
TEST_F(SolvedViewer, UndoBringsOptionsOfTheSolveBack) {
  const std::string before = viewer.settings().Find("error")->get();
  const auto light = viewer.snapshot().light;
  viewer.Set("error", "0.3");
  viewer.Undo();
  EXPECT_EQ(viewer.settings().Find("error")->get(), before);
  viewer.RunMenu("Iteration/Iterate to convergence");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().light, light);
}

// A scene that was opened in place of a solved one gives it back.
TEST_F(SolvedViewer, UndoReopensTheSceneOfBefore) {
  const auto light = viewer.snapshot().light;
  viewer.Set("open", "furnace");
  ASSERT_TRUE(Settle(viewer));
  ASSERT_EQ(viewer.snapshot().scene->name, "furnace");
  viewer.Undo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().light, light);
  EXPECT_EQ(viewer.scene_name(), "shadow");
  viewer.Redo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().scene->name, "furnace");
}

// The window asks before unsaved work is lost, and only then.
TEST(ViewerEnds, AskFirstWhereWorkIsUnsaved) {
  ViewerOptions options = Options(false);
  options.files.save_solution = [](const std::string&, const Pipeline&) {};
  Viewer viewer(ShadowScene(), options);
  viewer.Set("ask-above", "0");
  viewer.RunMenu("File/Quit");  // nothing is solved
  EXPECT_TRUE(viewer.panels().quit);
  viewer.panels().quit = false;
  viewer.RunMenu("Iteration/Iterate to convergence");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_GT(viewer.status().unsaved_seconds, 0);
  viewer.RunMenu("File/Quit");
  EXPECT_FALSE(viewer.panels().quit);
  EXPECT_THAT(viewer.panels().question, HasSubstr("not saved"));
  viewer.panels().question.clear();
  viewer.Set("save-solution", "a.h5");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.status().unsaved_seconds, 0);
  viewer.Set("ask-above", "1e-9");
  viewer.RunMenu("File/Quit");
  EXPECT_TRUE(viewer.panels().quit);
  EXPECT_EQ(viewer.panels().question, "");
}

// Before any light is known, every face shows its reflectance, and what emits is white: no picture is black.
TEST(Viewer, ShowsReflectancesBeforeThereIsLight) {
  Viewer viewer(ShadowScene(), Options(false));
  const Srgb8Image& picture = viewer.Frame(96, 64, 0.01);
  ASSERT_TRUE(viewer.picture().previews());
  const ScreenPoint floor = PlaceOf(viewer, Vec3(-0.8, -0.7, 0));
  const std::size_t i = picture.Index(static_cast<int>(floor.x), static_cast<int>(floor.y));
  // The floor's reflectance is 0.5 in an even light of about 0.9.
  EXPECT_NEAR(viewer.picture().linear().channel[0][i], 0.5 * 0.91, 1e-6);
  EXPECT_GT(picture.pixels[3 * i], 150);
  EXPECT_EQ(viewer.picture().scale(), ColourScale::kNone);
  viewer.RunMenu("Iteration/Step");  // links, and no sweep yet
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(viewer.picture().previews());
  viewer.RunMenu("Iteration/Step");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_FALSE(viewer.picture().previews());
}

// Dimmed to a half, the floor shows half the light, at once and without a solve; undo gives it back.
TEST_F(SolvedViewer, LampsAreDimmedAndBroughtBack) {
  viewer.Set("auto-exposure", "off");
  const auto light = viewer.snapshot().light;
  const RgbImage before = viewer.picture().linear();
  const std::size_t iterations = viewer.snapshot().iterations.size();
  viewer.Set("dim", "object:all=0.5");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "");
  EXPECT_EQ(viewer.settings().Find("dim")->get(), "object:all=0.5");
  EXPECT_EQ(viewer.snapshot().iterations.size(), iterations);
  const RgbImage& dimmed = viewer.picture().linear();
  float worst = 0, largest = 0;
  for (std::size_t i = 0; i < before.PixelCount(); ++i) {
    worst = std::max(worst, std::abs(dimmed.channel[0][i] - 0.5F * before.channel[0][i]));
    largest = std::max(largest, before.channel[0][i]);
  }
  EXPECT_LT(worst, 0.05F * largest);
  viewer.Set("dim", "object:all=off");
  ASSERT_TRUE(Settle(viewer));
  for (const float value : viewer.picture().linear().channel[0]) ASSERT_LE(value, 1e-6F * largest);
  viewer.Undo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.settings().Find("dim")->get(), "object:all=0.5");
  viewer.Undo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().light, light);
  EXPECT_EQ(viewer.settings().Find("dim")->get(), "none");
  EXPECT_THROW(viewer.Set("dim", "nobody=1"), InputError);
  EXPECT_THROW(viewer.Set("paint", "nobody=1,1,1"), InputError);
  EXPECT_THROW(viewer.Set("paint", "grey=1"), InputError);  // a reflectance is below 1
}

// A floor that sees little but black keeps its irradiance whatever it reflects, and sends back what its new
// reflectance says.
TEST_F(SolvedViewer, PaintsAreLitOverTheKeptTransport) {
  const Rgb before = viewer.snapshot().light->solution().irradiance[0];
  viewer.Set("paint", "grey=0.2,0.4,0.9");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "");
  const RadiositySolution& solution = viewer.snapshot().light->solution();
  EXPECT_LT((solution.irradiance[0] - before).abs().maxCoeff(), 0.05 * before.maxCoeff());
  EXPECT_LT((solution.radiosity[0] - Rgb(0.2, 0.4, 0.9) * solution.irradiance[0]).abs().maxCoeff(),
            1e-9 * before.maxCoeff());
}

// The steps of the solver one by one, back and on, from a script's point of view.
TEST(Viewer, StepsGoBackAndOn) {
  Viewer viewer(ShadowScene(), Options(false));
  for (int i = 0; i < 5; ++i) {
    viewer.RunMenu("Iteration/Step");
    ASSERT_TRUE(Settle(viewer));
  }
  EXPECT_EQ(viewer.step(), 5U);
  const auto light = viewer.snapshot().light;
  viewer.RunMenu("Iteration/Step back");
  viewer.RunMenu("Iteration/Step back");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.step(), 3U);
  viewer.Set("step", "2");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.step(), 2U);
  viewer.Set("step", "5");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().light, light);
  EXPECT_THROW(viewer.Set("step", "99"), InputError);
  viewer.RunMenu("Iteration/Play");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(viewer.snapshot().complete);
  EXPECT_FALSE(viewer.playing());
  EXPECT_GT(viewer.steps()->size(), 6U);
}

// Light over a line: the exact values are those of probes, and the CSV holds them.
TEST_F(SolvedViewer, PlotsLightOverALineOfTwoClicks) {
  ASSERT_TRUE(Settle(viewer));
  const Vec3 a(-0.8, -0.7, 0), b(0.8, -0.7, 0);
  viewer.RunMenu("Visualisation/Plot over a line");
  for (const Vec3& end : {a, b}) {
    const ScreenPoint at = PlaceOf(viewer, end);
    Click(viewer, MouseButton::kLeft, at.x, at.y);
  }
  EXPECT_FALSE(viewer.view().selection);
  ASSERT_TRUE(Settle(viewer));
  const std::shared_ptr<const LinePlot> plot = viewer.line_plot();
  ASSERT_TRUE(plot);
  ASSERT_EQ(plot->samples.size(), static_cast<std::size_t>(kLineSamples));
  EXPECT_NEAR(plot->samples.back().distance, 1.6, 0.1);  // pixels are wide here
  const LightState& light = *viewer.snapshot().light;
  for (const std::size_t i : {std::size_t{20}, std::size_t{100}, std::size_t{180}}) {
    ReceiverPoint at;
    at.position = plot->samples[i].position;
    at.normal = Vec3::UnitZ();
    EXPECT_EQ(plot->samples[i].exact[0], light.Exact().OnPatch(0, at).irradiance[0]);
    ASSERT_TRUE(plot->samples[i].interpolated);
    EXPECT_NEAR((*plot->samples[i].interpolated)[0], plot->samples[i].exact[0],
                0.2 * plot->samples[i].exact[0]);
  }
  const std::string path = testing::TempDir() + "penumbra_line.csv";
  viewer.Set("save-line", path);
  std::ifstream file(path);
  std::string line;
  std::size_t rows = 0;
  while (std::getline(file, line)) ++rows;
  EXPECT_EQ(rows, 1U + kLineSamples);
  std::filesystem::remove(path);
  const std::string text = viewer.settings().Find("line")->get();
  viewer.Undo();
  EXPECT_EQ(viewer.settings().Find("line")->get(), "none");
  viewer.Set("line", text);
  EXPECT_EQ(viewer.settings().Find("line")->get(), text);
  EXPECT_THROW(viewer.Set("line", "0,0,7 1,0,7"), InputError);
}

// Parts are selected by name, hidden, shown and framed; a plain click selects and hides nothing.
TEST_F(SolvedViewer, PartsAreSelectedHiddenAndFramed) {
  const auto drawn = [&] {
    std::set<PatchId> patches;
    for (const std::uint32_t id : viewer.picture().frame()->triangle)
      if (id != kNoTriangle) patches.insert(viewer.picture().drawn().triangles[id].patch);
    return patches;
  };
  ASSERT_TRUE(Settle(viewer));
  const std::set<PatchId> all = drawn();
  const ScreenPoint at = PlaceOf(viewer, Vec3(-0.8, -0.7, 0));
  Click(viewer, MouseButton::kLeft, at.x, at.y);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(viewer.view().selection);
  EXPECT_EQ(drawn(), all);
  viewer.Set("select", "material:light");
  EXPECT_EQ(viewer.settings().Find("select")->get(), "material:light");
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("emittance")));
  viewer.Set("select", "object:all");
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("3 patches")));
  // All of it fits into the picture.
  viewer.RunMenu("Geometry/Frame");
  for (const Patch& patch : viewer.snapshot().scene->patches)
    for (const Vec3& v : patch.Vertices()) {
      const ScreenPoint place = PlaceOf(viewer, v);
      EXPECT_TRUE(place.x >= 0 && place.x <= 96 && place.y >= 0 && place.y <= 64)
          << place.x << " " << place.y;
    }
  viewer.RunMenu("Geometry/Hide");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(drawn().empty());
  viewer.Undo();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_FALSE(drawn().empty());
  viewer.Set("select", "face:0");
  EXPECT_EQ(viewer.view().selection.kind, SelectionKind::kElement);
  viewer.Set("isolate", "on");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(drawn(), std::set<PatchId>{0});
  for (const char* wrong : {"object:nobody", "face:99", "face:x", "all"})
    EXPECT_THROW(viewer.Set("select", wrong), InputError) << wrong;
}

// What was kept is on the left, and what is shown now on the right; a lamp at a half differs by a half.
TEST_F(SolvedViewer, ComparesWithWhatWasKept) {
  viewer.Set("auto-exposure", "off");
  ASSERT_TRUE(Settle(viewer));
  const Srgb8Image before = viewer.Frame(96, 64, 0);
  viewer.RunMenu("Visualisation/Keep for comparison");
  viewer.Set("dim", "object:all=0.5");
  ASSERT_TRUE(Settle(viewer));
  const Srgb8Image after = viewer.Frame(96, 64, 0);
  viewer.Set("compare", "on");
  viewer.Set("compare-at", "0.25");
  const Srgb8Image both = viewer.Frame(96, 64, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      if (x == 24) continue;  // the border
      const Srgb8Image& wanted = x < 24 ? before : after;
      ASSERT_EQ(both.pixels[3 * both.Index(x, y)], wanted.pixels[3 * wanted.Index(x, y)]) << x << " " << y;
    }
  EXPECT_THAT(viewer.Details(), testing::Contains(testing::StartsWith("differs by 0.")));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("differs by 0.5 (median)")));
  viewer.Set("compare", "off");
  EXPECT_EQ(Difference(after, viewer.Frame(96, 64, 0)), 0U);
}

// The line under the pointer tells what probes tell, of the mesh that is drawn.
TEST_F(SolvedViewer, TellsWhatIsUnderThePointer) {
  ASSERT_TRUE(Settle(viewer));
  const ScreenPoint at = PlaceOf(viewer, Vec3(-0.7, -0.6, 0));
  viewer.Handle(viewer_test::Button(InputEvent::Kind::kMove, MouseButton::kLeft, at.x, at.y));
  EXPECT_THAT(viewer.Hover(), testing::AllOf(HasSubstr("on patch 0 (all), grey, irradiance"),
                                             HasSubstr("W/m^2"), HasSubstr("triangle")));
  viewer.Set("unit", "lux");
  EXPECT_THAT(viewer.Hover(), HasSubstr(" lux"));
  viewer.Handle(viewer_test::Button(InputEvent::Kind::kMove, MouseButton::kLeft, 1, 1));
  EXPECT_EQ(viewer.Hover(), "");
}

// Pictures by rays come beside the view: interpolants found that way are those of the passes, and what is
// saved is what `render` draws.
TEST_F(SolvedViewer, RaysShowWhatThePassesShow) {
  const Srgb8Image passes = viewer.Frame(96, 64, 0);
  const RgbImage drawn = viewer.picture().linear();
  viewer.Set("mode", "lerp");
  ASSERT_TRUE(Settle(viewer));
  ASSERT_TRUE(viewer.picture().by_rays());
  const RgbImage& rays = viewer.picture().linear();
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.PixelCount(); ++i)
    different += std::abs(rays.channel[0][i] - drawn.channel[0][i]) > 1e-4F * drawn.channel[0][i] ? 1 : 0;
  EXPECT_LT(different, rays.PixelCount() / 50);  // edges
  viewer.Set("mode", "exact");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_GT(Difference(passes, viewer.Frame(96, 64, 0)), 0U);
  // Cancelled, it rests with what is there, until something else is to be seen.
  viewer.Set("eye", "0.3,-2.5,1.6");
  viewer.Frame(96, 64, 0);
  viewer.RunMenu("Iteration/Cancel");
  EXPECT_TRUE(Settle(viewer));
}

// Light from the vertices of leaves comes by rays, and each mode shows another light.
TEST_F(SolvedViewer, ReconstructionsDiffer) {
  std::vector<std::vector<float>> shown;
  for (const char* mode : {"nodal", "gouraud-screen", "bilinear", "bicubic"}) {
    viewer.Set("mode", mode);
    ASSERT_TRUE(Settle(viewer));
    ASSERT_TRUE(viewer.picture().by_rays()) << mode;
    shown.push_back(viewer.picture().linear().channel[0]);
    for (std::size_t i = 0; i + 1 < shown.size(); ++i) EXPECT_NE(shown[i], shown.back()) << mode;
  }
}

// Pictures that are saved are as large as the view, whatever they are averaged from.
TEST_F(SolvedViewer, SavesPicturesWithSupersampling) {
  const std::string folder = testing::TempDir();
  viewer.Set("element-mesh", "on");
  for (const char* mode : {"interpolant", "lerp", "gouraud-screen"})
    for (const char* samples : {"1", "3"}) {
      viewer.Set("mode", mode);
      viewer.Set("supersampling", samples);
      ASSERT_TRUE(Settle(viewer));
      for (const char* name : {"penumbra_saved.png", "penumbra_saved.exr"}) {
        viewer.Set("save-picture", folder + name);
        ASSERT_TRUE(Settle(viewer));
        EXPECT_EQ(viewer.message(), "");
      }
      const RgbImage saved = ReadExr(folder + "penumbra_saved.exr");
      EXPECT_EQ(saved.width, 96);
      EXPECT_EQ(saved.height, 64);
      EXPECT_TRUE(std::filesystem::remove(folder + "penumbra_saved.png"));
      EXPECT_TRUE(std::filesystem::remove(folder + "penumbra_saved.exr"));
    }
  EXPECT_THROW(viewer.Set("save-picture", "picture.gif"), InputError);
}

TEST_F(SolvedViewer, SelectsPatchesThenTheirChildren) {
  viewer.Set("mode", "flat");
  viewer.Set("isolate", "off");
  const Vec3 corner(-0.8, -0.7, 0);
  const ElementForest& forest = viewer.snapshot().light->solution().forest;
  for (int level = 0; level < 3; ++level) {
    ASSERT_TRUE(Settle(viewer));
    Click(viewer, MouseButton::kLeft, PlaceOf(viewer, corner).x, PlaceOf(viewer, corner).y);
    const Selection& selection = viewer.view().selection;
    ASSERT_EQ(selection.kind, SelectionKind::kElement);
    const auto id = static_cast<ElementId>(selection.index);
    EXPECT_EQ(forest[id].level, level);
    EXPECT_EQ(forest[id].patch, 0);
    EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("irradiance")));
    if (forest[id].IsLeaf()) break;
  }
  viewer.RunMenu("Geometry/Unselect all");
  EXPECT_FALSE(viewer.view().selection);
}

TEST_F(SolvedViewer, IsolatesWhatIsSelectedAndADoubleClickBesideItEndsThat) {
  viewer.Set("mode", "flat");
  viewer.Set("isolate", "on");
  ASSERT_TRUE(Settle(viewer));
  const Vec3 corner(-0.8, -0.7, 0);
  Click(viewer, MouseButton::kLeft, PlaceOf(viewer, corner).x, PlaceOf(viewer, corner).y);
  ASSERT_TRUE(Settle(viewer));
  const RenderedFrame& frame = *viewer.picture().frame();
  std::size_t shown = 0;
  for (const std::uint32_t id : frame.triangle) {
    if (id == kNoTriangle) continue;
    ++shown;
    ASSERT_EQ(viewer.picture().drawn().triangles[id].patch, 0);
  }
  EXPECT_GT(shown, 100U);
  viewer.Handle(viewer_test::Button(InputEvent::Kind::kMove, MouseButton::kLeft, 2, 2));
  Click(viewer, MouseButton::kLeft, 2, 2);
  EXPECT_TRUE(viewer.view().selection);
  Click(viewer, MouseButton::kLeft, 2, 2);
  EXPECT_FALSE(viewer.view().selection);
}

TEST_F(SolvedViewer, SelectsLinksTubesTrianglesAndDiscontinuities) {
  viewer.Set("mode", "flat");
  viewer.Set("isolate", "off");
  for (const char* links : {"visible-links", "split-links", "partial-links"}) viewer.Set(links, "on");
  viewer.Set("link-limit", "1");
  viewer.Set("hidden-lines", "on");
  ASSERT_TRUE(Settle(viewer));
  const RadiositySolution& solution = viewer.snapshot().light->solution();
  const auto strongest = std::max_element(
      solution.links.links.begin(), solution.links.links.end(), [&](const Link& a, const Link& b) {
        return a.form_factor * solution.radiosity[static_cast<std::size_t>(a.source)].maxCoeff() <
               b.form_factor * solution.radiosity[static_cast<std::size_t>(b.source)].maxCoeff();
      });
  const Vec3 middle = 0.5 * (Centroid(solution.forest[strongest->receiver].Vertices()) +
                             Centroid(solution.forest[strongest->source].Vertices()));
  Click(viewer, MouseButton::kLeft, PlaceOf(viewer, middle).x, PlaceOf(viewer, middle).y);
  EXPECT_EQ(viewer.view().selection.kind, SelectionKind::kLink);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("form factor")));
  Click(viewer, MouseButton::kLeft, PlaceOf(viewer, middle).x, PlaceOf(viewer, middle).y);
  EXPECT_EQ(viewer.view().selection.kind, SelectionKind::kTube);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("tube")));

  viewer.RunMenu("Geometry/Unselect all");
  for (const char* links : {"visible-links", "split-links", "partial-links"}) viewer.Set(links, "off");
  viewer.Set("triangles", "on");
  ASSERT_TRUE(Settle(viewer));
  const Vec3 corner(-0.8, -0.7, 0);
  Click(viewer, MouseButton::kLeft, PlaceOf(viewer, corner).x, PlaceOf(viewer, corner).y);
  EXPECT_EQ(viewer.view().selection.kind, SelectionKind::kTriangle);
  for (const char* graph :
       {"analytic-graph", "interpolated-graph", "error-graph", "sample-points", "isolate"})
    viewer.Set(graph, "on");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("discontinuity edges")));

  viewer.RunMenu("Geometry/Unselect all");
  viewer.Set("triangles", "off");
  viewer.Set("discontinuities", "on");
  viewer.Set("sample-points", "off");
  ASSERT_TRUE(Settle(viewer));
  // The shadow's lines run all over the floor's middle: a sweep of clicks meets one.
  for (double x = -0.9; x < 0.9 && viewer.view().selection.kind != SelectionKind::kDiscontinuity; x += 0.02) {
    viewer.RunMenu("Geometry/Unselect all");
    viewer.Frame(96, 64, 1);
    Click(viewer, MouseButton::kLeft, PlaceOf(viewer, Vec3(x, -0.5, 0)).x,
          PlaceOf(viewer, Vec3(x, -0.5, 0)).y);
  }
  ASSERT_EQ(viewer.view().selection.kind, SelectionKind::kDiscontinuity);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("blocker")));
}

// What is selected among many of its kind is alone in the picture, unless that is switched off.
TEST_F(SolvedViewer, IsolatesALinkFromTheOthers) {
  viewer.Set("mode", "flat");
  viewer.Set("isolate", "on");
  const auto links = [&](const char* value) {
    for (const char* kind : {"visible-links", "split-links", "partial-links"}) viewer.Set(kind, value);
  };
  links("on");
  viewer.Set("hidden-lines", "on");
  ASSERT_TRUE(Settle(viewer));
  const RadiositySolution& solution = viewer.snapshot().light->solution();
  ASSERT_GT(solution.links.links.size(), 10U);
  for (const Link& link : solution.links.links) {
    const Vec3 middle = 0.5 * (Centroid(solution.forest[link.receiver].Vertices()) +
                               Centroid(solution.forest[link.source].Vertices()));
    Click(viewer, MouseButton::kLeft, PlaceOf(viewer, middle).x, PlaceOf(viewer, middle).y);
    if (viewer.view().selection.kind == SelectionKind::kLink) break;
  }
  ASSERT_EQ(viewer.view().selection.kind, SelectionKind::kLink);
  const Srgb8Image alone = viewer.Frame(96, 64, 1);
  links("off");
  EXPECT_EQ(Difference(alone, viewer.Frame(96, 64, 1)), 0U);
  links("on");
  viewer.Set("isolate", "off");
  EXPECT_GT(Difference(alone, viewer.Frame(96, 64, 1)), 100U);
}

TEST_F(SolvedViewer, ProbesTellWhatTheyFind) {
  const ScreenPoint at = PlaceOf(viewer, Vec3(-0.7, -0.6, 0));
  Click(viewer, MouseButton::kRight, at.x, at.y);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("analytic")));
  Click(viewer, MouseButton::kRight, at.x, at.y, kShift);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_THAT(viewer.Details(),
              testing::Contains(HasSubstr("backprojection on 2 sources, 0 of them hidden")));
  viewer.RunMenu("Geometry/Unselect all");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(viewer.Details().empty());
}

// A discontinuity is called what it is, of whatever kind.
TEST_F(SolvedViewer, EveryKindOfDiscontinuityHasAName) {
  AnalysisResults results;
  auto list = std::make_shared<DiscontinuityList>();
  using enum DiscontinuityKind;
  for (const auto& [kind, name] :
       {std::pair(kVE, "VE"), std::pair(kEV, "EV"), std::pair(kHorizon, "horizon"),
        std::pair(kContact, "contact"), std::pair(kEEE, "EEE"), std::pair(kNear, "near")}) {
    Discontinuity d;
    d.kind = kind;
    d.receiver = 0;
    *list = {{d}, {{Vec3::Zero(), Vec3::UnitX()}}};
    results.discontinuities = list;
    const Selection selection{SelectionKind::kDiscontinuity, 0};
    const OverlayContext context{viewer.snapshot(), *viewer.snapshot().Mesh(MeshKind::kInterpolant),
                                 viewer.view().overlays, selection, results};
    EXPECT_EQ(DescribeSelection(context)[0], std::string("discontinuity 0: ") + name);
  }
}

// The discontinuities that are listed are those that the mesh was made of, by the options of the solve,
// whatever they weigh.
TEST(ViewerOptionsOfSolve, AreThoseOfListedDiscontinuities) {
  ViewerOptions options = Options(true);
  options.solving.triple_edge_tolerance = 0.01;
  options.solving.keep_hidden_discontinuities = true;
  options.solving.min_discontinuity_weight = 1e3;
  Viewer viewer(ShadowScene(), std::move(options));
  ASSERT_TRUE(Settle(viewer));
  const LightState& light = *viewer.snapshot().light;
  EXPECT_EQ(light.discontinuities().triple_edge_tolerance, 0.01);
  EXPECT_TRUE(light.discontinuities().keep_hidden);
  EXPECT_EQ(light.discontinuities().weight, DiscontinuityWeight::kThesis);
  ViewState view;
  view.overlays.shown.insert("discontinuities");
  Analyses analyses;
  std::shared_ptr<const DiscontinuityList> listed;
  for (int i = 0; i < 3000 && !listed; ++i) {
    listed = analyses.Update(viewer.snapshot(), nullptr, view).discontinuities;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(listed);
  DiscontinuityOptions expected = light.discontinuities();
  expected.min_weight = 0;
  const DiscontinuityList wanted = ListDiscontinuities(light.solution(), light.visibility(), expected, {});
  ASSERT_EQ(listed->all.size(), wanted.all.size());
  for (std::size_t i = 0; i < wanted.all.size(); ++i) EXPECT_EQ(listed->all[i].weight, wanted.all[i].weight);
}

// What is told of a place is of that place: a backprojection elsewhere ends a probe, and the other way round.
TEST_F(SolvedViewer, ProbesAreOfOnePlace) {
  const ScreenPoint a = PlaceOf(viewer, Vec3(-0.7, -0.6, 0)), b = PlaceOf(viewer, Vec3(-0.5, -0.7, 0));
  Click(viewer, MouseButton::kRight, a.x, a.y);
  Click(viewer, MouseButton::kRight, a.x, a.y, kShift);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_TRUE(viewer.view().probe.has_value());
  EXPECT_EQ(viewer.view().probe, viewer.view().backprojection);
  Click(viewer, MouseButton::kRight, b.x, b.y, kShift);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_FALSE(viewer.view().probe.has_value());
  EXPECT_THAT(viewer.Details(), testing::Not(testing::Contains(HasSubstr("analytic"))));
  EXPECT_THAT(viewer.Details(), testing::Contains(HasSubstr("at (-0.")));
  Click(viewer, MouseButton::kRight, a.x, a.y);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_FALSE(viewer.view().backprojection.has_value());
  EXPECT_THAT(viewer.Details(), testing::Not(testing::Contains(HasSubstr("backprojection"))));
}

TEST_F(SolvedViewer, KeysRunMenusAndFlyWhileWalking) {
  InputEvent key;
  key.kind = InputEvent::Kind::kKeyDown;
  key.key = "m";
  viewer.Handle(key);
  EXPECT_TRUE(viewer.view().overlays.Shows("element-mesh"));
  viewer.Set("navigation", "walk");
  viewer.Set("walk-speed", "3");
  const Camera before = viewer.view().camera;
  key.key = "w";
  viewer.Handle(key);
  viewer.Frame(96, 64, 0.1);
  viewer.Frame(96, 64, 0.1);
  key.kind = InputEvent::Kind::kKeyUp;
  viewer.Handle(key);
  viewer.Frame(96, 64, 0.1);
  EXPECT_NEAR((viewer.view().camera.eye - before.eye).norm(), 0.6, 1e-12);
}

TEST_F(SolvedViewer, CamerasAreSavedByName) {
  Drag(viewer, MouseButton::kMiddle, 20, 20, 60, 40);
  viewer.Set("save-camera", "mine");
  const Camera saved = viewer.view().camera;
  viewer.RunMenu("Viewing/Home");
  EXPECT_NE(viewer.view().camera.eye, saved.eye);
  viewer.RunMenu("Cameras/Go to/mine");
  EXPECT_EQ(viewer.view().camera.eye, saved.eye);
  viewer.Set("camera", "above");
  viewer.Set("camera", "mine");
  EXPECT_EQ(viewer.view().camera.eye, saved.eye);
  EXPECT_THROW(viewer.Set("camera", "nobody's"), InputError);
}

// Cameras that were named are there the next time, in their scene alone; a damaged line costs only its
// camera.
TEST(UserFiles, KeepCameras) {
  const std::filesystem::path state = std::filesystem::path(testing::TempDir()) / "penumbra_cameras_test";
  const char* before = std::getenv("XDG_STATE_HOME");
  const std::string old = before ? before : "";
  setenv("XDG_STATE_HOME", state.c_str(), 1);
  const Camera mine{"my view", {0.1, -1.0 / 3, 2}, {1e-17, 0, 0}, Vec3::UnitY(), 33};
  UserFiles().KeepCamera("office", mine);
  UserFiles().KeepCamera("cornell", {"other", {1, 2, 3}, Vec3::Zero(), Vec3::UnitZ(), 45});
  Camera again = mine;
  again.vertical_fov = 34;
  UserFiles().KeepCamera("office", again);
  std::ofstream(state / "penumbra" / "cameras", std::ios::app) << "office\tbroken\t1\t2\n";
  const std::vector<Camera> kept = UserFiles().Cameras("office");
  if (before)
    setenv("XDG_STATE_HOME", old.c_str(), 1);
  else
    unsetenv("XDG_STATE_HOME");
  std::filesystem::remove_all(state);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].name, "my view");
  EXPECT_EQ(kept[0].eye, mine.eye);
  EXPECT_EQ(kept[0].look_at, mine.look_at);
  EXPECT_EQ(kept[0].vertical_fov, 34);

  ViewerOptions options = Options(false);
  options.kept_cameras = [&](const std::string&) { return kept; };
  std::vector<std::string> named;
  options.keep_camera = [&](const std::string& scene, const Camera& camera) {
    named.push_back(scene + "/" + camera.name);
  };
  Viewer viewer(ShadowScene(), options);
  viewer.RunMenu("Cameras/Go to/my view");
  EXPECT_EQ(viewer.view().camera.eye, mine.eye);
  viewer.Set("save-camera", "new");
  EXPECT_EQ(named, std::vector<std::string>{"shadow/new"});
}

// Which panels are open is as it was the last time; what else stands in the file changes nothing.
TEST(UserFiles, KeepWhichPanelsAreOpen) {
  const std::filesystem::path state = std::filesystem::path(testing::TempDir()) / "penumbra_panels_test";
  const char* before = std::getenv("XDG_STATE_HOME");
  const std::string old = before ? before : "";
  setenv("XDG_STATE_HOME", state.c_str(), 1);
  Viewer first(ShadowScene(), Options(false)), then(ShadowScene(), Options(false));
  UserFiles().OpenPanels(&first);  // nothing is kept yet
  EXPECT_FALSE(first.panels().report);
  EXPECT_TRUE(first.panels().details);
  for (const char* name : {"report", "control-panel"}) first.Set(name, "on");
  first.Set("details", "off");
  UserFiles().KeepPanels(first);
  std::ofstream(state / "penumbra" / "panels", std::ios::app) << "mode flat\nno-such on\nhelp ?\nhelp";
  UserFiles().OpenPanels(&then);
  if (before)
    setenv("XDG_STATE_HOME", old.c_str(), 1);
  else
    unsetenv("XDG_STATE_HOME");
  std::filesystem::remove_all(state);
  EXPECT_TRUE(then.panels().report);
  EXPECT_TRUE(then.panels().control);
  EXPECT_FALSE(then.panels().details);
  EXPECT_FALSE(then.panels().parameters);
  EXPECT_FALSE(then.panels().help);
  EXPECT_EQ(then.view().mode, DrawMode::kInterpolant);
}

// Solutions and exports go to whoever writes them, once they are solved for.
TEST(Viewer, SavesAndExportsWhatIsSolved) {
  ViewerOptions options = Options(true);
  std::vector<std::string> written;
  options.files.save_solution = [&](const std::string& path, const Pipeline& pipeline) {
    EXPECT_EQ(pipeline.mesh_kind(), MeshKind::kInterpolant);
    EXPECT_GT(pipeline.report().interpolant_error.points, 0U);
    written.push_back(path);
  };
  options.files.exports_mesh = [](const std::string& path) {
    if (path.ends_with(".txt")) throw InputError("no such format");
    return path.ends_with(".ply");
  };
  options.files.export_file = [&](const std::string& path, const Scene& scene, const IrradianceMesh* mesh,
                                  const Camera&) {
    EXPECT_EQ(scene.patches.size(), 3U);
    EXPECT_EQ(mesh != nullptr, path.ends_with(".ply"));
    if (path == "fails.ply") throw InputError("the disk is full");
    written.push_back(path);
  };
  Viewer viewer(ShadowScene(), options);
  viewer.Set("mode", "flat");
  ASSERT_TRUE(Settle(viewer));
  viewer.Set("save-solution", "a.h5");
  viewer.Set("export", "a.ply");
  viewer.Set("export", "a.obj");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(written, (std::vector<std::string>{"a.h5", "a.ply", "a.obj"}));
  EXPECT_EQ(viewer.message(), "");
  EXPECT_THROW(viewer.Set("export", "a.txt"), InputError);
  viewer.Set("export", "fails.ply");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "the disk is full");
}

// The mouse turns a walking view wherever it goes, until Escape, or a dialog that needs it.
TEST(Viewer, TheMouseLooksAroundWhileItMay) {
  Viewer viewer(ShadowScene(), Options(false));
  const auto turns = [&](double x) {
    const Vec3 before = viewer.view().camera.look_at;
    viewer.Handle(viewer_test::Button(InputEvent::Kind::kMove, MouseButton::kLeft, x, 0));
    return viewer.view().camera.look_at != before;
  };
  viewer.Set("mouse-look", "on");
  EXPECT_FALSE(viewer.Looking());  // in an arcball
  viewer.Set("navigation", "walk");
  EXPECT_TRUE(viewer.Looking());
  EXPECT_TRUE(turns(1e5));
  viewer.RunMenu("File/Open...");
  EXPECT_FALSE(viewer.Looking());
  EXPECT_FALSE(turns(2e5));
  viewer.panels().dialog.clear();
  EXPECT_TRUE(viewer.Looking());
  InputEvent escape;
  escape.kind = InputEvent::Kind::kKeyDown;
  escape.key = "escape";
  viewer.Handle(escape);
  EXPECT_FALSE(viewer.Looking());
  EXPECT_FALSE(viewer.view().mouse_look);
}

// What went wrong last is what is told, whether here or in the solver; a scene that opens ends it.
TEST(Viewer, TellsTheNewestComplaint) {
  ViewerOptions options = Options(false);
  options.files.exports_mesh = [](const std::string&) { return false; };
  options.files.export_file = [](const std::string&, const Scene&, const IrradianceMesh*, const Camera&) {
    throw InputError("the disk is full");
  };
  Viewer viewer(ShadowScene(), options);
  for (int i = 0; i < 2; ++i) {
    viewer.Complain("first");
    EXPECT_EQ(viewer.message(), "first");
    viewer.Set("export", "a.obj");
    ASSERT_TRUE(Settle(viewer));
    EXPECT_EQ(viewer.message(), "the disk is full");
  }
  viewer.Complain("last");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "last");
  viewer.Set("export", "a.obj");
  ASSERT_TRUE(Settle(viewer));
  viewer.Dismiss();
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "");
  viewer.Complain("no such scene");
  viewer.Set("open", "floating-cube");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.message(), "");
}

TEST_F(SolvedViewer, ASceneThatFailsToLoadLeavesTheOldOne) {
  EXPECT_THROW(viewer.Set("open", "no/such/file.obj"), InputError);
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().scene->patches.size(), 3U);
  viewer.Set("open", "furnace");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.snapshot().scene->name, "furnace");
}

TEST(Viewer, EmptyScenesAreDark) {
  Viewer viewer(std::make_shared<const Scene>(), Options(true));
  EXPECT_TRUE(Settle(viewer));
  viewer.Set("element-mesh", "on");
  viewer.Set("discontinuities", "on");
  viewer.Set("triangles", "on");
  EXPECT_TRUE(Settle(viewer));
}

// Solving never holds up the view: while it works, frames come.
TEST(Viewer, DrawsWhileItSolvesAndIsCancelled) {
  ViewerOptions options = Options(true);
  options.solving.error = 0.005;
  Viewer viewer(ShadowScene(), options);
  int frames = 0;
  while (viewer.status().busy && frames < 20) {
    viewer.Frame(32, 24, 0.01);
    ++frames;
  }
  viewer.RunMenu("Iteration/Cancel");
  EXPECT_TRUE(Settle(viewer));
  EXPECT_GT(frames, 0);
}

// A stage without a window.
class Headless final : public ScriptStage {
 public:
  explicit Headless(Viewer& viewer) : viewer_(viewer) {}
  void Input(const InputEvent& event) override { viewer_.Handle(event); }
  void Resize(int w, int h) override {
    width = w;
    height = h;
  }
  void Screenshot(const std::string& path) override { screenshots.push_back(path); }
  int width = 96, height = 64;
  std::vector<std::string> screenshots;

 private:
  Viewer& viewer_;
};

TEST(Script, PlaysItsActionsInOrder) {
  Viewer viewer(ShadowScene(), Options(false));
  Headless stage(viewer);
  ScriptPlayer player(ParseScript("s", R"(# a comment
set mode flat
menu Iteration/Iterate to convergence
wait idle
key m
mouse drag middle 10 10 30 20
mouse click left 5 5
mouse scroll 1
resize 40x30
wait frames 2
screenshot a.png
quit
set mode nonsense
)"));
  int frames = 0;
  while (player.Advance(viewer, stage, 0.01) && frames < 100000) {
    viewer.Frame(stage.width, stage.height, 0.01);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    ++frames;
  }
  EXPECT_TRUE(viewer.snapshot().converged);
  EXPECT_TRUE(viewer.view().overlays.Shows("element-mesh"));
  EXPECT_EQ(viewer.view().mode, DrawMode::kFlat);
  EXPECT_EQ(stage.width, 40);
  EXPECT_THAT(stage.screenshots, testing::ElementsAre("a.png"));
}

std::string ErrorOf(const std::string& text) {
  try {
    const Script script = ParseScript("f", text);
    Viewer viewer(ShadowScene(), Options(false));
    Headless stage(viewer);
    ScriptPlayer player(script);
    for (int i = 0; i < 100 && player.Advance(viewer, stage, 0.01); ++i) viewer.Frame(8, 8, 0.01);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Script, TellsWhatIsWrongAndWhere) {
  EXPECT_THAT(ErrorOf("\nfly away\n"), testing::StartsWith("f:2: error: 'fly' is none of"));
  EXPECT_THAT(ErrorOf("key nonsense"), testing::StartsWith("f:1: error: 'nonsense' is no key"));
  EXPECT_THAT(ErrorOf("mouse move 1"), testing::StartsWith("f:1: error: y is missing"));
  EXPECT_THAT(ErrorOf("mouse press thumb"), HasSubstr("none of left, middle, right"));
  EXPECT_THAT(ErrorOf("wait forever"), HasSubstr("none of idle, frames, seconds"));
  EXPECT_THAT(ErrorOf("wait frames -1"), HasSubstr("below 0"));
  EXPECT_THAT(ErrorOf("resize 0x5"), HasSubstr("not WIDTHxHEIGHT"));
  EXPECT_THAT(ErrorOf("screenshot a.jpg"), HasSubstr("does not end in .png"));
  EXPECT_THAT(ErrorOf("quit now"), HasSubstr("'now' is too much"));
  EXPECT_THAT(ErrorOf("wait frames 1\nset mode nonsense"),
              testing::StartsWith("f:2: error: mode: 'nonsense'"));
  EXPECT_THAT(ErrorOf("set sillyness 3"), testing::StartsWith("f:1: error: there is no option 'sillyness'"));
  EXPECT_THAT(ErrorOf("menu Nowhere"), testing::StartsWith("f:1: error: there is no menu item 'Nowhere'"));
  EXPECT_EQ(ErrorOf("# only a comment\n\n"), "");
}

}  // namespace
}  // namespace penumbra::viewer
