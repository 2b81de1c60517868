// display/viewer/window.h

#pragma once

#include <optional>

#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"

namespace penumbra::viewer {

// Shows the viewer in a window until the user or the script ends it. If `files` is not null, the window
// restores its state from `files` at the start, and saves it there. With a script, the window ignores user
// input, and each frame takes kScriptFrame of time. Text and panels are `scale` times as large as on an
// unscaled screen; without a value, the monitor's factor applies, or 1 with a script. Throws InputError if no
// window can be opened; passes on the exceptions of a script.
void RunWindow(Viewer& viewer, const Script* script, const UserFiles* files,
               std::optional<double> scale = std::nullopt);
inline constexpr double kScriptFrame = 1.0 / 60;  // seconds

}  // namespace penumbra::viewer
