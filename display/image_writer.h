// display/image_writer.h
//
// The interface of writers of pictures. Each file format has its own writer.

#pragma once

#include <string>

#include "display/image.h"
#include "solver/base/registry.h"

namespace penumbra {

// A file format stores either screen colours or linear radiosity. The writer of a format overrides that
// function Bytes() whose parameter has the corresponding type.
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  virtual bool IsLinear() const = 0;

  // The contents of the file. Equal pixels give equal bytes. Throws InputError if the picture cannot be
  // encoded. REQUIRES: the picture has at least one pixel, and the format is not linear.
  virtual std::string Bytes(const Srgb8Image& image) const;
  // The contents of a file with linear values. REQUIRES: the picture has at least one pixel, and the format
  // is linear.
  virtual std::string Bytes(const RgbImage& image) const;
};

// The type of ImageWriters(). The name of a writer is the ending of its files, without the dot.
using ImageWriterRegistry = Registry<const ImageWriter>;

}  // namespace penumbra
