// solver/scene/written_digits.h
//
// Looks at the digits of the coordinates in a text file and infers the unit to which the coordinates were
// rounded. Points that differ by no more than the inferred unit count as the same.

#pragma once

#include <map>
#include <string_view>

#include "solver/geometry/vec.h"

namespace penumbra {

class WrittenDigits {
 public:
  // Adds a coordinate of axis 0, 1 or 2: the written word and its value. REQUIRES: `word` is a finite number
  // with the value `value`.
  void Add(int axis, std::string_view word, double value);

  // Per axis, the unit to which the largest coordinates are rounded [m]; zero if there are no coordinates.
  // Three kinds of writers are recognised: with a fixed number of decimals; with a fixed number of
  // significant digits, six or more, as "%g" writes; and with single precision numbers.
  Vec3 Step() const;

 private:
  std::map<int, int> with_decimals_, with_digits_;  // number of coordinates by number of digits
  Vec3 largest_ = Vec3::Zero();                     // largest absolute value per axis
  bool single_ = true;  // all coordinates are single precision numbers, to their digits
};

}  // namespace penumbra
