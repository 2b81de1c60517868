// apps/camera_path.h
//
// Camera paths for `penumbra render --path`: a file with one camera a line, and the names of the pictures.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Reads the cameras of the file `path`. Each line holds two to four words: the eye and the look-at point
// [m], the up direction, and the vertical field of view [degrees], where a point or a direction is x,y,z
// without blanks. `otherwise` has the up direction and the field of view of lines that omit them. Blank lines
// and lines that begin with # are skipped. Throws InputError with the message "FILE:LINE: error: what is
// wrong and how to mend it", also if the file has no camera.
std::vector<Camera> ReadCameraPath(const std::string& path, const Camera& otherwise);

// Reads the cameras from a text instead of a file. `path` is the name of the text in messages.
std::vector<Camera> ReadCameraText(std::string_view text, const std::string& path, const Camera& otherwise);

// The name of picture `index`, counted from 0, of `count` pictures: "walk.png" becomes "walk-0007.png". The
// number has as many digits as the largest number, and at least four.
std::string FramePath(const std::string& output, std::size_t index, std::size_t count);

}  // namespace penumbra
