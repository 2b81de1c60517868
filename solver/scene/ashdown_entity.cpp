#include "solver/scene/ashdown_entity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "solver/scene/written_digits.h"

namespace penumbra {
namespace {

constexpr std::string_view kBlankCharacters = " \t\v\f";
constexpr std::string_view kBrackets = "<>[]{}()";
constexpr std::string_view kNumberCharacters = "0123456789+-.eE";

// What the items of a section begin with.
enum class ItemStart { kBracket, kIndex };

class EntityParser {
 public:
  EntityParser(std::string_view text, const std::string& path) : lines_(text, path) {
    entity_.name = std::filesystem::path(path).stem().string();
  }

  AshdownEntity Parse() {
    if (!lines_.Next()) throw lines_.Error("the file is empty; it must begin with the line ENTITY");
    Section("VERTEX", ItemStart::kBracket, [this] { ReadVertex(); });
    Section("SURFACE", ItemStart::kBracket, [this] { ReadSurface(); });
    Section("PATCH", ItemStart::kIndex, [this] { ReadPatch(); });
    Section("ELEMENT", ItemStart::kIndex, [this] {
      ReadCorners("an element", entity_.patches.size());
      ++entity_.elements;
    });
    entity_.vertices = vertices_.size();
    entity_.step = digits_.Step();
    if (entity_.surfaces.size() == 1) entity_.surfaces.front().name = entity_.name;
    return std::move(entity_);
  }

 private:
  struct Item {
    std::size_t owner = 0;  // index of the surface of a patch, or of the patch of an element
    Polygon3 corners;
  };

  template <class Read>
  void Section(std::string_view keyword, ItemStart start, const Read& read);
  bool AtItem(ItemStart start) const;
  void ReadVertex();
  void ReadSurface();
  void ReadPatch();
  Item ReadCorners(std::string_view what, std::size_t owners);

  AshdownLines lines_;
  AshdownEntity entity_;
  std::vector<Vec3> vertices_;
  WrittenDigits digits_;
};

bool EntityParser::AtItem(ItemStart start) const {
  const char first = lines_.Rest().front();
  if (start == ItemStart::kBracket) return kBrackets.find(first) != kBrackets.npos;
  return kNumberCharacters.substr(0, kNumberCharacters.find('.')).find(first) != kNumberCharacters.npos;
}

// Reads the line that begins the section, its items, and the line that ends it.
template <class Read>
void EntityParser::Section(std::string_view keyword, ItemStart start, const Read& read) {
  if (!lines_.Next() || AtItem(start))
    throw lines_.Error(fmt::format("the line {} is missing, which begins a section", keyword));
  bool is_empty = true;
  for (; lines_.Next(); is_empty = false) {
    if (!AtItem(start)) {
      if (is_empty) throw lines_.Error(fmt::format("the section {} has no items; add at least one", keyword));
      return;
    }
    read();
  }
  throw lines_.Error(fmt::format("the file ends within the section {}; give the whole file", keyword));
}

void EntityParser::ReadVertex() {
  const std::array<double, 3> vertex = lines_.Bracketed<3>("a vertex: < x y z >");
  for (int axis = 0; axis < 3; ++axis)
    digits_.Add(axis, lines_.words()[static_cast<std::size_t>(axis)], vertex[static_cast<std::size_t>(axis)]);
  vertices_.emplace_back(vertex[0], vertex[1], vertex[2]);
}

void EntityParser::ReadSurface() {
  constexpr std::string_view kWhat = "a surface: [ reflectances ] [ exitances ]";
  const std::array<double, 3> reflectance = lines_.Bracketed<3>(kWhat), exitance = lines_.Bracketed<3>(kWhat);
  Material material;
  material.name = fmt::format("{}_{}", entity_.name, entity_.surfaces.size());
  material.reflectance = Rgb(reflectance[0], reflectance[1], reflectance[2]);
  material.emittance = Rgb(exitance[0], exitance[1], exitance[2]);
  entity_.surfaces.push_back(std::move(material));
}

void EntityParser::ReadPatch() {
  Item item = ReadCorners("a patch", entity_.surfaces.size());
  entity_.patches.push_back({item.owner, std::move(item.corners)});
}

// Reads an owner and four vertices, of which the last two are the same if there are three corners.
EntityParser::Item EntityParser::ReadCorners(std::string_view what, std::size_t owners) {
  Item item;
  item.owner = lines_.Index(fmt::format("the first number of {}", what), owners);
  const std::array<double, 4> numbers =
      lines_.Bracketed<4>(fmt::format("{}: a number and {{ v0 v1 v2 v3 }}", what));
  std::array<std::size_t, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = lines_.ToIndex(numbers[i], fmt::format("a vertex of {}", what), vertices_.size());
  const std::size_t count = corners[2] == corners[3] ? 3 : 4;
  for (std::size_t i = 0; i < count; ++i) item.corners.push_back(vertices_[corners[i]]);
  return item;
}

}  // namespace

bool AshdownLines::Next() {
  while (!lines_.AtEnd()) {
    line_ = lines_.NextLine();
    rest_ = lines_.Take();
    SkipBlanks();
    if (!rest_.empty() && !rest_.starts_with("COMMENT")) {
      rest_ = rest_.substr(0, rest_.find_last_not_of(kBlankCharacters) + 1);
      return true;
    }
  }
  rest_ = {};
  return false;
}

void AshdownLines::SkipBlanks() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlankCharacters), rest_.size()));
}

void AshdownLines::Bracket(std::string_view what) {
  SkipBlanks();
  if (rest_.empty() || kBrackets.find(rest_.front()) == kBrackets.npos)
    throw Error(fmt::format("a bracket is missing before {}; the line must be {}", Quoted(rest_), what));
  rest_.remove_prefix(1);
}

double AshdownLines::Number(std::string_view what) {
  SkipBlanks();
  const std::size_t end = std::min(rest_.find_first_not_of(kNumberCharacters), rest_.size());
  const std::string_view word = rest_.substr(0, end);
  const std::optional<double> value = ToNumber(word);
  if (!value || !std::isfinite(*value))
    throw Error(fmt::format("a number is missing before {}; the line must be {}", Quoted(rest_), what));
  rest_.remove_prefix(end);
  words_.push_back(word);
  return *value;
}

std::size_t AshdownLines::ToIndex(double value, std::string_view what, std::size_t count) const {
  if (!(value >= 0) || value >= static_cast<double>(count) || value != std::floor(value))
    throw Error(fmt::format("{} is {:g}; it must be a whole number from 0 to {}", what, value, count - 1));
  return static_cast<std::size_t>(value);
}

std::size_t AshdownLines::Index(std::string_view what, std::size_t count) {
  return ToIndex(Number(what), what, count);
}

AshdownEntity ReadAshdownEntity(std::string_view text, const std::string& path) {
  RefuseForeignFormat(text, path, "an entity file (.ent)");
  return EntityParser(text, path).Parse();
}

}  // namespace penumbra
