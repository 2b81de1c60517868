// solver/transport/points/hidden_luminaires.h
//
// Estimates by a few rays which luminaires are invisible from the surfaces in a region of space. In a
// building, most lamps are behind walls. A point needs few shadow rays to lamps that no neighbouring point
// sees.

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
  // A set of luminaires: one bit for each luminaire.
  using Bits = std::span<const std::uint64_t>;
  // A function that sets, in `hidden`, the bits of those luminaires that none of the points sees.
  using Test = std::function<void(std::span<const ReceiverPoint> points, std::span<std::uint64_t> hidden)>;

  // Makes a HiddenLuminaires that treats no luminaire as hidden.
  HiddenLuminaires() = default;
  // A region holds the points in a cube of the given side [m] whose normals have the same main direction.
  // `test` is called for some points of each region, from several threads. `points` lie on surfaces of the
  // scene, with many points in each region.
  HiddenLuminaires(std::span<const ReceiverPoint> points, double side, std::size_t luminaires,
                   const Test& test);

  // The luminaires that are invisible from the region around the point; empty if the region contained none of
  // the constructor's points.
  Bits At(const ReceiverPoint& at) const;
  static bool Has(Bits hidden, std::size_t luminaire) {
    return !hidden.empty() && (hidden[luminaire / 64] >> (luminaire % 64) & 1) != 0;
  }

 private:
  using Key = std::array<std::int32_t, 4>;  // a region's cube, and the main direction of its normals
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };

  Key KeyOf(const ReceiverPoint& at) const;

  double side_ = 0;        // side of the cube of a region [m]
  std::size_t words_ = 0;  // number of 64-bit words for the bits of one region
  std::unordered_map<Key, std::uint32_t, Hash> regions_;
  std::vector<std::uint64_t> hidden_;  // the bits of all regions, words_ words for each region
};

}  // namespace penumbra
