// solver/geometry/vec_bytes.h
//
// Writes vectors as bytes, and reads vectors from bytes (ByteWriter, ByteReader).

#pragma once

#include <type_traits>
#include <vector>

#include "solver/base/bytes.h"
#include "solver/geometry/vec.h"

namespace penumbra {

template <class Archive>
void Transfer(Archive& archive, Vec2& v) {
  archive.Raw(v.data(), 2 * sizeof(double));
}
template <class Archive>
void Transfer(Archive& archive, Vec3& v) {
  archive.Raw(v.data(), 3 * sizeof(double));
}
template <class Archive>
void Transfer(Archive& archive, Rgb& colour) {
  archive.Raw(colour.data(), 3 * sizeof(double));
}

// Writes or reads a list of values that can be copied byte by byte.
template <class Archive, class Value>
void TransferPlain(Archive& archive, std::vector<Value>& list) {
  static_assert(std::is_trivially_copyable_v<Value>);
  list.resize(archive.Count(list.size()));
  archive.Raw(list.data(), list.size() * sizeof(Value));
}

}  // namespace penumbra
