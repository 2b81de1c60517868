// display/png_image.h

#pragma once

#include <string>

#include "display/image_writer.h"

namespace penumbra {

// Writes a PNG file in 8-bit sRGB. WritePng() writes a temporary file in the same folder and renames the
// temporary file, so that an interrupted program leaves an old file intact. Pictures with equal pixels give
// PNG files with equal bytes. WritePng() throws InputError, and leaves no file behind, if the file cannot be
// written.
void WritePng(const std::string& path, const Srgb8Image& image);

ImageWriterRegistry::Method PngImageMethod();

}  // namespace penumbra
