// display/viewer/window.h

#pragma once

#include <optional>

#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Shows the viewer in a window until the user, or the script, ends it. What is remembered from the last time
// is read from and written to `files`, if it is not null. With a script the window hears nothing else, and
// time runs by kScriptFrame a frame. Text and panels are `scale` times as large as on a plain screen; by
// default as the monitor has it, with a script once.
// Throws InputError if no window can be opened, and what a script throws.
void RunWindow(Viewer& viewer, const Script* script, const UserFiles* files,
               std::optional<double> scale = std::nullopt);
inline constexpr double kScriptFrame = 1.0 / 60;  // seconds

}  // namespace penumbra::viewer
