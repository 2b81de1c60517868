// Crosses at the centroids of triangles.

#include <gtest/gtest.h>

#include "display/viewer/overlays.h"
#include "display/viewer/viewer.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

TEST(CentroidOverlay, HasThreeArmsForATriangle) {
  const Viewer viewer(viewer_test::ShadowScene(), viewer_test::Options(false));
  IrradianceMesh triangle;
  triangle.positions = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
  triangle.triangles.push_back({{0, 1, 2}, 0, {}});
  triangle.irradiance.emplace_back();
  OverlaySettings settings;
  const Selection selection;
  const AnalysisResults results;
  const MeshState mesh(viewer.snapshot().scene, std::move(triangle));
  const OverlayContext context{viewer.snapshot(), mesh, settings, selection, results};
  EXPECT_TRUE(DrawOverlays(context).lines.empty());
  settings.shown.insert("centroids");
  EXPECT_TRUE(NeedsOf(settings).triangles);
  EXPECT_EQ(DrawOverlays(context).lines.size(), 3U);
}

}  // namespace
}  // namespace penumbra::viewer
