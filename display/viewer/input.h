// display/viewer/input.h
//
// Input events of keyboard and mouse, which a user or a script generates.

#pragma once

#include <optional>
#include <string>

namespace penumbra::viewer {

enum Modifiers : unsigned { kNoModifier = 0, kShift = 1, kCtrl = 2, kAlt = 4 };

enum class MouseButton : int { kLeft = 0, kRight = 1, kMiddle = 2 };

// InputEvent::key names a key by the lower-case character that the key types, or by one of the names
// `escape`, `enter`, `tab`, `backspace`, `delete`, `space`, `left`, `right`, `up`, `down`, `home`, `end`,
// `f1` to `f12`, `shift`, `ctrl`, `alt`.
struct InputEvent {
  enum class Kind { kKeyDown, kKeyUp, kText, kMove, kButtonDown, kButtonUp, kScroll } kind = Kind::kMove;
  std::string key;
  unsigned text = 0;  // the typed code point
  unsigned modifiers = kNoModifier;
  double x = 0, y = 0;  // pointer position, in pixels of the picture
  MouseButton button = MouseButton::kLeft;
  double scroll = 0;  // notches, positive away from the user
};

// A key with modifiers, as in `ctrl+s`.
struct KeyChord {
  std::string key;
  unsigned modifiers = kNoModifier;

  bool operator==(const KeyChord&) const = default;
};
// Parses the description of a chord; returns nullopt if the text is not a chord.
std::optional<KeyChord> ParseChord(const std::string& text);
bool IsKeyName(const std::string& name);

// The chord of a key press. `key` is the name of the key independent of the layout, or empty; `typed` is the
// code point that the layout assigns to the key press, or 0. If shift changes the character, the chord
// consists of the changed character, such as `?`, without the modifier shift. For letters, shift remains a
// modifier.
KeyChord ChordOf(const std::string& key, unsigned modifiers, unsigned typed);

}  // namespace penumbra::viewer
