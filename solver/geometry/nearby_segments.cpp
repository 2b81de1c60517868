#include "solver/geometry/nearby_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/base/random.h"
#include "solver/base/size.h"

namespace penumbra {
namespace {

// Fewer segments are compared one by one.
constexpr std::size_t kFew = 12;
// A cut that leaves more than this part of the segments on one side is not worth it.
constexpr double kWorthCutting = 0.8;
// Of many segments, this many show which cut is best; so many cuts along segments are tried.
constexpr std::size_t kShown = 128;
constexpr int kTried = 6;
constexpr int kAttempts = 8;
// The work, in looks at a segment, that is allowed for each segment.
constexpr std::size_t kMostWork = 1024;

struct CutLine {
  Vec2 point, normal;  // unit

  double HeightOf(const Vec2& p) const { return normal.dot(p - point); }
};

class PairFinder {
 public:
  PairFinder(std::span<const PlaneSegment> segments, double distance) : segments_(segments) {
    double largest = 0;
    for (const PlaneSegment& s : segments)
      largest = std::max({largest, s.a.cwiseAbs().maxCoeff(), s.b.cwiseAbs().maxCoeff()});
    // Heights are differences of coordinates, and rounded.
    reach_ = distance + 16 * std::numeric_limits<double>::epsilon() * largest;
  }

  // False if it would take too much work.
  bool Find() {
    std::vector<std::int32_t> all(segments_.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::vector<std::int32_t>> open = {std::move(all)};
    const std::size_t most = kMostWork * segments_.size();
    while (!open.empty()) {
      const std::vector<std::int32_t> part = std::move(open.back());
      open.pop_back();
      work_ += part.size();
      std::vector<std::int32_t> below, above;
      if (part.size() > kFew && Halve(part, below, above)) {
        open.push_back(std::move(below));
        open.push_back(std::move(above));
      } else {
        work_ += part.size() * part.size() / 2;
        if (work_ <= most) CompareAll(part);
      }
      if (work_ > most) return false;
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return true;
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> TakePairs() { return std::move(pairs_); }

 private:
  bool ReachesBelow(const CutLine& line, const PlaneSegment& s) const {
    return std::min(line.HeightOf(s.a), line.HeightOf(s.b)) <= reach_;
  }
  bool ReachesAbove(const CutLine& line, const PlaneSegment& s) const {
    return std::max(line.HeightOf(s.a), line.HeightOf(s.b)) >= -reach_;
  }

  // False if no line separates the segments. Two segments that come close to each other reach one side of the
  // line together.
  bool Halve(const std::vector<std::int32_t>& part, std::vector<std::int32_t>& below,
             std::vector<std::int32_t>& above) {
    // What few segments show may be wrong; to look again costs less than to compare all.
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::optional<CutLine> line = BestCut(part);
      if (!line) return false;
      below.clear();
      above.clear();
      work_ += part.size();
      for (const std::int32_t i : part) {
        if (ReachesBelow(*line, segments_[i])) below.push_back(i);
        if (ReachesAbove(*line, segments_[i])) above.push_back(i);
      }
      const auto larger = static_cast<double>(std::max(below.size(), above.size()));
      if (larger <= kWorthCutting * static_cast<double>(part.size())) return true;
      if (part.size() <= kShown) return false;
    }
    return false;
  }

  std::optional<CutLine> BestCut(const std::vector<std::int32_t>& part) {
    shown_.clear();
    const auto count = static_cast<std::uint32_t>(part.size());
    if (part.size() <= kShown)
      shown_ = part;
    else
      for (std::size_t i = 0; i < kShown; ++i) shown_.push_back(part[random_.Index(count)]);
    work_ += shown_.size() * (kTried + 2);
    std::optional<CutLine> best;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    const auto look = [&](const CutLine& line) {
      std::size_t below = 0, above = 0;
      for (const std::int32_t i : shown_) {
        below += ReachesBelow(line, segments_[i]) ? 1 : 0;
        above += ReachesAbove(line, segments_[i]) ? 1 : 0;
      }
      if (std::max(below, above) >= least) return;
      least = std::max(below, above);
      best = line;
    };
    for (int axis = 0; axis < 2; ++axis) look({MedianOfShown(axis), Vec2::Unit(axis)});
    for (int k = 0; k < kTried; ++k) {
      const PlaneSegment& s = segments_[part[random_.Index(count)]];
      const Vec2 along = s.b - s.a;
      const double length = along.norm();
      if (length > 0) look({s.a, Vec2(-along.y(), along.x()) / length});
    }
    return best;
  }

  Vec2 MedianOfShown(int axis) {
    const auto middle = [&](std::int32_t i) -> Vec2 { return 0.5 * (segments_[i].a + segments_[i].b); };
    const auto at = shown_.begin() + static_cast<std::ptrdiff_t>(shown_.size() / 2);
    std::nth_element(shown_.begin(), at, shown_.end(), [&](std::int32_t i, std::int32_t j) {
      const double a = middle(i)[axis], b = middle(j)[axis];
      return a != b ? a < b : i < j;
    });
    return middle(*at);
  }

  void CompareAll(const std::vector<std::int32_t>& part) {
    for (std::size_t i = 0; i < part.size(); ++i)
      for (std::size_t j = i + 1; j < part.size(); ++j)
        if (!AreApart(segments_[part[i]], segments_[part[j]]))
          pairs_.emplace_back(std::min(part[i], part[j]), std::max(part[i], part[j]));
  }

  bool AreApart(const PlaneSegment& s, const PlaneSegment& t) const {
    for (int axis = 0; axis < 2; ++axis)
      if (std::max(s.a[axis], s.b[axis]) + reach_ < std::min(t.a[axis], t.b[axis]) ||
          std::max(t.a[axis], t.b[axis]) + reach_ < std::min(s.a[axis], s.b[axis]))
        return true;
    return LiesBeside(s, t) || LiesBeside(t, s);
  }

  // Whether t lies on one side of the line through s.
  bool LiesBeside(const PlaneSegment& s, const PlaneSegment& t) const {
    const Vec2 along = s.b - s.a;
    const double length = along.norm();
    if (!(length > 0)) return false;
    const CutLine line{s.a, Vec2(-along.y(), along.x()) / length};
    return !ReachesBelow(line, t) || !ReachesAbove(line, t);
  }

  std::span<const PlaneSegment> segments_;
  double reach_ = 0;
  Random random_{1};  // any seed: only the time depends on it
  std::size_t work_ = 0;
  std::vector<std::int32_t> shown_;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
};

}  // namespace

std::optional<std::vector<std::pair<std::int32_t, std::int32_t>>> FindNearbyPairs(
    std::span<const PlaneSegment> segments, double distance) {
  PairFinder finder(segments, distance);
  if (!finder.Find()) return std::nullopt;
  return finder.TakePairs();
}

}  // namespace penumbra
