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
  Vec3 normal = Vec3::Zero();    // any length; zero if it was left out
  bool has_normal = true;        // false if it was left out
  int line = 0;                  // of the file, from 1
};

// Given as the path of a file of points, this means standard input.
inline constexpr const char* kPointsFromInput = "-";
// The name of the file in messages: the path, or words for standard input.
std::string NameOfPoints(const std::string& path);

// The points of a CSV file with the header x,y,z,nx,ny,nz, or x,y,z without normals; of standard input if the
// path is kPointsFromInput. A row may leave the normal out by ending after z or by three empty fields. Blanks
// around values, blank lines, and the line ends of all operating systems are accepted. Throws InputError,
// "FILE:LINE: error: …", or "FILE: error: …" if the file cannot be read.
std::vector<ProbePoint> ReadPointsCsv(const std::string& path);

// Reads points from a text instead of a file. In messages, `path` is the name of the text.
std::vector<ProbePoint> ReadPointsText(std::string_view text, const std::string& path);

}  // namespace penumbra
