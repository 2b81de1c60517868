// solver/base/lazy_table.h
//
// A table whose entries are computed on the first request.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra {

// The entries of a LazyTable are numbered from 0. The time to remove all entries is short and does not depend
// on the number of entries.
template <class T>
class LazyTable {
 public:
  // Removes all entries, and permits requests for the entries 0 to count - 1.
  void Begin(std::size_t count) {
    if (stamp_.size() < count) {
      stamp_.resize(count, 0);
      value_.resize(count);
    }
    Clear();
  }

  // Removes all entries.
  void Clear() {
    if (++now_ == 0) {
      std::fill(stamp_.begin(), stamp_.end(), 0U);
      now_ = 1;
    }
  }

  // Returns the entry with the index `number`, and true if the caller must compute the entry's value. The
  // caller must compute the value of an entry at the first request for this entry after a call of Begin() or
  // Clear().
  std::pair<T&, bool> operator[](std::int32_t number) {
    const auto i = static_cast<std::size_t>(number);
    const bool is_new = stamp_[i] != now_;
    stamp_[i] = now_;
    return {value_[i], is_new};
  }

 private:
  // The entry stamp_[i] is the value of the counter now_ at the last request for entry i of the table.
  std::vector<std::uint32_t> stamp_;
  std::vector<T> value_;
  std::uint32_t now_ = 0;
};

}  // namespace penumbra
