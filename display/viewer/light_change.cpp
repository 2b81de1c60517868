#include "display/viewer/light_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "display/viewer/settings.h"
#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

struct NamedValue {
  std::string name;
  Rgb value;
};

// `r,g,b`, or one number for all channels.
Rgb ChannelsFrom(const std::string& text, double high) {
  Rgb value;
  std::size_t begin = 0;
  for (int c = 0; c < 3; ++c) {
    const std::size_t comma = text.find(',', begin);
    if (c == 0 && comma == text.npos) return Rgb::Constant(NumberFrom(text, 0, high));
    if ((comma == text.npos) != (c == 2)) throw InputError(fmt::format("'{}' is not r,g,b", text));
    value[c] = NumberFrom(text.substr(begin, comma - begin), 0, high);
    begin = comma + 1;
  }
  return value;
}

// The parts of `A=x B=y`. A text with a single = is one part, so that names may contain spaces.
std::vector<std::string> PartsOfList(const std::string& text) {
  if (std::count(text.begin(), text.end(), '=') <= 1) return {text};
  std::vector<std::string> parts;
  std::istringstream words(text);
  for (std::string word; words >> word;) parts.push_back(word);
  return parts;
}

std::vector<NamedValue> ParseValues(const std::string& text, double high) {
  std::vector<NamedValue> values;
  if (text == "none") return values;
  for (const std::string& part : PartsOfList(text)) {
    const std::size_t equals = part.rfind('=');
    if (equals == part.npos || equals == 0)
      throw InputError(fmt::format("'{}' is not NAME=r,g,b, NAME=FACTOR or none", part));
    std::string value = part.substr(equals + 1);
    if (value == "on") value = "1";
    if (value == "off") value = "0";
    values.push_back({part.substr(0, equals), ChannelsFrom(value, high)});
  }
  return values;
}

std::string ValueTextOf(const std::string& name, const Rgb& value) {
  if ((value == value[0]).all()) return fmt::format("{}={}", name, value[0]);
  return fmt::format("{}={},{},{}", name, value[0], value[1], value[2]);
}

bool SameLamp(const Dimming& a, const Dimming& b) { return a.name == b.name && (a.factor == b.factor).all(); }

constexpr double kLargestPaint = 0.999;  // a reflectance is below 1

}  // namespace

bool LightChange::operator==(const LightChange& other) const {
  return std::equal(lamps.begin(), lamps.end(), other.lamps.begin(), other.lamps.end(), &SameLamp) &&
         paints == other.paints;
}

void LightChange::Set(const Dimming& lamp) {
  std::erase_if(lamps, [&](const Dimming& other) { return other.name == lamp.name; });
  if ((lamp.factor != 1).any()) lamps.push_back(lamp);
}

void LightChange::Set(const Paint& paint) {
  std::erase_if(paints, [&](const Paint& other) { return other.material == paint.material; });
  paints.push_back(paint);
}

Scene Changed(const Scene& scene, const LightChange& change) {
  Scene changed = scene;
  for (const Paint& paint : change.paints) {
    bool found = false;
    for (Material& material : changed.materials)
      if (material.name == paint.material) {
        material.reflectance = paint.reflectance;
        found = true;
      }
    if (!found) throw InputError(fmt::format("the scene has no material '{}'", paint.material));
  }
  if (!change.lamps.empty()) ScaleEmittance(changed, DimmingFactors(scene, change.lamps));
  return changed;
}

std::vector<Dimming> ParseLamps(const std::string& text) {
  std::vector<Dimming> lamps;
  for (NamedValue& value : ParseValues(text, kLargestLampFactor))
    lamps.push_back({std::move(value.name), value.value});
  return lamps;
}

std::vector<Paint> ParsePaints(const std::string& text) {
  std::vector<Paint> paints;
  for (NamedValue& value : ParseValues(text, kLargestPaint))
    paints.push_back({std::move(value.name), value.value});
  return paints;
}

std::string TextOf(std::span<const Dimming> lamps) {
  std::vector<std::string> texts;
  for (const Dimming& lamp : lamps) texts.push_back(ValueTextOf(lamp.name, lamp.factor));
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, " "));
}

std::string TextOf(std::span<const Paint> paints) {
  std::vector<std::string> texts;
  for (const Paint& paint : paints) texts.push_back(ValueTextOf(paint.material, paint.reflectance));
  return texts.empty() ? "none" : fmt::format("{}", fmt::join(texts, " "));
}

std::vector<Lamp> LampsOf(const Scene& scene) {
  const bool by_object = !scene.objects.empty();
  std::vector<Lamp> lamps;
  for (std::vector<PatchId>& patches :
       EmittersOf(scene, by_object ? EmitterUnit::kObject : EmitterUnit::kMaterial)) {
    const Patch& first = scene.patches[static_cast<std::size_t>(patches[0])];
    const std::string name = by_object
                                 ? "object:" + scene.objects[static_cast<std::size_t>(first.object)].name
                                 : "material:" + scene.MaterialOf(patches[0]).name;
    const Rgb emittance = scene.MaterialOf(patches[0]).emittance;
    lamps.push_back({name, std::move(patches), emittance});
  }
  return lamps;
}

}  // namespace penumbra::viewer
