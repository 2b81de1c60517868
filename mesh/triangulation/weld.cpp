#include "mesh/triangulation/weld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

struct OutlineEdge {
  PatchId patch;
  Vec3 a, b;
  Vec3 low, high;  // of the bounding box
};

// True if the segments lie within `tolerance` of one line, and share more than an end.
bool Overlap(const OutlineEdge& e, const OutlineEdge& f, double tolerance) {
  const Vec3 along = (e.b - e.a).normalized();
  const auto off = [&](const Vec3& p) { return (p - e.a - along.dot(p - e.a) * along).norm(); };
  if (off(f.a) > tolerance || off(f.b) > tolerance) return false;
  const double length = (e.b - e.a).norm(), fa = along.dot(f.a - e.a), fb = along.dot(f.b - e.a);
  return std::max(fa, fb) > tolerance && std::min(fa, fb) < length - tolerance;
}

// For each patch, the other patches with an edge along one of its edges, ascending.
std::vector<std::vector<PatchId>> Neighbours(const Scene& scene, std::span<const PatchBorders> borders,
                                             const ExecutionContext& context) {
  std::vector<OutlineEdge> edges;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    for (std::int32_t k = 0; k < patch.size; ++k) {
      const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % patch.size];
      const double snap = borders[p].snap;
      edges.push_back(
          {static_cast<PatchId>(p), a, b, a.cwiseMin(b).array() - snap, a.cwiseMax(b).array() + snap});
    }
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const OutlineEdge& e, const OutlineEdge& f) { return e.low.x() < f.low.x(); });
  std::vector<std::vector<PatchId>> neighbours(scene.patches.size());
  for (std::size_t i = 0; i < edges.size() && !context.Cancelled(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low.x() <= edges[i].high.x(); ++j) {
      const OutlineEdge &e = edges[i], &f = edges[j];
      if (e.patch == f.patch || (e.low.array() > f.high.array()).any() ||
          (f.low.array() > e.high.array()).any())
        continue;
      if (!Overlap(e, f, std::max(borders[e.patch].snap, borders[f.patch].snap))) continue;
      neighbours[e.patch].push_back(f.patch);
      neighbours[f.patch].push_back(e.patch);
    }
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

// Gives vertices within the snap distance of each other the position of the patch with the lowest number.
class Positions {
 public:
  Vec3 Of(const Vec3& p, double snap) {
    const double key = kDirection.dot(p);
    for (auto at = known_.lower_bound(key - snap); at != known_.end() && at->first <= key + snap; ++at)
      if ((at->second - p).norm() <= snap) return at->second;
    known_.emplace(key, p);
    return p;
  }

 private:
  // A unit vector that is unlikely to be perpendicular to an edge of a scene, so that few points have equal
  // keys.
  static inline const Vec3 kDirection = Vec3(0.5366, 0.6243, 0.5679).normalized();
  std::multimap<double, Vec3> known_;
};

}  // namespace

void WeldOutlines(const Scene& scene, std::span<PatchBorders> borders, const ExecutionContext& context) {
  PENUMBRA_CHECK(borders.size() == scene.patches.size());
  const std::vector<std::vector<PatchId>> neighbours = Neighbours(scene, borders, context);
  std::vector<std::vector<Vec3>> outline(borders.size());
  ParallelFor(borders.size(), 1, [&](std::size_t p) {
    if (!neighbours[p].empty()) outline[p] = borders[p].OutlineVertices();
  });
  Positions positions;
  for (std::size_t p = 0; p < outline.size() && !context.Cancelled(); ++p)
    for (Vec3& v : outline[p]) v = positions.Of(v, borders[p].snap);
  ParallelFor(borders.size(), 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    borders[p].Weld(outline[p]);
    for (const PatchId other : neighbours[p]) borders[p].Weld(outline[static_cast<std::size_t>(other)]);
  });
}

}  // namespace penumbra
