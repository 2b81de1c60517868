// display/image_writers.h

#pragma once

#include <string>
#include <vector>

#include "display/image_writer.h"

namespace penumbra {

// The registry of all writers of pictures.
ImageWriterRegistry& ImageWriters();

// IsLinearImage() is true if the path has the ending of a format for linear radiosity. IsScreenImage() is
// true if the path has the ending of a format for screen colours.
bool IsLinearImage(const std::string& path);
bool IsScreenImage(const std::string& path);

// The file endings, without the dot, of the picture formats that store screen colours.
std::vector<std::string> ScreenImageEndings();

// Writes the picture in the file format that belongs to the path's ending. WriteImageFile() writes a
// temporary file in the same folder and renames the temporary file, so that an interrupted program leaves an
// old file intact. WriteImageFile() throws InputError, and leaves no file behind, if the file cannot be
// written. REQUIRES: IsScreenImage(path) for Srgb8Image, IsLinearImage(path) for RgbImage.
void WriteImageFile(const std::string& path, const Srgb8Image& image);
void WriteImageFile(const std::string& path, const RgbImage& image);

}  // namespace penumbra
