// apps/points_csv.h

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// A point that the user gave, at which irradiance is measured.
struct ProbePoint {
  Vec3 position = Vec3::Zero();  // the position of the probed point [m]
  Vec3 normal = Vec3::Zero();    // normal of any length; zero if the normal was left out
  bool has_normal = true;        // false if the normal was left out
  int line = 0;                  // the number of the point's line in the file, from 1
};

// If the path of the file of points is "-", the points are read from standard input.
inline constexpr const char* kPointsFromInput = "-";
// The name of the file of points in messages: the path, or words for standard input.
std::string NameOfPoints(const std::string& path);

// Reads the points of a CSV file with the header x,y,z,nx,ny,nz, or with the header x,y,z for points without
// normals. Reads standard input if the path is kPointsFromInput. A row of the CSV file without a normal ends
// after z or has three empty fields. Blanks around values, blank lines, and the line ends of all operating
// systems are accepted. Throws InputError with the message "FILE:LINE: error: …", or "FILE: error: …" if the
// file cannot be read.
std::vector<ProbePoint> ReadPointsCsv(const std::string& path);

// Reads points from a text in the CSV format instead of a file. `path` is the name of the text in messages.
std::vector<ProbePoint> ReadPointsText(std::string_view text, const std::string& path);

}  // namespace penumbra
