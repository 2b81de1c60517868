// display/image_writers.h

#pragma once

#include <string>
#include <vector>

#include "display/image_writer.h"

namespace penumbra {

// Every format that pictures are written in.
ImageWriterRegistry& ImageWriters();

// Whether the path has the ending of a format of linear radiosity, or of what a screen shows.
bool IsLinearImage(const std::string& path);
bool IsScreenImage(const std::string& path);

// The endings of the formats that hold what a screen shows, without the dot.
std::vector<std::string> ScreenImageEndings();

// Writes the picture in the format that the ending of the path names. A file is written beside its place and
// renamed, so that a killed run leaves the old one whole. Throws InputError if the file cannot be written;
// nothing is left behind then. REQUIRES: IsScreenImage(path), or for linear radiosity IsLinearImage(path).
void WriteImageFile(const std::string& path, const Srgb8Image& image);
void WriteImageFile(const std::string& path, const RgbImage& image);

}  // namespace penumbra
