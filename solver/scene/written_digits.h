// solver/scene/written_digits.h
//
// Infers from the digits of the coordinates in a text file the unit to which the coordinates were rounded.
// Points that differ by no more than the unit to which coordinates were rounded count as equal.

#pragma once

#include <map>
#include <string_view>

#include "solver/geometry/vec.h"

namespace penumbra {

class WrittenDigits {
 public:
  // Adds a coordinate along axis 0, 1 or 2, as the word in the file and as its value. REQUIRES: `word` is a
  // finite number with the value `value`.
  void Add(int axis, std::string_view word, double value);

  // Returns, for each axis, the unit to which the largest coordinates are rounded [m]; zero if no coordinates
  // were added. Three kinds of rounding are recognised: to a fixed number of decimals; to a fixed number of
  // significant digits, six or more, as by "%g"; and to single precision.
  Vec3 Step() const;

 private:
  // The number of coordinates in the file that were written with each number of digits.
  std::map<int, int> with_decimals_, with_digits_;
  Vec3 largest_ = Vec3::Zero();  // the largest absolute coordinate along each axis
  // true if all coordinates may be single precision numbers, written with rounded digits
  bool single_ = true;
};

}  // namespace penumbra
