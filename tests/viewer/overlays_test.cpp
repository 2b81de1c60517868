// Overlays as the window knows them: by name, key and menu item.

#include "display/viewer/overlays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "display/viewer/viewer.h"
#include "solver/base/check.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

using viewer_test::Options;
using viewer_test::ShadowScene;

// A white line through the scene.
class RulerOverlay final : public Overlay {
 public:
  std::vector<OverlaySwitch> Switches() const override { return {{"ruler", "Ruler", "Ruler", "f9", {}}}; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    if (context.settings.Shows("ruler")) drawing->Line(Vec3::Zero(), Vec3::Ones(), colour::kWhite);
  }
};

void AddRuler() {
  static const bool added = [] {
    Overlays().Add(
        {"ruler", "a line through the scene", {}, [] { return std::make_unique<const RulerOverlay>(); }});
    return true;
  }();
  EXPECT_TRUE(added);
}

// Overlays are listed by name with a line of help; a name that nobody has is refused.
TEST(Overlays, AreListed) {
  AddRuler();
  const std::vector<std::string> names = Overlays().Names();
  for (const char* name : {"element-mesh", "links", "discontinuities", "triangulation", "sample-points",
                           "graphs", "backprojection", "probe", "line", "selection", "ruler"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  for (const OverlayRegistry::Method& method : Overlays().methods()) EXPECT_FALSE(method.help.empty());
  EXPECT_THROW(Overlays().Find("guess"), InputError);
}

// Every switch has a setting, off at first, and an item of the menu with its key; no key does two things;
// what an overlay alone obeys can be set.
TEST(Overlays, StandInSettingsAndMenus) {
  AddRuler();
  const Viewer viewer(ShadowScene(), Options(false));
  std::set<std::string> keys;
  for (const MenuItem& item : viewer.menu().items())
    EXPECT_TRUE(item.key.empty() || keys.insert(item.key).second) << item.key;
  std::size_t count = 0;
  for (const auto& overlay : MakeOverlays()) {
    EXPECT_NE(std::find(std::begin(kOverlayGroups), std::end(kOverlayGroups), overlay->Group()),
              std::end(kOverlayGroups));
    for (const OverlaySwitch& part : overlay->Switches()) {
      const Setting* setting = viewer.settings().Find(part.name);
      ASSERT_NE(setting, nullptr) << part.name;
      EXPECT_EQ(setting->get(), "off");
      EXPECT_EQ(setting->group, overlay->Group());
      const MenuItem* item = viewer.menu().Find("Visualisation/" + part.menu);
      ASSERT_NE(item, nullptr) << part.menu;
      EXPECT_EQ(item->key, part.key);
      ++count;
    }
  }
  EXPECT_GE(count, 11U);
  for (const OverlayRegistry::Method& method : Overlays().methods())
    for (const std::string& name : method.parameters)
      EXPECT_NE(viewer.settings().Find(name), nullptr) << name;
}

// A registered overlay is switched by its setting, its menu item and its key, and drawn then only.
TEST(Overlays, AddedOnesAreSwitchedAndDrawn) {
  AddRuler();
  Viewer viewer(ShadowScene(), Options(false));
  const auto marked = [&] { return viewer.menu().Find("Visualisation/Ruler")->checked(); };
  EXPECT_FALSE(marked());
  viewer.Set("ruler", "on");
  EXPECT_TRUE(marked());
  viewer.RunMenu("Visualisation/Ruler");
  EXPECT_FALSE(marked());
  InputEvent key;
  key.kind = InputEvent::Kind::kKeyDown;
  key.key = "f9";
  viewer.Handle(key);
  EXPECT_TRUE(viewer.view().overlays.Shows("ruler"));

  OverlaySettings settings;
  const Selection selection;
  const AnalysisResults results;
  const MeshState mesh(viewer.snapshot().scene, IrradianceMesh());
  const OverlayContext context{viewer.snapshot(), mesh, settings, selection, results};
  EXPECT_TRUE(DrawOverlays(context).lines.empty());
  settings.shown.insert("ruler");
  EXPECT_EQ(DrawOverlays(context).lines.size(), 1U);
  EXPECT_FALSE(NeedsOf(settings).triangles);
  settings.shown.insert("error-graph");
  EXPECT_TRUE(NeedsOf(settings).triangles && NeedsOf(settings).exact_graph);
}

}  // namespace
}  // namespace penumbra::viewer
