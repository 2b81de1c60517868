#include "display/viewer/input.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace penumbra::viewer {

bool IsKeyName(const std::string& name) {
  constexpr std::array<std::string_view, 16> kNames = {
      "escape", "enter", "tab",  "backspace", "delete", "space", "left", "right",
      "up",     "down",  "home", "end",       "shift",  "ctrl",  "alt",  "pageup"};
  if (name.size() == 1) return name[0] > ' ' && name[0] < 127 && !(name[0] >= 'A' && name[0] <= 'Z');
  if (name.size() <= 3 && name.size() >= 2 && name[0] == 'f') {
    int number = 0;
    for (const char c : name.substr(1)) {
      if (c < '0' || c > '9') return false;
      number = 10 * number + (c - '0');
    }
    return number >= 1 && number <= 12;
  }
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

std::optional<KeyChord> ParseChord(const std::string& text) {
  KeyChord chord;
  std::string rest = text;
  for (bool found = true; found;) {
    found = false;
    for (const auto& [name, bit] : {std::pair{std::string("shift+"), kShift},
                                    {std::string("ctrl+"), kCtrl},
                                    {std::string("alt+"), kAlt}})
      if (rest.size() > name.size() && rest.starts_with(name)) {
        chord.modifiers |= bit;
        rest.erase(0, name.size());
        found = true;
      }
  }
  if (!IsKeyName(rest)) return std::nullopt;
  chord.key = rest;
  return chord;
}

KeyChord ChordOf(const std::string& key, unsigned modifiers, unsigned typed) {
  // Other alphabets type no name of ours: there the place of the key counts.
  if (typed <= ' ' || typed >= 127) return {key, modifiers};
  const auto c = static_cast<char>(typed);
  if (c >= 'A' && c <= 'Z') return {std::string(1, static_cast<char>(c - 'A' + 'a')), modifiers};
  const bool letter = c >= 'a' && c <= 'z';
  return {std::string(1, c), letter ? modifiers : modifiers & ~static_cast<unsigned>(kShift)};
}

}  // namespace penumbra::viewer
