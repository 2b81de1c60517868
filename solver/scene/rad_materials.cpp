#include "solver/scene/rad_materials.h"

#include <algorithm>
#include <array>

#include "solver/base/check.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

constexpr auto kSurfaces = std::to_array<std::string_view>(
    {"polygon", "sphere", "bubble", "cone", "cup", "cylinder", "tube", "ring", "source", "instance", "mesh"});
constexpr auto kLights = std::to_array<std::string_view>({"light", "glow", "illum", "spotlight"});
// Light passes through them.
constexpr auto kClear =
    std::to_array<std::string_view>({"glass", "dielectric", "interface", "mist", "antimatter"});
// A colour, then how much of it is specular.
constexpr auto kGlossy =
    std::to_array<std::string_view>({"plastic", "metal", "plastic2", "metal2", "ashik2"});

bool IsOneOf(const auto& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// The numbers of a primitive, from `first`.
Rgb ColourAt(const std::vector<double>& numbers, std::size_t first) {
  if (numbers.size() < first + 3)
    throw InputError("it has " + std::to_string(numbers.size()) + " numbers; give red, green and blue first");
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

}  // namespace

bool RadMaterials::IsModifier(std::string_view type) { return !IsOneOf(kSurfaces, type); }

void RadMaterials::Define(const RadPrimitive& primitive) {
  std::vector<double> numbers;
  for (const std::string& word : primitive.reals) numbers.push_back(*ToNumber(word));
  const auto number = [&](std::size_t i) { return i < numbers.size() ? numbers[i] : 0.0; };
  RadMaterial made;
  made.material.name = primitive.identifier;
  made.material.reflectance = Rgb::Zero();
  const std::string& type = primitive.type;
  if (IsOneOf(kLights, type)) {
    made.material.emittance = ColourAt(numbers, 0);
    made.two_sided = false;
    if (type == "spotlight") made.left_out = "the direction of the light";
  } else if (IsOneOf(kGlossy, type)) {
    made.material.reflectance = ColourAt(numbers, 0) * (1 - number(3));
    if (number(3) > 0) made.left_out = "the specular part";
  } else if (type == "trans" || type == "trans2") {
    made.material.reflectance = ColourAt(numbers, 0) * (1 - number(3)) * (1 - number(5));
    made.left_out = "the transmitted and the specular part";
  } else if (IsOneOf(kClear, type)) {
    made.passed_over = true;
    made.left_out = "all surfaces, which are clear,";
  } else if (const auto modified = materials_.find(primitive.modifier); modified != materials_.end()) {
    // A pattern or a texture over a material, or what is not known: what it modifies is what remains.
    made = modified->second;
    made.left_out = type;
  } else {
    made.left_out = type;
  }
  if (const auto pattern = materials_.find(primitive.modifier);
      made.left_out.empty() && pattern != materials_.end())
    made.left_out = "the pattern " + Quoted(primitive.modifier);
  materials_[primitive.identifier] = std::move(made);
}

void RadMaterials::Alias(const RadPrimitive& primitive) {
  RadMaterial same = Find(primitive.strings.at(0));
  same.material.name = primitive.identifier;
  materials_[primitive.identifier] = std::move(same);
}

const RadMaterial& RadMaterials::Find(std::string_view modifier) const {
  static const RadMaterial nothing = [] {
    RadMaterial made;
    made.passed_over = true;
    made.left_out = "all surfaces, which have no material,";
    made.material.name = "void";
    return made;
  }();
  if (modifier == "void") return nothing;
  const auto found = materials_.find(modifier);
  if (found == materials_.end())
    throw InputError("the modifier " + Quoted(modifier) + " is not defined above it");
  return found->second;
}

}  // namespace penumbra
