#include "display/image_writer.h"

#include "solver/base/check.h"

namespace penumbra {

std::string ImageWriter::Bytes(const Srgb8Image& /*image*/) const {
  PENUMBRA_CHECK(!IsLinear());
  return "";
}

std::string ImageWriter::Bytes(const RgbImage& /*image*/) const {
  PENUMBRA_CHECK(IsLinear());
  return "";
}

}  // namespace penumbra
