#include "display/viewer/graph_overlay.h"

#include "display/viewer/menu.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/settings.h"

namespace penumbra::viewer {
namespace {

constexpr const char *kAnalytic = "analytic-graph", *kInterpolated = "interpolated-graph",
                     *kError = "error-graph", *kDynamicGridHelp = "Dynamic grid density";

class GraphOverlay final : public Overlay {
 public:
  std::string Group() const override { return "Graphs"; }
  std::vector<OverlaySwitch> Switches() const override {
    const OverlayNeeds shown{.triangles = true, .graph = true},
        exact{.triangles = true, .graph = true, .exact_graph = true};
    return {{kAnalytic, "Analytic irradiance", "Analytic irradiance", "g", exact},
            {kInterpolated, "Interpolated irradiance", "Interpolated irradiance", "b", shown},
            {kError, "Error surface", "Error surface", "j", exact}};
  }
  void AddSettings(OverlaySettings* values, Settings* settings) const override {
    settings->Number("graph-scale", Group(), "Graph height scale [m per W/m^2]", &values->graph_scale,
                     {1e-9, 1e6, true});
    settings->Integer("grid-density", Group(), "Grid density", &values->grid_density, 1, 200);
    settings->Toggle("dynamic-grid", Group(), kDynamicGridHelp, &values->dynamic_grid);
  }
  void AddMenuItems(OverlaySettings* values, Menu* menu) const override {
    bool& dynamic = values->dynamic_grid;
    menu->Add({"Visualisation/Dynamic grid density", "", kDynamicGridHelp, [&dynamic] { dynamic = !dynamic; },
               [&dynamic] { return dynamic; }});
  }
  int Layer() const override { return 5; }
  void Draw(const OverlayContext& context, OverlayDrawing* drawing) const override {
    const OverlaySettings& settings = context.settings;
    if (!context.results.graph) return;
    for (const GraphSheet& sheet : *context.results.graph) {
      const auto shown = [&](std::size_t, double s, double t) {
        return context.mesh.mesh().irradiance[sheet.triangle].At(s, t).max(0.0).mean();
      };
      const auto exact = [&](std::size_t k, double, double) { return sheet.exact[k].mean(); };
      if (settings.Shows(kInterpolated)) DrawSheet(context, sheet, shown, colour::kBlue, drawing);
      if (sheet.exact.empty()) continue;
      if (settings.Shows(kAnalytic)) DrawSheet(context, sheet, exact, colour::kWhite, drawing);
      if (settings.Shows(kError))
        DrawSheet(
            context, sheet,
            [&](std::size_t k, double s, double t) { return shown(k, s, t) - exact(k, s, t); }, colour::kRed,
            drawing);
    }
  }

 private:
  // The sheet as the lines of its grid, `height(k, s, t)` above each node [W/m^2].
  template <class Height>
  static void DrawSheet(const OverlayContext& context, const GraphSheet& sheet, const Height& height,
                        Colour shown, OverlayDrawing* drawing) {
    const Vec3 up =
        context.settings.graph_scale * NormalOf(*context.snapshot.scene, context.mesh.mesh(), sheet.triangle);
    const int n = sheet.cells;
    std::vector<Vec3> node;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n - j; ++i) {
        const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
        node.push_back(PointInTriangle(context.mesh.mesh(), sheet.triangle, s, t) +
                       height(node.size(), s, t) * up);
      }
    std::size_t k = 0;
    for (int j = 0; j < n; ++j) {
      const auto row = static_cast<std::size_t>(n - j + 1);
      for (int i = 0; i < n - j; ++i, ++k) {
        drawing->Line(node[k], node[k + 1], shown, 1.0F);
        drawing->Line(node[k], node[k + row], shown, 1.0F);
        drawing->Line(node[k + 1], node[k + row], shown, 1.0F);
      }
      ++k;
    }
  }
};

}  // namespace

OverlayRegistry::Method GraphOverlayMethod() {
  return {"graphs",
          "graphs of the irradiance over what is selected",
          {"graph-scale", "grid-density", "dynamic-grid"},
          [] { return std::make_unique<const GraphOverlay>(); }};
}

}  // namespace penumbra::viewer
