// solver/base/kept.h
//
// Values by number, each made when it is first asked for and kept until the next beginning, which costs
// nothing.

#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace penumbra {

template <class T>
class Kept {
 public:
  // Forgets all. Numbers are below `count` from here on.
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

  // The value, and whether it must be made anew.
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
