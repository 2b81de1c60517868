// display/image_io.h
//
// Pictures as files. A file is written beside its place and renamed, so that a killed run leaves the old one
// whole; the same pixels give the same bytes.

#pragma once

#include <string>

#include "display/image.h"

namespace penumbra {

// 8-bit sRGB PNG. Throws InputError if the file cannot be written; nothing is left behind then.
void WritePng(const std::string& path, const Srgb8Image& image);

// Linear RGB EXR, 32-bit floats, ZIP-compressed without loss. Errors as WritePng.
void WriteExr(const std::string& path, const RgbImage& image);

// The channels R, G and B of an EXR file of any pixel type; a channel that is missing is 0.
// Throws InputError if the file cannot be read.
RgbImage ReadExr(const std::string& path);

}  // namespace penumbra
