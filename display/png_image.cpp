#include "display/png_image.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

#include "solver/base/check.h"
#include "solver/base/whole_file.h"

namespace penumbra {
namespace {

// Empty if the picture could not be encoded.
std::string PngBytes(const Srgb8Image& image) {
  PENUMBRA_CHECK(image.width > 0 && image.height > 0);
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  const int done = stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.pixels.data(),
                                          3 * image.width);
  return done ? bytes : "";
}

class PngImage final : public ImageWriter {
 public:
  using ImageWriter::Bytes;
  bool IsLinear() const override { return false; }
  std::string Bytes(const Srgb8Image& image) const override {
    std::string bytes = PngBytes(image);
    if (bytes.empty())
      throw InputError("the image could not be encoded as PNG: ask for a smaller one, or for .exr");
    return bytes;
  }
};

}  // namespace

void WritePng(const std::string& path, const Srgb8Image& image) {
  const std::string bytes = PngBytes(image);
  if (bytes.empty()) FailToWrite(path, "the image could not be encoded");
  WriteWholeFile(path, bytes);
}

ImageWriterRegistry::Method PngImageMethod() {
  return {
      "png", "8-bit sRGB, exposed, emitters white", {}, [] { return std::make_unique<const PngImage>(); }};
}

}  // namespace penumbra
