// mesh/pipeline/hdf5_image.h
//
// HDF5 files as bytes in memory, which contain typed arrays at paths such as "mesh/positions". Equal arrays,
// written in the same order, give HDF5 files with equal bytes. An HDF5 file that Hdf5Writer makes contains no
// times and no file names. Several threads may read and write HDF5 files at once if each thread uses its own
// Hdf5Reader or Hdf5Writer.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// The exception for a file image that the HDF5 library cannot read; what() returns the library's message.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The types of array elements, which are little-endian in the file.
enum class ScalarType : std::uint8_t { kUint8, kInt32, kUint32, kUint64, kFloat, kDouble };

template <class T>
struct ScalarTypeOf;
template <>
struct ScalarTypeOf<std::uint8_t> {
  static constexpr ScalarType value = ScalarType::kUint8;
};
template <>
struct ScalarTypeOf<std::int32_t> {
  static constexpr ScalarType value = ScalarType::kInt32;
};
template <>
struct ScalarTypeOf<std::uint32_t> {
  static constexpr ScalarType value = ScalarType::kUint32;
};
template <>
struct ScalarTypeOf<std::uint64_t> {
  static constexpr ScalarType value = ScalarType::kUint64;
};
template <>
struct ScalarTypeOf<float> {
  static constexpr ScalarType value = ScalarType::kFloat;
};
template <>
struct ScalarTypeOf<double> {
  static constexpr ScalarType value = ScalarType::kDouble;
};

using ArrayShape = std::vector<std::size_t>;  // lengths of an array's dimensions, the outermost first

class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Writes a typed array in row-major order. Large arrays are compressed without loss.
  void Write(const std::string& path, ScalarType type, const ArrayShape& shape, const void* data);
  // Writes a UTF-8 text, which must not end with zero bytes.
  void WriteText(const std::string& path, const std::string& text);
  // Writes a list of UTF-8 texts of any length, each followed by a zero byte, as h5py writes a list of str.
  // Invalid UTF-8 in a text is written unchanged.
  void WriteStrings(const std::string& path, const std::vector<std::string>& texts);
  // Writes a UTF-8 text as an attribute of the array or group at `path`. The HDF5 path "/" stands for the
  // file itself.
  void WriteAttribute(const std::string& path, const std::string& name, const std::string& text);
  // Returns the bytes of the complete HDF5 file. Nothing may be written after Finish().
  std::string Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All functions of Hdf5Reader throw Hdf5Error if the file image does not contain the requested array or text.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string_view image);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  ArrayShape Shape(const std::string& path) const;
  // Reads the array at `path` into `data`. The array in the file must have exactly the given type and shape.
  void Read(const std::string& path, ScalarType type, const ArrayShape& shape, void* data) const;
  std::string ReadText(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
