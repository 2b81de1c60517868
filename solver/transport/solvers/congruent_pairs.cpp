#include "solver/transport/solvers/congruent_pairs.h"

#include <array>

#include "solver/base/check.h"

namespace penumbra {
namespace {

bool IsBefore(std::span<const Vec3> polygon, const Patch& patch) {
  for (const Vec3& v : polygon)
    if (patch.normal.dot(v - patch.vertex[0]) < 0) return false;
  return true;
}

// Lists the squared distances between the polygons, then those within each, for all orders of the vertices,
// and keeps the lexicographically smallest list.
class Least {
 public:
  void Try(std::span<const Vec3> a, std::span<const Vec3> b) {
    for (std::size_t shift_a = 0; shift_a < a.size(); ++shift_a)
      for (std::size_t shift_b = 0; shift_b < b.size(); ++shift_b)
        for (const bool back_a : {false, true})
          for (const bool back_b : {false, true})
            Try(Order(a, shift_a, back_a), a.size(), Order(b, shift_b, back_b), b.size());
  }
  PairShape Take() { return std::move(least_); }

 private:
  using Vertices = std::array<const Vec3*, 4>;

  static Vertices Order(std::span<const Vec3> polygon, std::size_t shift, bool back) {
    Vertices order{};
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) order[i] = &polygon[(shift + (back ? n - i : i)) % n];
    return order;
  }

  void Try(const Vertices& a, std::size_t size_a, const Vertices& b, std::size_t size_b) {
    PairShape& shape = trial_;
    shape.clear();
    bool below = least_.empty();
    // Returns false as soon as the list is larger than the smallest so far.
    const auto add = [&](const Vec3& p, const Vec3& q) {
      const double distance = (p - q).squaredNorm();
      if (!below) {
        const double other = least_[shape.size()];
        if (distance > other) return false;
        below = distance < other;
      }
      shape.push_back(distance);
      return true;
    };
    if (!add({static_cast<double>(size_a), 0, 0}, Vec3::Zero())) return;
    if (!add({static_cast<double>(size_b), 0, 0}, Vec3::Zero())) return;
    for (std::size_t i = 0; i < size_a; ++i)
      for (std::size_t j = 0; j < size_b; ++j)
        if (!add(*a[i], *b[j])) return;
    for (std::size_t i = 0; i < size_a; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!add(*a[i], *a[j])) return;
    for (std::size_t i = 0; i < size_b; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!add(*b[i], *b[j])) return;
    if (below) std::swap(least_, shape);
  }

  PairShape least_, trial_;
};

}  // namespace

PairShape ShapeOfPair(std::span<const Vec3> a, const Patch& patch_a, std::span<const Vec3> b,
                      const Patch& patch_b) {
  PENUMBRA_CHECK(a.size() <= 4 && b.size() <= 4);
  if (!IsBefore(a, patch_b) || !IsBefore(b, patch_a)) return {};
  Least least;
  least.Try(a, b);
  least.Try(b, a);
  return least.Take();
}

}  // namespace penumbra
