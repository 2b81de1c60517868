// display/image_writer.h
//
// Writers of pictures: one interface for all formats.

#pragma once

#include <string>

#include "display/image.h"
#include "solver/base/registry.h"

namespace penumbra {

// A format stores either screen colours or linear radiosity. The format's writer overrides the matching
// Bytes().
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  virtual bool IsLinear() const = 0;

  // The contents of the file; the same pixels give the same bytes. Throws InputError if the picture cannot be
  // encoded. REQUIRES: the picture has at least one pixel, and the format is not linear.
  virtual std::string Bytes(const Srgb8Image& image) const;
  // As above. REQUIRES: the picture has at least one pixel, and the format is linear.
  virtual std::string Bytes(const RgbImage& image) const;
};

// The type of ImageWriters(). The name of each writer is the ending of its files.
using ImageWriterRegistry = Registry<const ImageWriter>;

}  // namespace penumbra
