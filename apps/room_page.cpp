#include "apps/room_page.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "apps/grid_statistics.h"
#include "apps/version.h"
#include "display/markup.h"
#include "solver/scene/emitters.h"

namespace penumbra {
namespace {

constexpr std::string_view kStyle =
    "body{font:14px/1.4 sans-serif;max-width:52em;margin:2em auto;color:#222}"
    "table{border-collapse:collapse;margin:.5em 0 1.5em}"
    "th,td{padding:.15em .9em .15em 0;text-align:right;border-bottom:1px solid #ddd}"
    "th:first-child,td:first-child{text-align:left}svg{max-width:100%;height:auto}"
    "@media print{body{margin:0}}";

// Four digits or more, without an exponent below a million.
std::string NumberText(double value) {
  return fmt::format(fmt::runtime(value >= 1e3 && value < 1e6 ? "{:.0f}" : "{:.4g}"), value);
}

// A colour, or what the eye sees of it.
std::string ValueText(const Rgb& value, LightUnit unit, double lux_scale) {
  if (unit == LightUnit::kLux) return NumberText(lux_scale * Lux(value));
  return fmt::format("{}, {}, {}", NumberText(value[0]), NumberText(value[1]), NumberText(value[2]));
}

class RoomDocument {
 public:
  explicit RoomDocument(const RoomPage& page) : page_(page) {}

  std::string Html() {
    Add("<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
        "charset=\"utf-8\"><title>{0}</title><style>{1}</style></head>"
        "<body>\n<h1>{0}</h1>\n",
        EscapeMarkup(page_.title), kStyle);
    AddStatistics();
    Add("{}\n", page_.map);
    AddError();
    AddLuminaires();
    AddMaterials();
    Add("<p>Computed by {}.</p>\n</body></html>\n", EscapeMarkup(VersionLine()));
    return fmt::to_string(html_);
  }

 private:
  template <class... Args>
  void Add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(html_), format, std::forward<Args>(args)...);
  }
  bool InLux() const { return page_.unit == LightUnit::kLux; }
  double AreaOf(const std::vector<PatchId>& patches) const {
    double area = 0;
    for (const PatchId patch : patches) area += page_.scene.patches[patch].area;
    return area;
  }

  void AddStatistics() {
    Add("<table><tr><th>{} points</th>", page_.light.size());
    for (const char* column : {"mean", "minimum", "maximum", "U<sub>0</sub>", "U<sub>d</sub>"})
      Add("<th>{}</th>", column);
    Add("</tr>\n");
    const std::vector<std::vector<double>> columns = LightColumns(page_.light, page_.unit);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const GridStatistics all = StatisticsOf(columns[i]);
      constexpr const char* kChannels[] = {"red", "green", "blue"};
      Add("<tr><td>{} "
          "[{}]</td><td>{:.4g}</td><td>{:.4g}</td><td>{:.4g}</td><td>{:.3f}</td><td>{:.3f}</td></tr>\n",
          InLux() ? "illuminance" : kChannels[i], InLux() ? "lux" : "W/m\u00b2", all.mean, all.minimum,
          all.maximum, all.overall_uniformity, all.diversity_uniformity);
    }
    Add("</table>\n<p>U<sub>0</sub> = minimum / mean, U<sub>d</sub> = minimum / maximum.");
    if (page_.left_out > 0) Add(" {} points inside solids or behind faces are left out.", page_.left_out);
    Add("</p>\n");
  }

  void AddError() {
    const PipelineReport& report = page_.report;
    Add("<h2>Accuracy</h2>\n<p>Relative error asked for: {:.3g} at 99 of 100 places.", report.error_asked);
    if (report.whole_error.points > 0)
      Add(" Measured: {:.2g} ({}).", report.whole_error.p99, report.error_met ? "met" : "not met");
    for (const std::string& line : report.unmet) Add("<br>{}", EscapeMarkup(line));
    Add("</p>\n");
  }

  void AddLuminaires() {
    Add("<h2>Luminaires</h2>\n<table><tr><th>object</th><th>area [m\u00b2]</th><th>flux [{}]</th></tr>\n",
        InLux() ? "lm" : "W: red, green, blue");
    Rgb sum = Rgb::Zero();
    const Scene& scene = page_.scene;
    for (const std::vector<PatchId>& patches : EmittersOf(scene, EmitterUnit::kObject)) {
      Rgb flux = Rgb::Zero();
      for (const PatchId patch : patches)
        flux += scene.patches[patch].area * scene.MaterialOf(patch).emittance;
      sum += flux;
      const Face& face = scene.faces[static_cast<std::size_t>(scene.patches[patches.front()].faces.front())];
      Add("<tr><td>{}</td><td>{:.4g}</td><td>{}</td></tr>\n",
          EscapeMarkup(scene.objects[static_cast<std::size_t>(face.object)].name), AreaOf(patches),
          ValueText(flux, page_.unit, 1));
    }
    Add("<tr><td>all</td><td></td><td>{}</td></tr>\n</table>\n", ValueText(sum, page_.unit, 1));
  }

  void AddMaterials() {
    Add("<h2>Materials</h2>\n<table><tr><th>material</th><th>area "
        "[m\u00b2]</th><th>reflectance{}</th></tr>\n",
        InLux() ? "" : ": red, green, blue");
    const Scene& scene = page_.scene;
    std::vector<double> area(scene.materials.size(), 0.0);
    for (const Patch& patch : scene.patches) area[static_cast<std::size_t>(patch.material)] += patch.area;
    for (std::size_t i = 0; i < area.size(); ++i)
      if (area[i] > 0)
        Add("<tr><td>{}</td><td>{:.4g}</td><td>{}</td></tr>\n", EscapeMarkup(scene.materials[i].name),
            area[i], ValueText(scene.materials[i].reflectance, page_.unit, 1 / kLuminousEfficacy));
    Add("</table>\n");
  }

  const RoomPage& page_;
  fmt::memory_buffer html_;
};

}  // namespace

std::string RoomPageHtml(const RoomPage& page) { return RoomDocument(page).Html(); }

}  // namespace penumbra
