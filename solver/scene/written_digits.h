// solver/scene/written_digits.h
//
// How finely the coordinates of a text are written, from the digits themselves: what they cannot tell apart
// is the same place.

#pragma once

#include <map>
#include <string_view>

#include "solver/geometry/vec.h"

namespace penumbra {

class WrittenDigits {
 public:
  // A coordinate of axis 0, 1 or 2, as written and as read. REQUIRES: `word` is that finite number.
  void Add(int axis, std::string_view word, double value);

  // Per axis the unit in which its largest coordinates are written [m]: zero without any. The writer may have
  // kept so many decimals, so many significant digits (as "%g" does; then there are six or more), or numbers
  // of single precision.
  Vec3 Step() const;

 private:
  std::map<int, int> with_decimals_, with_digits_;  // how many coordinates have so many
  Vec3 largest_ = Vec3::Zero();                     // absolute value
  bool single_ = true;                              // all are numbers of single precision, to their digits
};

}  // namespace penumbra
