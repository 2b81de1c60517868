// display/exr_image.h

#pragma once

#include <string>

#include "display/image_writer.h"

namespace penumbra {

// Linear RGB EXR, 32-bit floats, ZIP-compressed without loss. A file is written beside its place and renamed,
// so that a killed run leaves the old one whole; the same pixels give the same bytes. Throws InputError if
// the file cannot be written; nothing is left behind then.
void WriteExr(const std::string& path, const RgbImage& image);

// The channels R, G and B of an EXR file of any pixel type. Throws InputError if the file cannot be read or
// has not all three.
RgbImage ReadExr(const std::string& path);

ImageWriterRegistry::Method ExrImageMethod();

}  // namespace penumbra
