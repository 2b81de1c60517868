#include "display/exr_image.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <vector>

#include "solver/base/check.h"
#include "solver/base/whole_file.h"

namespace penumbra {
namespace {

constexpr const char* kChannelNames[3] = {"R", "G", "B"};

// A file in memory: OpenEXR's own does not tell when a disk is full.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const std::size_t end = at_ + static_cast<std::size_t>(n);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy_n(c, n, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
  std::size_t at_ = 0;
};

// A slice over one plane of the image.
Imf::Slice PlaneSlice(const float* plane, int x_min, int y_min, int width) {
  // OpenEXR addresses pixels by their place in the data window and takes a pointer to non-const for reading,
  // too.
  char* base = const_cast<char*>(reinterpret_cast<const char*>(plane));
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y_min) * width + x_min;
  return {Imf::FLOAT, base - first * static_cast<std::ptrdiff_t>(sizeof(float)), sizeof(float),
          sizeof(float) * static_cast<std::size_t>(width)};
}

std::string ExrBytes(const RgbImage& image) {
  PENUMBRA_CHECK(image.width > 0 && image.height > 0);
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(kChannelNames[c], Imf::Channel(Imf::FLOAT));
    frame.insert(kChannelNames[c], PlaneSlice(image.channel[c].data(), 0, 0, image.width));
  }
  MemoryStream memory;
  {
    Imf::OutputFile file(memory, header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }  // the table of lines is written at the end
  return {memory.bytes().data(), memory.bytes().size()};
}

class ExrImage final : public ImageWriter {
 public:
  using ImageWriter::Bytes;
  bool IsLinear() const override { return true; }
  std::string Bytes(const RgbImage& image) const override { return ExrBytes(image); }
};

}  // namespace

void WriteExr(const std::string& path, const RgbImage& image) { WriteWholeFile(path, ExrBytes(image)); }

RgbImage ReadExr(const std::string& path) {
  try {
    Imf::InputFile file(path.c_str());
    for (const char* name : kChannelNames)
      if (!file.header().channels().findChannel(name))
        throw std::runtime_error(fmt::format("it has no channel {}", name));
    const auto window = file.header().dataWindow();
    RgbImage image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c)
      frame.insert(kChannelNames[c],
                   PlaneSlice(image.channel[c].data(), window.min.x, window.min.y, image.width));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const std::exception& error) {
    throw InputError(
        fmt::format("{}: error: cannot read the image: {}; give an EXR file with the channels R, G and B",
                    path, error.what()));
  }
}

ImageWriterRegistry::Method ExrImageMethod() {
  return {"exr", "linear radiosity in W/m^2, unexposed, emittance included", {}, [] {
            return std::make_unique<const ExrImage>();
          }};
}

}  // namespace penumbra
