#include "solver/transport/points/hidden_luminaires.h"

#include <algorithm>
#include <cmath>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// The most points of a region that look for luminaires.
constexpr std::size_t kLookers = 16;

}  // namespace

std::size_t HiddenLuminaires::Hash::operator()(const Key& key) const {
  std::uint64_t h = 0;
  for (const std::int32_t k : key) {
    h ^= static_cast<std::uint32_t>(k);
    h *= 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29;
  }
  return h;
}

HiddenLuminaires::Key HiddenLuminaires::KeyOf(const ReceiverPoint& at) const {
  Key key{};
  Eigen::Index axis = 0;
  at.normal.cwiseAbs().maxCoeff(&axis);
  for (int i = 0; i < 3; ++i)
    key[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(std::floor(at.position[i] / side_));
  key[3] = static_cast<std::int32_t>(2 * axis + (at.normal[axis] < 0 ? 1 : 0));
  return key;
}

HiddenLuminaires::HiddenLuminaires(std::span<const ReceiverPoint> points, double side, std::size_t luminaires,
                                   const Test& test)
    : side_(side), words_((luminaires + 63) / 64) {
  std::vector<std::vector<std::uint32_t>> members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [place, is_new] =
        regions_.try_emplace(KeyOf(points[i]), static_cast<std::uint32_t>(members.size()));
    if (is_new) members.emplace_back();
    members[place->second].push_back(static_cast<std::uint32_t>(i));
  }
  hidden_.assign(words_ * members.size(), 0);
  ParallelFor(members.size(), 1, [&](std::size_t r) {
    const std::size_t count = std::min(kLookers, members[r].size());
    std::vector<ReceiverPoint> lookers;
    for (std::size_t k = 0; k < count; ++k)
      lookers.push_back(points[members[r][k * members[r].size() / count]]);
    test(lookers, std::span(hidden_).subspan(r * words_, words_));
  });
}

HiddenLuminaires::Bits HiddenLuminaires::At(const ReceiverPoint& at) const {
  if (regions_.empty()) return {};
  const auto found = regions_.find(KeyOf(at));
  if (found == regions_.end()) return {};
  return Bits(hidden_).subspan(found->second * words_, words_);
}

}  // namespace penumbra
