// display/viewer/script.h
//
// Scripts that control the viewer in place of a user (`penumbra view --script FILE`). Each line of a viewer
// script is one action, such as a key press or a menu item.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "display/viewer/input.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// One step of an action in a viewer script. The viewer runs at most one script step in each frame.
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
  int line = 0;  // the number of the script line in its file
  InputEvent event;
  std::string text, value;  // argument of the step: a menu path, an option with its value, or a file name
  double amount = 0;        // duration of a wait, in frames or seconds
  int width = 0, height = 0;
};

struct Script {
  std::string name;  // the name of the script's file, for messages
  std::vector<ScriptStep> steps;
};

// The description of all script commands, which `--help` prints.
extern const char* const kScriptHelp;

// Parses the text of a viewer script. Throws InputError, `NAME:LINE: error: ...`, for the first line that is
// not an action.
Script ParseScript(const std::string& name, const std::string& text);
// Reads and parses a script file. Throws InputError if the file cannot be read or is not a viewer script.
Script ReadScript(const std::string& path);

// The functions of the window that a ScriptPlayer needs.
class ScriptStage {
 public:
  virtual ~ScriptStage() = default;
  virtual void Input(const InputEvent& event) = 0;
  virtual void Resize(int width, int height) = 0;
  // Writes the next complete frame to a file. Throws InputError if the file cannot be written.
  virtual void Screenshot(const std::string& path) = 0;
};

class ScriptPlayer {
 public:
  explicit ScriptPlayer(Script script) : script_(std::move(script)) {}

  // Runs the script's steps for one frame. Returns false when the script is finished. Throws InputError with
  // file and line of the script if a step fails.
  bool Advance(Viewer& viewer, ScriptStage& stage, double seconds);

 private:
  bool WaitIsOver(Viewer& viewer, const ScriptStep& step, double seconds);

  Script script_;
  std::size_t next_ = 0;
  double waited_frames_ = 0, waited_seconds_ = 0;
};

inline constexpr double kLongestWait = 900;  // time after which the script line `wait idle` fails [s]

}  // namespace penumbra::viewer
