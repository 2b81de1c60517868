// display/viewer/input.h
//
// What a user, or a script in his place, does with keys and mouse.

#pragma once

#include <optional>
#include <string>

namespace penumbra::viewer {

enum Modifiers : unsigned { kNoModifier = 0, kShift = 1, kCtrl = 2, kAlt = 4 };

enum class MouseButton : int { kLeft = 0, kRight = 1, kMiddle = 2 };

// Keys are named by what they print in lower case, or `escape`, `enter`, `tab`, `backspace`, `delete`,
// `space`, `left`, `right`, `up`, `down`, `home`, `end`, `f1` to `f12`, `shift`, `ctrl`, `alt`.
struct InputEvent {
  enum class Kind { kKeyDown, kKeyUp, kText, kMove, kButtonDown, kButtonUp, kScroll } kind = Kind::kMove;
  std::string key;
  unsigned text = 0;  // a code point typed
  unsigned modifiers = kNoModifier;
  double x = 0, y = 0;  // of the pointer, in pixels of the picture
  MouseButton button = MouseButton::kLeft;
  double scroll = 0;  // notches, positive away from the user
};

// A key with modifiers, as in `ctrl+s`.
struct KeyChord {
  std::string key;
  unsigned modifiers = kNoModifier;

  bool operator==(const KeyChord&) const = default;
};
// Nothing if the text names none.
std::optional<KeyChord> ParseChord(const std::string& text);
bool IsKeyName(const std::string& name);

// What the press of a key is called. `key`: its name where nothing is known of the layout, or empty; `typed`:
// the code point that the layout makes of it, or 0. Shift that made another character of the key is part of
// its name: `?`, wherever that is; with letters it stays a modifier.
KeyChord ChordOf(const std::string& key, unsigned modifiers, unsigned typed);

}  // namespace penumbra::viewer
