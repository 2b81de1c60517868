// display/viewer/window.h

#pragma once

#include <optional>

#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Shows the viewer in a window until the user, or the script, ends it. What is remembered from the last time
// is read from and written to `files`, if it is not null. With a script the window hears nothing else, and
// time runs by kScriptFrame a frame.
// Throws InputError if no window can be opened, and what a script throws.
void RunWindow(Viewer& viewer, const Script* script, const UserFiles* files);
inline constexpr double kScriptFrame = 1.0 / 60;  // seconds

}  // namespace penumbra::viewer
