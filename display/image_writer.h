// display/image_writer.h
//
// Pictures as files: a writer for each format behind one interface.

#pragma once

#include <string>

#include "display/image.h"
#include "solver/base/registry.h"

namespace penumbra {

// A format holds what a screen shows, or linear radiosity. Its writer overrides the Bytes() of that.
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  virtual bool IsLinear() const = 0;

  // What the file holds; the same pixels give the same bytes. Throws InputError if that cannot be encoded.
  // REQUIRES: the picture has a pixel, and the format is not linear.
  virtual std::string Bytes(const Srgb8Image& image) const;
  // REQUIRES: the picture has a pixel, and the format is linear.
  virtual std::string Bytes(const RgbImage& image) const;
};

// ImageWriters() holds all writers. The name of each is the ending of its files.
using ImageWriterRegistry = Registry<const ImageWriter>;

}  // namespace penumbra
