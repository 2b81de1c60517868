// display/png_image.h

#pragma once

#include <string>

#include "display/image_writer.h"

namespace penumbra {

// Writes a PNG file in 8-bit sRGB. The function writes a temporary file in the same folder and renames it, so
// that an interrupted program leaves the old file intact. Equal pixels give equal bytes. Throws InputError,
// and leaves no file behind, if the file cannot be written.
void WritePng(const std::string& path, const Srgb8Image& image);

ImageWriterRegistry::Method PngImageMethod();

}  // namespace penumbra
