// mesh/pipeline/hdf5_image.h
//
// HDF5 files as bytes in memory: typed arrays under paths such as "mesh/positions". The same arrays, written
// in the same order, give the same bytes; nothing in them tells of time or place. Several threads may write
// and read at once, each its own file.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// What the library says against an image that it cannot read.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// What arrays hold; little-endian in the file.
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

  // An array in row-major order. Large ones are compressed without loss.
  void Write(const std::string& path, ScalarType type, const ArrayShape& shape, const void* data);
  // A text, UTF-8, without zero bytes at its end.
  void WriteText(const std::string& path, const std::string& text);
  // The whole file. Nothing may be written afterwards.
  std::string Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All functions throw Hdf5Error where the image does not hold what is asked for.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string_view image);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  ArrayShape Shape(const std::string& path) const;
  // The array, which must be of just this type and shape.
  void Read(const std::string& path, ScalarType type, const ArrayShape& shape, void* data) const;
  std::string ReadText(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
