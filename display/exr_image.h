// display/exr_image.h

#pragma once

#include <string>

#include "display/image_writer.h"

namespace penumbra {

// Writes an EXR file with linear RGB values as 32-bit floats, ZIP-compressed without loss. WriteExr() writes
// a temporary file in the same folder and renames the temporary file, so that an interrupted program leaves
// an old file intact. Pictures with equal pixels give EXR files with equal bytes. WriteExr() throws
// InputError, and leaves no file behind, if the file cannot be written.
void WriteExr(const std::string& path, const RgbImage& image);

// Reads the channels R, G and B of an EXR file of any pixel type. Throws InputError if the file cannot be
// read or lacks one of the channels R, G and B.
RgbImage ReadExr(const std::string& path);

ImageWriterRegistry::Method ExrImageMethod();

}  // namespace penumbra
