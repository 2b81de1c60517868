// What the picture shows is what its state says: selections, maps and scales; what is cancelled, and what
// there is no memory for.

#include "display/viewer/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <vector>

#include "display/viewer/deferred.h"
#include "display/viewer/selection.h"
#include "solver/base/parallel.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

using testing::Contains;
using testing::HasSubstr;
using viewer_test::Click;
using viewer_test::Options;
using viewer_test::PlaceOf;
using viewer_test::Settle;
using viewer_test::ShadowScene;

class PictureOfAViewer : public testing::Test {
 protected:
  PictureOfAViewer() : viewer(ShadowScene(), Options(true)) { EXPECT_TRUE(Settle(viewer)); }

  void SelectFloor() {
    viewer.Set("isolate", "on");
    const ScreenPoint at = PlaceOf(viewer, Vec3(-0.4, -0.3, 0));
    Click(viewer, MouseButton::kLeft, at.x, at.y);
    ASSERT_TRUE(Settle(viewer));
    ASSERT_EQ(viewer.view().selection.kind, SelectionKind::kElement);
  }

  Viewer viewer;
};

// The colours of the map are those of the triangles, whether others are drawn or not.
TEST_F(PictureOfAViewer, MapsTheErrorsOfWhatIsSelected) {
  viewer.Set("error-map", "on");
  ASSERT_TRUE(Settle(viewer));
  ASSERT_EQ(viewer.picture().scale(), ColourScale::kError);
  const Srgb8Image whole = viewer.picture().screen();
  const std::vector<std::uint32_t> triangle = viewer.picture().frame()->triangle;
  const IrradianceMesh mesh = viewer.picture().drawn();
  SelectFloor();
  EXPECT_EQ(viewer.picture().scale(), ColourScale::kError);
  ASSERT_LT(viewer.picture().drawn().triangles.size(), mesh.triangles.size());
  std::size_t floor = 0, same = 0;
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    if (triangle[i] == kNoTriangle || mesh.triangles[triangle[i]].patch != 0) continue;
    ++floor;
    same += std::equal(whole.pixels.data() + 3 * i, whole.pixels.data() + 3 * i + 3,
                       viewer.picture().screen().pixels.data() + 3 * i)
                ? 1
                : 0;
  }
  // But for the outline of the selection.
  EXPECT_GT(floor, 200U);
  EXPECT_GT(same, floor - floor / 4);
}

// Rays meet the whole scene, so it is drawn whole.
TEST_F(PictureOfAViewer, IsByRaysWhateverIsSelected) {
  for (const char* mode : {"exact", "lerp"}) {
    viewer.RunMenu("Geometry/Unselect all");
    viewer.Set("mode", mode);
    ASSERT_TRUE(Settle(viewer));
    ASSERT_TRUE(viewer.picture().by_rays());
    const RgbImage before = viewer.picture().linear();
    SelectFloor();
    EXPECT_TRUE(viewer.picture().by_rays()) << mode;
    EXPECT_EQ(viewer.picture().linear().channel, before.channel) << mode;
  }
}

TEST_F(PictureOfAViewer, HasAScaleWhereItsColoursAreFalse) {
  viewer.Set("false-colour", "on");
  for (const auto& [mode, scale] :
       {std::pair("interpolant", ColourScale::kIrradiance), std::pair("rho", ColourScale::kNone),
        std::pair("flat", ColourScale::kIrradiance)}) {
    viewer.Set("mode", mode);
    ASSERT_TRUE(Settle(viewer));
    EXPECT_EQ(viewer.picture().scale(), scale) << mode;
  }
  viewer.Set("trees-by-reflectance", "on");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.picture().scale(), ColourScale::kNone);
}

// Solved, and cancelled while the first mesh was under way.
class CancelledMesh : public testing::Test {
 protected:
  CancelledMesh() : viewer(ShadowScene(), Slow()) {
    viewer.Set("mode", "flat");
    viewer.RunMenu("Iteration/Iterate to convergence");
    EXPECT_TRUE(Settle(viewer));
    viewer.Set("mode", "interpolant");
    viewer.Frame(96, 64, 0.02);
    viewer.RunMenu("Iteration/Cancel");
    EXPECT_TRUE(Settle(viewer));
  }

  static ViewerOptions Slow() {
    ViewerOptions options = Options(false);
    options.solving.error = 0.02;
    return options;
  }

  Viewer viewer;
};

// It is not begun again by itself; the meshes of other modes are.
TEST_F(CancelledMesh, LeavesTheOtherModesTheirs) {
  // Where a mesh came on the way to the last before it was cancelled, it stays.
  const bool leaves = viewer.picture().drawn_kind() == MeshKind::kFlat;
  EXPECT_THAT(viewer.activity(), HasSubstr(leaves ? "no mesh was made" : "not refined to its end"));
  viewer.Set("mode", "gouraud");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.picture().drawn_kind(), MeshKind::kGouraud);
  EXPECT_EQ(viewer.activity(), "ready");
}

TEST_F(CancelledMesh, IsMadeOnceItIsAskedToConvergeAgain) {
  viewer.RunMenu("Iteration/Iterate to convergence");
  ASSERT_TRUE(Settle(viewer));
  EXPECT_EQ(viewer.picture().drawn_kind(), MeshKind::kInterpolant);
}

// Faces are told as users count them: their own number on one that was merged, once where one was cut.
TEST(Probe, TellsFacesAndEverySource) {
  Scene scene = mesh_test::EmptyScene();
  constexpr std::int32_t kSquares = 16;
  for (std::int32_t k = 0; k < kSquares; ++k) {
    mesh_test::AddSquare(scene, {0, 0, static_cast<double>(k)}, 1, true);
    scene.patches.back().faces = {k};
  }
  scene.patches[0].faces = {20, 21};
  scene.patches[2].faces = {1};  // another part of face 1
  ProbeResult probe;
  probe.at.patch = 0;
  probe.face = 21;
  std::vector<PatchContribution> sources;
  for (std::int32_t k = 1; k < kSquares; ++k) sources.push_back({k, Rgb::Constant(k == 2 ? 20 : k)});
  probe.sources = JoinFaces(scene, sources);
  const std::vector<std::string> lines = DescribeProbe(probe, scene);
  EXPECT_THAT(lines, Contains(HasSubstr("on patch 21 (")));
  EXPECT_THAT(lines, Contains("from 14 sources:"));
  EXPECT_THAT(lines, Contains(testing::AllOf(HasSubstr("  1 ("), HasSubstr("21 21 21"))));
  EXPECT_THAT(lines, Contains("  2 others: 7 7 7"));
}

TEST(Picture, OptionsOfASolveAreSettings) {
  Viewer viewer(ShadowScene(), Options(false));
  viewer.Set("eee", "0.01");
  viewer.Set("source-error", "0.02");
  viewer.Set("seed", "18446744073709551615");
  EXPECT_EQ(viewer.solving().triple_edge_tolerance, 0.01);
  EXPECT_EQ(viewer.solving().source_error, 0.02);
  EXPECT_EQ(viewer.solving().seed, 18446744073709551615U);
  viewer.Set("source-error", "none");
  EXPECT_FALSE(viewer.solving().source_error);
  EXPECT_THROW(viewer.Set("seed", "-1"), InputError);
  EXPECT_THROW(viewer.Set("divisions", "128"), InputError);
}

// The number of threads holds from the next loop on, of a solver that is under way too: nothing starts over,
// and the light is the same to the bit.
TEST(Picture, TheNumberOfThreadsChangesNoResult) {
  const int before = ThreadCount();
  std::vector<std::vector<Rgb>> light;
  for (const bool changes : {false, true}) {
    Viewer viewer(ShadowScene(), Options(true));
    for (int i = 0; changes && i < 200 && !viewer.Idle(); ++i) {
      viewer.Set("threads", i % 2 == 0 ? "1" : "3");
      EXPECT_EQ(ThreadCount(), i % 2 == 0 ? 1 : 3);
      viewer.Frame(32, 24, 0.02);
    }
    ASSERT_TRUE(Settle(viewer));
    const auto solved = viewer.snapshot().light;
    viewer.Set("threads", "2");
    EXPECT_EQ(viewer.settings().Find("threads")->get(), "2");
    viewer.RunMenu("Iteration/Iterate to convergence");
    ASSERT_TRUE(Settle(viewer));
    EXPECT_EQ(viewer.snapshot().light, solved);
    light.push_back(solved->solution().irradiance);
  }
  SetThreadCount(before);
  ASSERT_EQ(light[0].size(), light[1].size());
  for (std::size_t i = 0; i < light[0].size(); ++i) EXPECT_TRUE((light[0][i] == light[1][i]).all()) << i;
  Viewer viewer(ShadowScene(), Options(false));
  EXPECT_THROW(viewer.Set("threads", "1025"), InputError);
  EXPECT_THROW(viewer.Set("threads", "-1"), InputError);
  EXPECT_EQ(ThreadCount(), before);
}

TEST(Deferred, WhatThereIsNoMemoryForHasNoValue) {
  int begun = 0;
  Deferred<int, int> values([&](const int& key, const ExecutionContext&) {
    ++begun;
    if (key == 1) throw std::bad_alloc();
    return key;
  });
  const auto get = [&](int key) {
    std::shared_ptr<const int> value = values.Get(key);
    while (values.Busy()) std::this_thread::yield();
    return values.Get(key);
  };
  EXPECT_FALSE(get(1));
  EXPECT_TRUE(values.RanOutOfMemory());
  EXPECT_FALSE(values.RanOutOfMemory());
  EXPECT_FALSE(get(1));
  EXPECT_EQ(begun, 1);
  ASSERT_TRUE(get(2));
  EXPECT_EQ(*get(2), 2);
}

// The end of the scale is a round number above what nearly all pixels show, whatever a few bright ones do;
// and a value has the place on a scale at which the scale has the value.
TEST(FalseColourScale, KeepsOutliersOutAndInvertsItself) {
  RgbImage image(200, 100);
  std::vector<PixelKind> kinds(image.PixelCount(), PixelKind::kSurface);
  for (std::size_t i = 0; i < image.PixelCount(); ++i)
    for (auto& channel : image.channel) channel[i] = i % 500 == 0 ? 1e6F : 3.7F;
  EXPECT_EQ(RangeOf(image, kinds, LightUnit::kWatts), 4);
  EXPECT_EQ(RangeOf(image, kinds, LightUnit::kLux), 800);  // 179 lm/W x 3.7 W/m^2 = 662 lux
  std::fill(kinds.begin(), kinds.end(), PixelKind::kEmitter);
  EXPECT_EQ(RangeOf(image, kinds, LightUnit::kWatts), 1);
  for (const bool logarithmic : {false, true}) {
    const FalseColourScale scale{50, LightUnit::kWatts, logarithmic};
    for (const double place : {0.0, 0.25, 0.5, 1.0})
      EXPECT_NEAR(scale.Place(scale.ValueAt(place)), place, 1e-12);
    EXPECT_DOUBLE_EQ(scale.ValueAt(1), 50);
  }
}

}  // namespace
}  // namespace penumbra::viewer
