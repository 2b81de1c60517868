#include "apps/messages.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdio>
#include <string_view>

namespace penumbra {
namespace {

// The longest message: what a path may have, 4096 bytes, does not fit a screen, and no sentence of ours is
// as long as what is kept of either end.
constexpr std::size_t kLongest = 2000, kBeginning = 1400, kEnding = 500;

std::atomic<bool> unheard{false};

// The bytes of the character of UTF-8 at the beginning of the text, 0 if there is none.
std::size_t CharacterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : byte(0) >= 0xc2 ? 2 : 0;
  if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // Overlong forms, surrogates, and what Unicode does not have.
  if ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
      (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f))
    return 0;
  return length;
}

// U+0080 to U+009F are control characters, too.
bool IsControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

void Put(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stderr) != text.size() || std::fflush(stderr) != 0)
    unheard = true;
}

}  // namespace

std::string OneLine(const std::string& message) {
  std::string line;
  std::string_view rest = message;
  while (!rest.empty() && rest.back() == '\n') rest.remove_suffix(1);
  while (!rest.empty()) {
    const std::size_t length = CharacterLength(rest);
    const std::string_view character = rest.substr(0, length > 0 ? length : 1);
    if (length == 0 || IsControl(character))
      for (const char byte : character) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    else
      line += character;
    rest.remove_prefix(character.size());
  }
  if (line.size() <= kLongest) return line;
  const auto is_inside = [&](std::size_t at) {
    return (static_cast<unsigned char>(line[at]) & 0xc0) == 0x80;
  };
  std::size_t head = kBeginning, tail = line.size() - kEnding;
  while (is_inside(head)) --head;
  while (is_inside(tail)) ++tail;
  return line.substr(0, head) + " [...] " + line.substr(tail);
}

void Say(const std::string& message) { Put(OneLine(message) + "\n"); }

void PrintText(const std::string& text) { Put(text); }

bool MessageFailed() { return unheard; }

}  // namespace penumbra
