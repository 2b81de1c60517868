// display/image_writers.h

#pragma once

#include <string>
#include <vector>

#include "display/image_writer.h"

namespace penumbra {

// The registry of all formats of pictures.
ImageWriterRegistry& ImageWriters();

// True if the path has the ending of a format for linear radiosity, or for screen colours.
bool IsLinearImage(const std::string& path);
bool IsScreenImage(const std::string& path);

// The endings of the formats for screen colours, without the dot.
std::vector<std::string> ScreenImageEndings();

// Writes the picture in the format for the path's ending. The function writes a temporary file beside the
// target and renames it, so that an interrupted run leaves the old file complete. Throws InputError if the
// file cannot be written; no file remains then. REQUIRES: IsScreenImage(path) for Srgb8Image,
// IsLinearImage(path) for RgbImage.
void WriteImageFile(const std::string& path, const Srgb8Image& image);
void WriteImageFile(const std::string& path, const RgbImage& image);

}  // namespace penumbra
