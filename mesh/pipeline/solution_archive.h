// mesh/pipeline/solution_archive.h
//
// Converts the solver's data structures to the arrays of a solution file, and back. In a solution file, a
// vector of structs is a table: each struct is a row, and each member is a column, which is stored as one
// array. The same description of a table is used for writing and for reading.

#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/interpolants/quadratic_interpolant.h"
#include "mesh/pipeline/hdf5_image.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// Packed describes how one value is stored in a row of an array: as kCount numbers of type Scalar, arranged
// in the shape Shape().
template <class Value>
struct Packed {
  static_assert(std::is_arithmetic_v<Value>);
  using Scalar = Value;
  static constexpr std::size_t kCount = 1;
  static ArrayShape Shape() { return {}; }
  static void Pack(const Value& value, Scalar* out) { *out = value; }
  static void Unpack(const Scalar* in, Value& value) { value = *in; }
};

// Stores each value in one byte. Values stored in one byte must be less than kLimit.
template <class Value, std::uint8_t kLimit>
struct PackedByte {
  using Scalar = std::uint8_t;
  static constexpr std::size_t kCount = 1;
  static ArrayShape Shape() { return {}; }
  static void Pack(const Value& value, Scalar* out) { *out = static_cast<Scalar>(value); }
  static void Unpack(const Scalar* in, Value& value) {
    if (*in >= kLimit) throw Hdf5Error("a value is none of its kind");
    value = static_cast<Value>(*in);
  }
};
template <>
struct Packed<bool> : PackedByte<bool, 2> {};
template <>
struct Packed<Visibility> : PackedByte<Visibility, 2> {};
template <>
struct Packed<DiscontinuityKind> : PackedByte<DiscontinuityKind, 6> {};
template <>
struct Packed<DiscontinuityDegree> : PackedByte<DiscontinuityDegree, 3> {};
template <>
struct Packed<MeshKind> : PackedByte<MeshKind, 4> {};
template <>
struct Packed<char> : PackedByte<char, 255> {
  static void Unpack(const Scalar* in, char& value) { std::memcpy(&value, in, 1); }
};

// Stores a vector as its coordinates or channels.
template <class Vector>
struct PackedVector {
  using Scalar = double;
  static constexpr std::size_t kCount = Vector::SizeAtCompileTime;
  static ArrayShape Shape() { return {kCount}; }
  static void Pack(const Vector& value, Scalar* out) { std::copy_n(value.data(), kCount, out); }
  static void Unpack(const Scalar* in, Vector& value) { std::copy_n(in, kCount, value.data()); }
};
template <>
struct Packed<Vec2> : PackedVector<Vec2> {};
template <>
struct Packed<Vec3> : PackedVector<Vec3> {};
template <>
struct Packed<Rgb> : PackedVector<Rgb> {};

template <>
struct Packed<LatticePoint> {
  using Scalar = std::int32_t;
  static constexpr std::size_t kCount = 2;
  static ArrayShape Shape() { return {kCount}; }
  static void Pack(const LatticePoint& value, Scalar* out) {
    out[0] = value.x;
    out[1] = value.y;
  }
  static void Unpack(const Scalar* in, LatticePoint& value) { value = {in[0], in[1]}; }
};

template <class Part, std::size_t kParts>
struct Packed<std::array<Part, kParts>> {
  using Scalar = typename Packed<Part>::Scalar;
  static constexpr std::size_t kCount = kParts * Packed<Part>::kCount;
  static ArrayShape Shape() {
    ArrayShape shape = Packed<Part>::Shape();
    shape.insert(shape.begin(), kParts);
    return shape;
  }
  static void Pack(const std::array<Part, kParts>& value, Scalar* out) {
    for (std::size_t i = 0; i < kParts; ++i) Packed<Part>::Pack(value[i], out + i * Packed<Part>::kCount);
  }
  static void Unpack(const Scalar* in, std::array<Part, kParts>& value) {
    for (std::size_t i = 0; i < kParts; ++i) Packed<Part>::Unpack(in + i * Packed<Part>::kCount, value[i]);
  }
};

// Stores the coefficients of a quadratic interpolant in the order a, b2, c2, d, e2, f, each with three
// channels.
template <>
struct Packed<QuadraticInterpolant> {
  using Six = std::array<Rgb, 6>;
  using Scalar = double;
  static constexpr std::size_t kCount = Packed<Six>::kCount;
  static ArrayShape Shape() { return Packed<Six>::Shape(); }
  static void Pack(const QuadraticInterpolant& q, Scalar* out) {
    Packed<Six>::Pack({q.a, q.b2, q.c2, q.d, q.e2, q.f}, out);
  }
  static void Unpack(const Scalar* in, QuadraticInterpolant& q) {
    Six six;
    Packed<Six>::Unpack(in, six);
    q = {six[0], six[1], six[2], six[3], six[4], six[5]};
  }
};

template <class Value>
ArrayShape ShapeOfRows(std::size_t rows) {
  ArrayShape shape = Packed<Value>::Shape();
  shape.insert(shape.begin(), rows);
  return shape;
}

// ArchiveWriter writes tables to a solution file. ArchiveReader has the same functions as ArchiveWriter.
class ArchiveWriter {
 public:
  explicit ArchiveWriter(Hdf5Writer* file) : file_(file) {}

  // CountRows() does nothing in the writer, because only the reader needs the number of rows.
  template <class Row>
  void CountRows(const std::string&, const std::vector<Row>&, std::size_t = 0) {}

  // Writes one column of a table: the values access(row) of all rows.
  template <class Row, class Access>
  void Column(const std::string& path, const std::vector<Row>& rows, const Access& access) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Access, const Row&>>;
    using Scalar = typename Packed<Value>::Scalar;
    std::vector<Scalar> values(rows.size() * Packed<Value>::kCount);
    for (std::size_t i = 0; i < rows.size(); ++i)
      Packed<Value>::Pack(std::invoke(access, rows[i]), values.data() + i * Packed<Value>::kCount);
    file_->Write(path, ScalarTypeOf<Scalar>::value, ShapeOfRows<Value>(rows.size()), values.data());
  }

  // Writes a column whose values are lists. One array holds the lists access(row) of all rows of the table
  // one after another. The array PATH_first holds the index at which the list of each row starts, and the
  // index at which the last list ends.
  template <class Row, class Access>
  void Lists(const std::string& path, const std::vector<Row>& rows, const Access& access) {
    using Value = typename std::remove_cvref_t<std::invoke_result_t<Access, const Row&>>::value_type;
    std::vector<Value> all;
    std::vector<std::uint64_t> first = {0};
    for (const Row& row : rows) {
      const auto& list = std::invoke(access, row);
      all.insert(all.end(), list.begin(), list.end());
      first.push_back(all.size());
    }
    Column(path + "_first", first, std::identity());
    Column(path, all, std::identity());
  }

  void Text(const std::string& path, const std::string& text) { file_->WriteText(path, text); }

 private:
  Hdf5Writer* file_;
};

class ArchiveReader {
 public:
  explicit ArchiveReader(const Hdf5Reader* file) : file_(file) {}

  // Resizes `rows` to n - more elements, where n is the number of rows of the array at `path`.
  template <class Row>
  void CountRows(const std::string& path, std::vector<Row>& rows, std::size_t more = 0) {
    const ArrayShape shape = file_->Shape(path);
    if (shape.empty() || shape[0] < more) throw Hdf5Error(path + " has no rows");
    rows.resize(shape[0] - more);
  }

  template <class Row, class Access>
  void Column(const std::string& path, std::vector<Row>& rows, const Access& access) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Access, Row&>>;
    using Scalar = typename Packed<Value>::Scalar;
    std::vector<Scalar> values(rows.size() * Packed<Value>::kCount);
    file_->Read(path, ScalarTypeOf<Scalar>::value, ShapeOfRows<Value>(rows.size()), values.data());
    for (std::size_t i = 0; i < rows.size(); ++i)
      Packed<Value>::Unpack(values.data() + i * Packed<Value>::kCount, std::invoke(access, rows[i]));
  }

  template <class Row, class Access>
  void Lists(const std::string& path, std::vector<Row>& rows, const Access& access) {
    using Value = typename std::remove_cvref_t<std::invoke_result_t<Access, Row&>>::value_type;
    std::vector<std::uint64_t> first(rows.size() + 1);
    Column(path + "_first", first, std::identity());
    std::vector<Value> all;
    CountRows(path, all);
    Column(path, all, std::identity());
    if (first.front() != 0 || first.back() != all.size() || !std::is_sorted(first.begin(), first.end()))
      throw Hdf5Error(path + "_first does not divide " + path);
    const auto at = [&](std::uint64_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    for (std::size_t i = 0; i < rows.size(); ++i)
      std::invoke(access, rows[i]).assign(at(first[i]), at(first[i + 1]));
  }

  void Text(const std::string& path, std::string& text) { text = file_->ReadText(path); }

 private:
  const Hdf5Reader* file_;
};

// Table reads or writes the columns of one table, whose paths begin with a common path. The first column of
// the table determines the number of rows.
template <class Archive, class Rows>
class Table {
 public:
  Table(Archive& archive, std::string path, Rows& rows)
      : archive_(archive), path_(std::move(path)), rows_(rows) {}

  template <class Access>
  Table& Column(const std::string& name, const Access& access) {
    if (!std::exchange(counted_, true)) archive_.CountRows(path_ + "/" + name, rows_);
    archive_.Column(path_ + "/" + name, rows_, access);
    return *this;
  }
  template <class Access>
  Table& Lists(const std::string& name, const Access& access) {
    if (!std::exchange(counted_, true)) archive_.CountRows(path_ + "/" + name + "_first", rows_, 1);
    archive_.Lists(path_ + "/" + name, rows_, access);
    return *this;
  }

 private:
  Archive& archive_;
  std::string path_;
  Rows& rows_;
  bool counted_ = false;
};

}  // namespace penumbra
