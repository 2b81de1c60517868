// display/viewer/script.h
//
// Scripts that stand in for a user (`penumbra view --script FILE`): an action a line, played a step a frame.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "display/viewer/input.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// What an action comes to: at most one of these a frame.
struct ScriptStep {
  enum class Kind {
    kInput,
    kMenu,
    kSet,
    kWaitIdle,
    kWaitFrames,
    kWaitSeconds,
    kScreenshot,
    kResize,
    kQuit
  } kind = Kind::kInput;
  int line = 0;  // of the file
  InputEvent event;
  std::string text, value;  // menu path; option and value; file
  double amount = 0;        // frames or seconds
  int width = 0, height = 0;
};

struct Script {
  std::string name;  // of the file, for messages
  std::vector<ScriptStep> steps;
};

// The words of a script, for `--help`.
extern const char* const kScriptHelp;

// Throws InputError, `NAME:LINE: error: ...`, at the first line that is no action.
Script ParseScript(const std::string& name, const std::string& text);
// Throws InputError if the file cannot be read.
Script ReadScript(const std::string& path);

// What plays a script needs to be able to do.
class ScriptStage {
 public:
  virtual ~ScriptStage() = default;
  virtual void Input(const InputEvent& event) = 0;
  virtual void Resize(int width, int height) = 0;
  // Writes the next whole frame. Throws InputError if it cannot.
  virtual void Screenshot(const std::string& path) = 0;
};

class ScriptPlayer {
 public:
  explicit ScriptPlayer(Script script) : script_(std::move(script)) {}

  // The steps of one frame. False once all is done. Throws InputError with file and line if a step cannot be.
  bool Advance(Viewer& viewer, ScriptStage& stage, double seconds);

 private:
  bool WaitIsOver(Viewer& viewer, const ScriptStep& step, double seconds);

  Script script_;
  std::size_t next_ = 0;
  double waited_frames_ = 0, waited_seconds_ = 0;
};

inline constexpr double kLongestWait = 900;  // seconds that `wait idle` waits before it gives up

}  // namespace penumbra::viewer
