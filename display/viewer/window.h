// display/viewer/window.h

#pragma once

#include <optional>

#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Shows the viewer in a window until the user closes the window or the script ends. If `files` is not null,
// the state of the window is restored from `files` at the start, and saved to `files` at the end. While a
// script runs, user input is ignored, and each frame counts as kScriptFrame seconds. The window enlarges text
// and panels by the factor `scale`. By default, `scale` is the factor that the monitor requests, or 1 if a
// script runs. RunWindow() throws InputError if no window can be opened, and passes on the exceptions of
// ScriptPlayer::Advance().
void RunWindow(Viewer& viewer, const Script* script, const UserFiles* files,
               std::optional<double> scale = std::nullopt);
inline constexpr double kScriptFrame = 1.0 / 60;  // time that a frame counts while a script runs [s]

}  // namespace penumbra::viewer
