#include "display/image_writers.h"

#include "display/exr_image.h"
#include "display/png_image.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/whole_file.h"

namespace penumbra {
namespace {

// Null if no format has the ending.
std::unique_ptr<const ImageWriter> WriterFor(const std::string& path) {
  const ImageWriterRegistry::Method* format = FindByEnding(ImageWriters(), path);
  return format ? format->make() : nullptr;
}

void WriteAs(const std::string& path, const auto& image) {
  const std::unique_ptr<const ImageWriter> writer = WriterFor(path);
  PENUMBRA_CHECK(writer != nullptr);
  WriteWholeFile(path, writer->Bytes(image));
}

}  // namespace

ImageWriterRegistry& ImageWriters() {
  static ImageWriterRegistry registry("image writer", {PngImageMethod(), ExrImageMethod()});
  return registry;
}

bool IsLinearImage(const std::string& path) {
  const std::unique_ptr<const ImageWriter> writer = WriterFor(path);
  return writer && writer->IsLinear();
}

bool IsScreenImage(const std::string& path) {
  const std::unique_ptr<const ImageWriter> writer = WriterFor(path);
  return writer && !writer->IsLinear();
}

std::vector<std::string> ScreenImageEndings() {
  std::vector<std::string> endings;
  for (const ImageWriterRegistry::Method& format : ImageWriters().methods())
    if (!format.make()->IsLinear()) endings.push_back(format.name);
  return endings;
}

void WriteImageFile(const std::string& path, const Srgb8Image& image) { WriteAs(path, image); }
void WriteImageFile(const std::string& path, const RgbImage& image) { WriteAs(path, image); }

}  // namespace penumbra
