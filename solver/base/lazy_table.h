// solver/base/lazy_table.h
//
// A table whose entries are computed when they are first asked for.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra {

// Entries have numbers from 0. Forgetting all of them takes the same short time however many there are.
template <class T>
class LazyTable {
 public:
  // Forgets all entries. Numbers are below `count` from here on.
  void Begin(std::size_t count) {
    if (stamp_.size() < count) {
      stamp_.resize(count, 0);
      value_.resize(count);
    }
    Clear();
  }

  // Forgets all entries.
  void Clear() {
    if (++now_ == 0) {
      std::fill(stamp_.begin(), stamp_.end(), 0U);
      now_ = 1;
    }
  }

  // The entry, and whether the caller must compute it now: it was not asked for since all were forgotten.
  std::pair<T&, bool> operator[](std::int32_t number) {
    const auto i = static_cast<std::size_t>(number);
    const bool is_new = stamp_[i] != now_;
    stamp_[i] = now_;
    return {value_[i], is_new};
  }

 private:
  std::vector<std::uint32_t> stamp_;  // of an entry: now_ when it was asked for last
  std::vector<T> value_;
  std::uint32_t now_ = 0;
};

}  // namespace penumbra
