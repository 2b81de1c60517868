// solver/base/bytes.h
//
// Writes values as bytes and reads them back, to pass values from one process to another on the same kind of
// machine.

#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace penumbra {

// Appends values to bytes. ByteReader has the same functions, so that one function that visits the members of
// a struct can both write and read the struct.
class ByteWriter {
 public:
  void Raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  // Writes the number of elements of a list, and returns the number.
  std::size_t Count(std::size_t count) {
    Raw(&count, sizeof count);
    return count;
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Takes values from bytes that a ByteWriter has written. Throws std::runtime_error if the bytes end early.
class ByteReader {
 public:
  // The bytes must outlive the ByteReader.
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  void Raw(void* data, std::size_t size) {
    if (size > rest_.size()) throw std::runtime_error("bytes from another process end early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  // Reads the number of elements of a list. Every element takes at least a byte, so that a false number does
  // not take much memory.
  std::size_t Count(std::size_t) {
    std::size_t count = 0;
    Raw(&count, sizeof count);
    if (count > rest_.size()) throw std::runtime_error("bytes from another process hold a false count");
    return count;
  }

 private:
  std::string_view rest_;
};

// Writes or reads a number, an enum, or a list of such values.
template <class Archive, class Value>
requires std::is_arithmetic_v<Value> || std::is_enum_v<Value>
void Transfer(Archive& archive, Value& value) { archive.Raw(&value, sizeof value); }
template <class Archive>
void Transfer(Archive& archive, std::string& text) {
  text.resize(archive.Count(text.size()));
  archive.Raw(text.data(), text.size());
}

}  // namespace penumbra
