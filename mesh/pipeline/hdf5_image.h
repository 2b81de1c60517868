// mesh/pipeline/hdf5_image.h
//
// HDF5 files as bytes in memory: typed arrays at paths such as "mesh/positions". Equal arrays, written in the
// same order, give equal bytes; a file contains no times and no file names. Several threads may read and
// write at once if each thread uses its own reader or writer.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// The error that the HDF5 library cannot read an image; what() is the library's message.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The types of array elements; little-endian in the file.
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

using ArrayShape = std::vector<std::size_t>;  // outermost dimension first

class Hdf5Writer {
 public:
  Hdf5Writer();
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Writes an array in row-major order. Large arrays are compressed without loss.
  void Write(const std::string& path, ScalarType type, const ArrayShape& shape, const void* data);
  // Writes a UTF-8 text, which must not end with zero bytes.
  void WriteText(const std::string& path, const std::string& text);
  // Writes a list of UTF-8 texts of any length, as h5py writes a list of str: bytes that end with a zero
  // byte. Invalid UTF-8 is kept as it is.
  void WriteStrings(const std::string& path, const std::vector<std::string>& texts);
  // Writes a text of this kind as an attribute of an array or a group. "/" is the file itself.
  void WriteAttribute(const std::string& path, const std::string& name, const std::string& text);
  // Returns the complete file. Nothing may be written after this call.
  std::string Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All functions throw Hdf5Error if the image does not contain the requested array or text.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string_view image);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  ArrayShape Shape(const std::string& path) const;
  // Reads the array. The array must have exactly this type and shape.
  void Read(const std::string& path, ScalarType type, const ArrayShape& shape, void* data) const;
  std::string ReadText(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
