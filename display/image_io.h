// display/image_io.h
//
// Reads and writes picture files. Files are written under a temporary name and then renamed, so that a killed
// program leaves the old file intact. The same pixels give the same bytes.

#pragma once

#include <string>

#include "display/image.h"

namespace penumbra {

// Writes an 8-bit sRGB PNG file. If the file cannot be written, throws InputError and leaves no file behind.
void WritePng(const std::string& path, const Srgb8Image& image);

// Writes a linear RGB EXR file: 32-bit floats with lossless ZIP compression. Errors as WritePng().
void WriteExr(const std::string& path, const RgbImage& image);

// The channels R, G and B of an EXR file of any pixel type; a channel that is missing is 0.
// Throws InputError if the file cannot be read.
RgbImage ReadExr(const std::string& path);

}  // namespace penumbra
