#include "solver/scene/mtl_reader.h"

#include <cmath>
#include <numbers>

#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

// One value for all channels, or three.
Rgb ReadColour(const StatementReader& reader) {
  const std::vector<std::string_view> words = reader.Values();
  const std::string keyword(reader.Keyword());
  if (!words.empty() && words[0] == "spectral")
    throw reader.Error(keyword + " is a spectrum (`" + keyword +
                       " spectral`), which is not read; give three numbers: red, green and blue");
  if (!words.empty() && words[0] == "xyz")
    throw reader.Error(keyword + " is in CIE XYZ (`" + keyword +
                       " xyz`), which is not read; give three numbers: linear red, green and blue");
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

class MtlParser {
 public:
  MtlParser(std::string_view text, std::string_view file, const SceneOptions& options)
      : reader_(text, file), options_(options) {}

  std::vector<DefinedMaterial> Parse(std::vector<std::string>& warnings) {
    while (reader_.Next()) ReadStatement();
    if (clamped_ > 0)
      warnings.push_back(WarningAt(
          reader_.File(), first_clamped_,
          std::to_string(clamped_) + " reflectance(s) clamped to the greatest allowed, first here"));
    if (first_nameless_ > 0)
      warnings.push_back(WarningAt(reader_.File(), first_nameless_,
                                   "newmtl without a name; usemtl without a name uses this material"));
    if (reader_.LineEndedByCr() > 0)
      warnings.push_back(WarningAt(reader_.File(), reader_.LineEndedByCr(), kLinesEndInCr));
    return std::move(materials_);
  }

 private:
  void ReadStatement() {
    const std::string_view keyword = reader_.Keyword();
    if (keyword == "newmtl") {
      if (reader_.Arguments().empty()) MissName();
      materials_.emplace_back().line = reader_.Line();
      materials_.back().material.name = reader_.Arguments();
      return;
    }
    if (keyword != "Kd" && keyword != "Ke") return;
    if (materials_.empty())
      throw reader_.Error(std::string(keyword) + " stands before any newmtl; begin with newmtl NAME");
    const Rgb colour = ReadColour(reader_);
    keyword == "Ke" ? SetEmittance(colour) : SetReflectance(colour);
  }

  // Some modellers write materials without names; `usemtl` without a name uses such a one.
  void MissName() {
    if (options_.strict) throw reader_.Error("newmtl without a name; write newmtl NAME");
    if (first_nameless_ == 0) first_nameless_ = reader_.Line();
  }

  void SetEmittance(const Rgb& colour) {
    Rgb& emittance = materials_.back().material.emittance;
    emittance = options_.emission_is_radiance ? Rgb(colour * std::numbers::pi) : colour;
    if (!(emittance <= kLargestEmittance).all())
      throw reader_.Error("Ke is too large; give a smaller emittance");
  }

  void SetReflectance(const Rgb& colour) {
    Material& material = materials_.back().material;
    if (options_.max_reflectance) {
      material.reflectance = colour.min(*options_.max_reflectance);
      if (colour.maxCoeff() > *options_.max_reflectance && clamped_++ == 0) first_clamped_ = reader_.Line();
      return;
    }
    if (colour.maxCoeff() >= 1)
      throw reader_.Error("the reflectance Kd of " + Quoted(material.name) +
                          " is 1 or more; give values below 1, or clamp them with --max-reflectance");
    material.reflectance = colour;
  }

  StatementReader reader_;
  const SceneOptions& options_;
  std::vector<DefinedMaterial> materials_;
  int clamped_ = 0, first_clamped_ = 0, first_nameless_ = 0;
};

}  // namespace

std::vector<DefinedMaterial> ReadMtlText(std::string_view text, std::string_view file,
                                         const SceneOptions& options, std::vector<std::string>& warnings) {
  RefuseForeignFormat(text, file, "a material library (MTL)");
  return MtlParser(text, file, options).Parse(warnings);
}

}  // namespace penumbra
