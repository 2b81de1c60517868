// solver/transport/points/hidden_luminaires.h
//
// Which luminaires the surfaces in a region of space do not see, as far as a few rays tell. In a building,
// most lamps are behind walls. Points need few rays to lamps that their neighbours do not see.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

class HiddenLuminaires {
 public:
  // A set of luminaires, one bit for each.
  using Bits = std::span<const std::uint64_t>;
  // Sets the bits of the luminaires that none of the points sees.
  using Test = std::function<void(std::span<const ReceiverPoint> points, std::span<std::uint64_t> hidden)>;

  // Nothing is known to be hidden.
  HiddenLuminaires() = default;
  // A region holds the points in a cube of the given side [m] whose normals have the same main direction.
  // `test` is called for some points of each region, from any thread. The points are on surfaces of the
  // scene, many in each region.
  HiddenLuminaires(std::span<const ReceiverPoint> points, double side, std::size_t luminaires,
                   const Test& test);

  // The luminaires that the region of the point does not see; empty if nothing is known.
  Bits At(const ReceiverPoint& at) const;
  static bool Has(Bits hidden, std::size_t luminaire) {
    return !hidden.empty() && (hidden[luminaire / 64] >> (luminaire % 64) & 1) != 0;
  }

 private:
  using Key = std::array<std::int32_t, 4>;  // the cube, and the main direction of normals
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  Key KeyOf(const ReceiverPoint& at) const;

  double side_ = 0;        // [m]
  std::size_t words_ = 0;  // of the bits of a region
  std::unordered_map<Key, std::uint32_t, Hash> regions_;
  std::vector<std::uint64_t> hidden_;  // words_ for each region
};

}  // namespace penumbra
