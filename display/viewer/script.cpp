#include "display/viewer/script.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>

#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

constexpr int kDragSteps = 8;
constexpr int kSettlingFrames = 3;  // that panels take to find their size

// The words of a line, one after the other.
class Words {
 public:
  Words(const std::string& line, std::string where) : stream_(line), where_(std::move(where)) {}

  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(fmt::format("{}: error: {}", where_, what));
  }
  std::string Word(const std::string& what) {
    std::string word;
    if (!(stream_ >> word)) Fail(what + " is missing");
    return word;
  }
  double Number(const std::string& what) {
    const std::string word = Word(what);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      Fail(fmt::format("{}: '{}' is not a number", what, word));
    return value;
  }
  bool More() { return (stream_ >> std::ws).good() && !stream_.eof(); }
  std::string Rest(const std::string& what) {
    std::string rest;
    if (More()) std::getline(stream_, rest);
    while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t' || rest.back() == '\r'))
      rest.pop_back();
    if (rest.empty()) Fail(what + " is missing");
    return rest;
  }
  void End() {
    if (More()) Fail(fmt::format("'{}' is too much", Rest("")));
  }

 private:
  std::istringstream stream_;
  std::string where_;
};

class Parser {
 public:
  Parser(const std::string& name, Script* script) : name_(name), script_(script) {}

  void Line(const std::string& line, int number) {
    line_ = number;
    Words words(line, fmt::format("{}:{}", name_, number));
    if (!words.More()) return;
    const std::string action = words.Word("an action");
    if (action[0] == '#') return;
    if (action == "key") {
      Key(words);
    } else if (action == "type") {
      for (const char c : words.Rest("what to type")) Text(c);
    } else if (action == "mouse") {
      Mouse(words);
    } else if (action == "menu") {
      Add(ScriptStep::Kind::kMenu).text = words.Rest("a menu path, as in `menu Iteration/Iterate`");
    } else if (action == "set") {
      const std::string option = words.Word("an option");
      ScriptStep& step = Add(ScriptStep::Kind::kSet);
      step.text = option;
      step.value = words.Rest("a value");
    } else if (action == "wait") {
      Wait(words);
    } else if (action == "screenshot") {
      Wait(kSettlingFrames);
      const std::string path = words.Rest("a file");
      if (!path.ends_with(".png")) words.Fail(fmt::format("'{}' does not end in .png", path));
      Add(ScriptStep::Kind::kScreenshot).text = path;
    } else if (action == "resize") {
      Resize(words);
    } else if (action == "quit") {
      Add(ScriptStep::Kind::kQuit);
    } else {
      words.Fail(
          fmt::format("'{}' is none of key, type, mouse, menu, set, wait, screenshot, resize, quit", action));
    }
    words.End();
  }

 private:
  ScriptStep& Add(ScriptStep::Kind kind) {
    ScriptStep step;
    step.kind = kind;
    step.line = line_;
    script_->steps.push_back(std::move(step));
    return script_->steps.back();
  }
  void Input(const InputEvent& event) { Add(ScriptStep::Kind::kInput).event = event; }
  void Wait(double frames) { Add(ScriptStep::Kind::kWaitFrames).amount = frames; }

  void Text(char c) {
    InputEvent event;
    event.kind = InputEvent::Kind::kText;
    event.text = static_cast<unsigned char>(c);
    Input(event);
  }

  // `key CHORD`, `key down CHORD`, `key up CHORD`.
  void Key(Words& words) {
    std::string name = words.Word("a key");
    const bool more = words.More();
    const bool down = more && name == "down", up = more && name == "up";
    if (down || up) name = words.Word("a key");
    const std::optional<KeyChord> chord = ParseChord(name);
    if (!chord) words.Fail(fmt::format("'{}' is no key; write ctrl+s, escape, f1, a", name));
    InputEvent event;
    event.key = chord->key;
    event.modifiers = chord->modifiers;
    event.kind = InputEvent::Kind::kKeyDown;
    if (!up) Input(event);
    event.kind = InputEvent::Kind::kKeyUp;
    if (!down) Input(event);
  }

  void Button(Words& words, InputEvent* event) {
    std::string name = words.Word("a button");
    for (const auto& [prefix, bit] : {std::pair{std::string("shift+"), kShift},
                                      {std::string("ctrl+"), kCtrl},
                                      {std::string("alt+"), kAlt}})
      if (name.starts_with(prefix)) {
        event->modifiers |= bit;
        name.erase(0, prefix.size());
      }
    if (name == "left")
      event->button = MouseButton::kLeft;
    else if (name == "right")
      event->button = MouseButton::kRight;
    else if (name == "middle")
      event->button = MouseButton::kMiddle;
    else
      words.Fail(fmt::format("'{}' is none of left, middle, right", name));
  }

  void Place(Words& words) {
    x_ = words.Number("x");
    y_ = words.Number("y");
  }
  void At(InputEvent event, InputEvent::Kind kind) {
    event.kind = kind;
    event.x = x_;
    event.y = y_;
    Input(event);
  }

  void Mouse(Words& words) {
    const std::string what = words.Word("move, press, release, click, drag or scroll");
    InputEvent event;
    if (what == "move") {
      Place(words);
      At(event, InputEvent::Kind::kMove);
    } else if (what == "press" || what == "release" || what == "click" || what == "double-click") {
      Button(words, &event);
      if (words.More() || what == "click") {
        Place(words);
        At(event, InputEvent::Kind::kMove);
      }
      for (int i = 0; i < (what == "double-click" ? 2 : 1); ++i) {
        if (what != "release") At(event, InputEvent::Kind::kButtonDown);
        if (what != "press") At(event, InputEvent::Kind::kButtonUp);
      }
    } else if (what == "drag") {
      Button(words, &event);
      Place(words);
      const double x0 = x_, y0 = y_;
      At(event, InputEvent::Kind::kMove);
      At(event, InputEvent::Kind::kButtonDown);
      Place(words);
      const double x1 = x_, y1 = y_;
      for (int i = 1; i <= kDragSteps; ++i) {
        x_ = x0 + (x1 - x0) * i / kDragSteps;
        y_ = y0 + (y1 - y0) * i / kDragSteps;
        At(event, InputEvent::Kind::kMove);
      }
      At(event, InputEvent::Kind::kButtonUp);
    } else if (what == "scroll") {
      event.scroll = words.Number("notches");
      At(event, InputEvent::Kind::kScroll);
    } else {
      words.Fail(
          fmt::format("'{}' is none of move, press, release, click, double-click, drag, scroll", what));
    }
  }

  void Wait(Words& words) {
    const std::string what = words.Word("idle, frames or seconds");
    if (what == "idle") {
      Wait(1.0);
      Add(ScriptStep::Kind::kWaitIdle);
    } else if (what == "frames" || what == "seconds") {
      const double amount = words.Number(what);
      if (!(amount >= 0)) words.Fail(fmt::format("{} is below 0", what));
      Add(what == "frames" ? ScriptStep::Kind::kWaitFrames : ScriptStep::Kind::kWaitSeconds).amount = amount;
    } else {
      words.Fail(fmt::format("'{}' is none of idle, frames, seconds", what));
    }
  }

  void Resize(Words& words) {
    const std::string size = words.Word("WxH");
    int w = 0, h = 0;
    const char* end = size.data() + size.size();
    const auto first = std::from_chars(size.data(), end, w);
    const bool x = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
    const auto second = x ? std::from_chars(first.ptr + 1, end, h) : first;
    constexpr int kLargest = 16384;
    if (!x || second.ec != std::errc() || second.ptr != end || w < 1 || h < 1 || w > kLargest || h > kLargest)
      words.Fail(fmt::format("'{}' is not WIDTHxHEIGHT, each from 1 to {}", size, kLargest));
    ScriptStep& step = Add(ScriptStep::Kind::kResize);
    step.width = w;
    step.height = h;
  }

  std::string name_;
  Script* script_;
  int line_ = 0;
  double x_ = 0, y_ = 0;
};

}  // namespace

const char* const kScriptHelp =
    "A script has an action a line; # begins a comment. Positions are pixels from the upper left.\n"
    "  key CHORD                       press and release, as in a, ctrl+s, escape, f1, space, left\n"
    "  key down CHORD, key up CHORD    hold, let go\n"
    "  type TEXT                       into a field\n"
    "  mouse move X Y\n"
    "  mouse press|release|click|double-click BUTTON [X Y]    BUTTON: left, middle, right; shift+left ...\n"
    "  mouse drag BUTTON X0 Y0 X1 Y1\n"
    "  mouse scroll NOTCHES\n"
    "  menu PATH                       as in: menu Iteration/Iterate to convergence\n"
    "  set OPTION VALUE                any option of the panels; see below\n"
    "  wait idle                       until nothing is being computed\n"
    "  wait frames N, wait seconds X\n"
    "  screenshot FILE.png             the window as it is\n"
    "  resize WxH\n"
    "  quit                            as does the end of the file";

Script ParseScript(const std::string& name, const std::string& text) {
  Script script;
  script.name = name;
  Parser parser(name, &script);
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) parser.Line(line, ++number);
  return script;
}

Script ReadScript(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file)
    throw InputError(fmt::format(
        "{}: error: the script cannot be read; check its name and the permission to read it", path));
  return ParseScript(path, text);
}

bool ScriptPlayer::WaitIsOver(Viewer& viewer, const ScriptStep& step, double seconds) {
  waited_frames_ += 1;
  waited_seconds_ += seconds;
  switch (step.kind) {
    case ScriptStep::Kind::kWaitFrames:
      return waited_frames_ > step.amount;
    case ScriptStep::Kind::kWaitSeconds:
      return waited_seconds_ > step.amount;
    case ScriptStep::Kind::kWaitIdle:
      if (waited_seconds_ > kLongestWait)
        throw InputError(fmt::format("still busy after {} seconds", kLongestWait));
      return viewer.Idle();
    default:
      return true;
  }
}

bool ScriptPlayer::Advance(Viewer& viewer, ScriptStage& stage, double seconds) {
  if (next_ >= script_.steps.size()) return false;
  const ScriptStep& step = script_.steps[next_];
  try {
    if (!WaitIsOver(viewer, step, seconds)) return true;
    waited_frames_ = waited_seconds_ = 0;
    ++next_;
    switch (step.kind) {
      case ScriptStep::Kind::kInput:
        stage.Input(step.event);
        break;
      case ScriptStep::Kind::kMenu:
        viewer.RunMenu(step.text);
        break;
      case ScriptStep::Kind::kSet:
        viewer.Set(step.text, step.value);
        break;
      case ScriptStep::Kind::kScreenshot:
        stage.Screenshot(step.text);
        break;
      case ScriptStep::Kind::kResize:
        stage.Resize(step.width, step.height);
        break;
      case ScriptStep::Kind::kQuit:
        return false;
      case ScriptStep::Kind::kWaitIdle:
      case ScriptStep::Kind::kWaitFrames:
      case ScriptStep::Kind::kWaitSeconds:
        break;
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}:{}: error: {}", script_.name, step.line, error.what()));
  }
  return true;
}

}  // namespace penumbra::viewer
