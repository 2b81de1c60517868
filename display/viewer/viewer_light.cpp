// Lamps that are dimmed and materials that are painted.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "display/viewer/viewer.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

void CheckNames(const Scene& scene, const LightChange& change) {
  static_cast<void>(DimmingFactors(scene, change.lamps));
  for (const Paint& paint : change.paints)
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& material) { return material.name == paint.material; }))
      throw InputError(fmt::format("the scene has no material '{}'", paint.material));
}

// The name by which panels list a lamp that is named without `object:` or `material:`; other names stay.
std::string LampName(const Scene& scene, const std::string& name) {
  for (const Lamp& lamp : LampsOf(scene))
    if (lamp.name == "object:" + name || lamp.name == "material:" + name) return lamp.name;
  return name;
}

}  // namespace

void Viewer::ChangeLight(LightChange next) {
  if (next == light_) return;
  CheckNames(*opened(), next);
  light_ = next;
  Change().SetLight(light_);
}

void Viewer::AddLightSettings() {
  Setting lamps{
      "dim", "Light", "Lamps, NAME=FACTOR, NAME=r,g,b, on or off", SettingKind::kText, 0, 1, false, false, {},
      {},    {}};
  lamps.get = [this] { return TextOf(light_.lamps); };
  lamps.set = [this](const std::string& text) {
    LightChange next = light_;
    if (text == "none") next.lamps.clear();
    const std::vector<Dimming> asked = ParseLamps(text);
    CheckNames(*opened(), {asked, {}});  // a factor of 1 leaves no name behind
    for (const Dimming& lamp : asked) next.Set(Dimming{LampName(*opened(), lamp.name), lamp.factor});
    ChangeLight(std::move(next));
  };
  settings_.Add(std::move(lamps));
  Setting paints{"paint", "Light", "Reflectances, MATERIAL=r,g,b", SettingKind::kText, 0, 1, false, false, {},
                 {},      {}};
  paints.get = [this] { return TextOf(light_.paints); };
  paints.set = [this](const std::string& text) {
    LightChange next = light_;
    if (text == "none") next.paints.clear();
    for (const Paint& paint : ParsePaints(text)) next.Set(paint);
    ChangeLight(std::move(next));
  };
  settings_.Add(std::move(paints));
}

}  // namespace penumbra::viewer
