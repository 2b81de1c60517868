#include "solver/scene/mtl_reader.h"

#include <cmath>
#include <numbers>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// One value for all channels, or three.
Rgb ReadColour(const StatementReader& reader) {
  const std::vector<std::string_view> words = reader.Words();
  const std::string keyword(reader.Keyword());
  if (words.size() != 1 && words.size() != 3)
    throw reader.Error(keyword + " has " + std::to_string(words.size()) +
                       " values; give three numbers: red, green and blue");
  Rgb colour;
  for (int channel = 0; channel < 3; ++channel)
    colour[channel] = reader.Number(words[words.size() == 3 ? channel : 0]);
  if (colour.minCoeff() < 0)
    throw reader.Error(keyword + " is negative; give a " +
                       (keyword == "Kd" ? "reflectance in [0, 1)" : "value of 0 or more"));
  return colour;
}

}  // namespace

std::vector<Material> ReadMtlText(std::string_view text, std::string_view file, const SceneOptions& options,
                                  std::vector<std::string>& warnings) {
  std::vector<Material> materials;
  int clamped = 0, first_clamped = 0;
  StatementReader reader(text, file);
  while (reader.Next()) {
    const std::string_view keyword = reader.Keyword();
    if (keyword == "newmtl") {
      if (reader.Arguments().empty()) throw reader.Error("newmtl without a name; write newmtl NAME");
      materials.emplace_back();
      materials.back().name = reader.Arguments();
      continue;
    }
    if (keyword != "Kd" && keyword != "Ke") continue;
    if (materials.empty())
      throw reader.Error(std::string(keyword) + " stands before any newmtl; begin with newmtl NAME");
    const Rgb colour = ReadColour(reader);
    if (keyword == "Ke") {
      materials.back().emittance = options.emission_is_radiance ? Rgb(colour * std::numbers::pi) : colour;
      if (!(materials.back().emittance <= kLargestEmittance).all())
        throw reader.Error("Ke is too large; give a smaller emittance");
    } else if (options.max_reflectance) {
      materials.back().reflectance = colour.min(*options.max_reflectance);
      if (colour.maxCoeff() > *options.max_reflectance && clamped++ == 0) first_clamped = reader.Line();
    } else {
      if (colour.maxCoeff() >= 1)
        throw reader.Error("the reflectance Kd of " + Quoted(materials.back().name) +
                           " is 1 or more; give values below 1, or clamp them with --max-reflectance");
      materials.back().reflectance = colour;
    }
  }
  if (clamped > 0)
    warnings.push_back(
        WarningAt(file, first_clamped,
                  std::to_string(clamped) + " reflectance(s) clamped to the greatest allowed, first here"));
  return materials;
}

}  // namespace penumbra
