#include "mesh/interpolants/mesh_locator.h"
#include "solver/scene/tolerances.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"

namespace penumbra {
namespace {

struct Box2 {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void Add(const Vec2& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool Holds(const Vec2& p, double margin) const {
    return (p.array() >= low.array() - margin).all() && (p.array() <= high.array() + margin).all();
  }
};

constexpr std::uint32_t kLeafSize = 4;

// A node of a patch's tree of boxes. The first child follows its parent in the array.
struct BoxNode {
  Box2 box;
  std::uint32_t begin = 0, end = 0;  // triangles in `order`, of a leaf; begin == end: no leaf
  std::uint32_t second_child = 0;
};

// The point of the segment that is closest to p.
Vec2 NearestOnSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double t = std::clamp(edge.dot(p - a) / edge.squaredNorm(), 0.0, 1.0);
  return a + t * edge;
}

}  // namespace

struct MeshLocator::Impl {
  const Scene& scene;
  const IrradianceMesh& mesh;
  std::vector<Frame> frames;                 // per patch
  std::vector<double> margin;                // per patch [m]
  std::vector<std::array<Vec2, 3>> corners;  // per triangle
  std::vector<std::uint32_t> order;          // triangles in the order of the trees
  std::vector<BoxNode> nodes;
  std::vector<std::uint32_t> root;  // per patch, index in nodes; meaningless without triangles
  std::vector<bool> has_triangles;

  Impl(const Scene& s, const IrradianceMesh& m) : scene(s), mesh(m) {
    for (const Patch& patch : scene.patches) {
      frames.push_back(PolygonFrame(patch.Vertices()));
      margin.push_back(kBorder * SnapDistance(patch));
    }
    for (const IrradianceMesh::Triangle& t : mesh.triangles) {
      const Frame& frame = frames[t.patch];
      corners.push_back({frame.ToPlane(mesh.positions[t.vertex[0]]),
                         frame.ToPlane(mesh.positions[t.vertex[1]]),
                         frame.ToPlane(mesh.positions[t.vertex[2]])});
    }
    order.resize(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::uint32_t begin = 0;
    for (std::size_t p = 0; p < scene.patches.size(); ++p) {
      std::uint32_t end = begin;
      while (end < order.size() && mesh.triangles[end].patch == static_cast<PatchId>(p)) ++end;
      root.push_back(static_cast<std::uint32_t>(nodes.size()));
      has_triangles.push_back(end > begin);
      if (end > begin) Build(begin, end);
      begin = end;
    }
  }

  Vec2 Middle(std::uint32_t triangle) const {
    const auto& c = corners[triangle];
    return (c[0] + c[1] + c[2]) / 3;
  }

  void Build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    Box2 box, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (const Vec2& c : corners[order[i]]) box.Add(c);
      middles.Add(Middle(order[i]));
    }
    nodes[index].box = box;
    if (end - begin <= kLeafSize) {
      nodes[index].begin = begin;
      nodes[index].end = end;
      return;
    }
    const Vec2 size = middles.high - middles.low;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double ma = Middle(a)[axis], mb = Middle(b)[axis];
                       return ma != mb ? ma < mb : a < b;
                     });
    Build(begin, half);
    nodes[index].second_child = static_cast<std::uint32_t>(nodes.size());
    Build(half, end);
  }

  // Calls visit(triangle) for the triangles in boxes within `reach` of p.
  template <class Visit>
  void ForEachNear(std::uint32_t index, const Vec2& p, double reach, const Visit& visit) const {
    const BoxNode& node = nodes[index];
    if (!node.box.Holds(p, reach)) return;
    for (std::uint32_t i = node.begin; i < node.end; ++i) visit(order[i]);
    if (node.begin != node.end) return;
    ForEachNear(index + 1, p, reach, visit);
    ForEachNear(node.second_child, p, reach, visit);
  }
};

MeshLocator::MeshLocator(const Scene& scene, const IrradianceMesh& mesh)
    : impl_(std::make_unique<Impl>(scene, mesh)) {}
MeshLocator::~MeshLocator() = default;
MeshLocator::MeshLocator(MeshLocator&&) noexcept = default;

std::optional<MeshLocator::Location> MeshLocator::Find(PatchId patch, const Vec3& point,
                                                       double tolerance) const {
  if (!impl_->has_triangles[patch]) return std::nullopt;
  const Vec2 p = impl_->frames[patch].ToPlane(point);
  const double reach = std::max(tolerance, impl_->margin[patch]);
  // The distance to the triangle, and the smallest barycentric coordinate of a point inside.
  double best_distance = reach, best_depth = -1;
  std::optional<std::uint32_t> best;
  Vec2 best_point = p;
  impl_->ForEachNear(impl_->root[patch], p, reach, [&](std::uint32_t triangle) {
    const auto& c = impl_->corners[triangle];
    const double area = Cross2(c[1] - c[0], c[2] - c[0]);
    const double s = Cross2(p - c[0], c[2] - c[0]) / area, t = Cross2(c[1] - c[0], p - c[0]) / area;
    const double depth = std::min({s, t, 1 - s - t});
    Vec2 nearest = p;
    double distance = 0;
    if (!(depth >= 0)) {
      distance = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const Vec2 candidate = NearestOnSegment(p, c[k], c[(k + 1) % 3]);
        const double to = (candidate - p).norm();
        if (to >= distance) continue;
        distance = to;
        nearest = candidate;
      }
    }
    const double clamped = std::max(depth, 0.0);
    if (distance > best_distance) return;
    const bool tie = best && distance == best_distance && clamped == best_depth;
    if (tie ? triangle > *best : (best && distance == best_distance && clamped < best_depth)) return;
    best = triangle;
    best_distance = distance;
    best_depth = clamped;
    best_point = nearest;
  });
  if (!best) return std::nullopt;
  const auto& c = impl_->corners[*best];
  const double area = Cross2(c[1] - c[0], c[2] - c[0]);
  Location at;
  at.triangle = *best;
  if (!(area > 0)) return at;  // the first corner: the triangle is as narrow as rounding errors
  at.s = std::clamp(Cross2(best_point - c[0], c[2] - c[0]) / area, 0.0, 1.0);
  at.t = std::clamp(Cross2(c[1] - c[0], best_point - c[0]) / area, 0.0, 1.0 - at.s);
  return at;
}

Rgb IrradianceAt(const IrradianceMesh& mesh, const MeshLocator::Location& at) {
  return mesh.irradiance[at.triangle].At(at.s, at.t);
}

}  // namespace penumbra
