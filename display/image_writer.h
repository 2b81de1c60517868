// display/image_writer.h
//
// The interface of writers of pictures. Each picture format has its own writer.

#pragma once

#include <string>

#include "display/image.h"
#include "solver/base/registry.h"

namespace penumbra {

// The base class of writers of pictures. A picture format stores either screen colours or linear radiosity. A
// writer of screen colours overrides Bytes(Srgb8Image), a writer of linear radiosity Bytes(RgbImage).
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  virtual bool IsLinear() const = 0;

  // The contents of a picture file with screen colours. Pictures with equal pixels give files with equal
  // bytes. Throws InputError if the picture cannot be encoded. REQUIRES: the picture has at least one pixel,
  // and IsLinear() is false.
  virtual std::string Bytes(const Srgb8Image& image) const;
  // The contents of a picture file with linear radiosity. REQUIRES: the picture has at least one pixel, and
  // IsLinear() is true.
  virtual std::string Bytes(const RgbImage& image) const;
};

// The type of the registry ImageWriters(). The name of a picture writer in the registry is the ending of its
// files, without the dot.
using ImageWriterRegistry = Registry<const ImageWriter>;

}  // namespace penumbra
