// solver/scene/transform_words.h
//
// Parses the options of MGF's statement `xf` and of Radiance's command `xform`, which describe
// transformations: -t x y z, -rx -ry -rz degrees, -s factor, -mx -my -mz, -i repeats, -a copies.

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
  double scale = 1;       // the factor by which the transformation scales lengths, equal along all axes, > 0
  bool mirrored = false;  // true if the matrix makes counter-clockwise polygons clockwise

  // The composition of two placements: `inner` is applied first, then this placement.
  Placement After(const Placement& inner) const;
};

// The largest number of copies that the options of one transformation may create.
inline constexpr std::size_t kMostCopies = 1'000'000;

// Returns the placements (affine transformations) that the option words describe: one placement, or, with -a,
// one for each copy. (The option -a N makes N copies, to which the options that follow are applied 0, 1, ...,
// N - 1 times; several -a make nested arrays.) `used` is set to the number of words that belong to the
// transformation, which ends before the first word that is no option. Throws InputError, whose message names
// the wrong word, without file name and line.
std::vector<Placement> ReadPlacements(std::span<const std::string_view> words, std::size_t& used);

}  // namespace penumbra
