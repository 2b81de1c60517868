// apps/points_csv.h

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// A point at which irradiance is measured, as the user gave it.
struct ProbePoint {
  Vec3 position = Vec3::Zero();  // [m]
  Vec3 normal = Vec3::Zero();    // any length
};

// The points of a CSV file with the header x,y,z,nx,ny,nz. Blanks around values, blank lines, and the line
// ends of all operating systems are accepted. Throws InputError, "FILE:LINE: error: …", or "FILE: error: …"
// if the file cannot be read.
std::vector<ProbePoint> ReadPointsCsv(const std::string& path);

// Reads points from a text instead of a file. In messages, `path` is the name of the text.
std::vector<ProbePoint> ReadPointsText(std::string_view text, const std::string& path);

}  // namespace penumbra
