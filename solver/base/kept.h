// solver/base/kept.h
//
// A table of values that are computed on first use. Begin() invalidates all values in constant time, except
// that it grows the table if needed.

#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra {

template <class T>
class Kept {
 public:
  // Invalidates all values. Until the next call, indices are below `count`.
  void Begin(std::size_t count) {
    if (stamp_.size() < count) {
      stamp_.resize(count, 0);
      value_.resize(count);
    }
    if (++now_ == 0) {
      std::fill(stamp_.begin(), stamp_.end(), 0U);
      now_ = 1;
    }
  }

  // The value with this index, and true if the caller must compute it. Counts as computed afterwards.
  std::pair<T&, bool> operator[](std::int32_t number) {
    const auto i = static_cast<std::size_t>(number);
    const bool is_new = stamp_[i] != now_;
    stamp_[i] = now_;
    return {value_[i], is_new};
  }

 private:
  std::vector<std::uint32_t> stamp_;
  std::vector<T> value_;
  std::uint32_t now_ = 0;
};

}  // namespace penumbra
