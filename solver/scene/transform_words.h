// solver/scene/transform_words.h
//
// The transformations of MGF's `xf` and Radiance's `xform`, in the words of their command lines: -t x y z,
// -rx -ry -rz degrees, -s factor, -mx -my -mz, -i repeats, -a copies.

#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct Placement {
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  double scale = 1;       // of lengths; the same along all axes, > 0
  bool mirrored = false;  // the matrix turns a counter-clockwise polygon clockwise

  // What `inner` does, then what this placement does.
  Placement After(const Placement& inner) const;
};

// The largest number of copies that one transformation may make.
inline constexpr std::size_t kMostCopies = 1'000'000;

// The placements that the words describe: one, or, with -a, one for each copy of the array. (-a N repeats
// what follows it 0, 1, ..., N - 1 times; another -a nests.) `used` is the number of words that belong to the
// transformation; the word behind them is none of its options. Throws InputError, whose text names the word
// that is wrong, without a file or a line.
std::vector<Placement> ReadPlacements(std::span<const std::string_view> words, std::size_t& used);

}  // namespace penumbra
