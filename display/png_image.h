// display/png_image.h

#pragma once

#include <string>

#include "display/image_writer.h"

namespace penumbra {

// 8-bit sRGB PNG. A file is written beside its place and renamed, so that a killed run leaves the old one
// whole; the same pixels give the same bytes. Throws InputError if the file cannot be written; nothing is
// left behind then.
void WritePng(const std::string& path, const Srgb8Image& image);

ImageWriterRegistry::Method PngImageMethod();

}  // namespace penumbra
