#include "mesh/interpolants/corner_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace penumbra {
namespace {

// Angles that add up to pi to this tolerance form a straight sheet.
constexpr double kStraight = 1e-6;
// Directions are rounded to multiples of this, so that rounding errors do not make them depend on triangles.
constexpr double kStep = 1.0 / 1024;

// The edges between two triangles, each as the numbers 3 t + k of the edge in both.
template <class Visit>
void ForEachInnerEdge(const IrradianceMesh& mesh, const Visit& visit) {
  std::unordered_map<std::uint64_t, std::size_t> first;
  first.reserve(2 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t v = mesh.triangles[t].vertex[k], w = mesh.triangles[t].vertex[(k + 1) % 3];
      const auto [place, added] = first.try_emplace(std::min(v, w) << 32 | std::max(v, w), 3 * t + k);
      if (!added) visit(place->second, 3 * t + k);
    }
}

std::size_t NextCorner(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::size_t Root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// The directions from a corner of a triangle to the next two corners; unit vectors.
struct Wedge {
  Vec3 right, left;
  double angle;
};

Wedge WedgeAt(const IrradianceMesh& mesh, std::size_t t, std::size_t k) {
  const auto position = [&](std::size_t j) -> const Vec3& {
    return mesh.positions[mesh.triangles[t].vertex[(k + j) % 3]];
  };
  const Vec3 right = (position(1) - position(0)).stableNormalized();
  const Vec3 left = (position(2) - position(0)).stableNormalized();
  return {right, left, std::atan2(right.cross(left).norm(), right.dot(left))};
}

// Of each vertex, whether it belongs to a flat triangle.
std::vector<bool> FindCrowded(const IrradianceMesh& mesh, const FlatTriangles* flat) {
  std::vector<bool> crowded(mesh.positions.size(), false);
  if (!flat) return crowded;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (flat->Contains(t))
      for (const std::uint32_t v : mesh.triangles[t].vertex) crowded[v] = true;
  return crowded;
}

bool IsFlat(const IrradianceMesh& mesh, const IrradianceMesh::Triangle& t, double width) {
  const auto& [u, v, w] = t.vertex;
  const Vec3 a = mesh.positions[v] - mesh.positions[u], b = mesh.positions[w] - mesh.positions[u];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  return a.cross(b).squaredNorm() <= width * width * longest;
}

}  // namespace

FlatTriangles::FlatTriangles(const IrradianceMesh& mesh, std::span<const double> widths)
    : beside_(mesh.triangles.size()) {
  constexpr std::size_t kUnknown = ~std::size_t{0};
  std::size_t unknown = 0;
  for (std::size_t t = 0; t < beside_.size(); ++t) {
    const IrradianceMesh::Triangle& triangle = mesh.triangles[t];
    const bool flat = IsFlat(mesh, triangle, widths[static_cast<std::size_t>(triangle.patch)]);
    beside_[t] = flat ? kUnknown : t;
    unknown += flat ? 1 : 0;
  }
  if (unknown == 0) return;
  struct Edge {
    std::size_t t, u;
    bool divides;
  };
  std::vector<Edge> edges;
  ForEachInnerEdge(mesh, [&](std::size_t a, std::size_t b) {
    const std::size_t t = a / 3, u = b / 3;
    if (beside_[t] != kUnknown && beside_[u] != kUnknown) return;
    edges.push_back({t, u, mesh.triangles[t].discontinuity[a % 3] || mesh.triangles[u].discontinuity[b % 3]});
  });
  // First within the discontinuities, then across.
  for (const bool across : {false, true})
    for (bool found = true; found;) {
      found = false;
      for (const Edge& edge : edges) {
        if (edge.divides && !across) continue;
        for (const auto& [from, to] : {std::pair(edge.t, edge.u), std::pair(edge.u, edge.t)})
          if (beside_[from] != kUnknown && beside_[to] == kUnknown) {
            beside_[to] = beside_[from];
            found = true;
          }
      }
    }
  for (std::size_t t = 0; t < beside_.size(); ++t)
    if (beside_[t] == kUnknown) beside_[t] = t;
}

CornerSheets::CornerSheets(const IrradianceMesh& mesh, const FlatTriangles* flat)
    : sheet_(3 * mesh.triangles.size()) {
  std::iota(sheet_.begin(), sheet_.end(), std::size_t{0});
  ForEachInnerEdge(mesh, [&](std::size_t a, std::size_t b) {
    if (mesh.triangles[a / 3].discontinuity[a % 3] || mesh.triangles[b / 3].discontinuity[b % 3]) return;
    // The other triangle traverses the edge in reverse.
    sheet_[Root(sheet_, a)] = Root(sheet_, NextCorner(b));
    sheet_[Root(sheet_, NextCorner(a))] = Root(sheet_, b);
  });
  for (std::size_t i = 0; i < sheet_.size(); ++i) sheet_[i] = Root(sheet_, i);

  into_.assign(sheet_.size(), Vec3::Zero());
  const std::vector<bool> is_crowded = FindCrowded(mesh, flat);
  std::vector<bool> crowded(sheet_.size(), false);
  std::vector<double> angle(sheet_.size(), 0.0);
  std::vector<Vec3> normal(sheet_.size(), Vec3::Zero());
  for (std::size_t corner = 0; corner < sheet_.size(); ++corner) {
    const Wedge wedge = WedgeAt(mesh, corner / 3, corner % 3);
    const std::size_t sheet = sheet_[corner];
    if (is_crowded[mesh.triangles[corner / 3].vertex[corner % 3]]) crowded[sheet] = true;
    angle[sheet] += wedge.angle;
    normal[sheet] += wedge.right.cross(wedge.left);
    into_[sheet] += wedge.right - wedge.left;  // adds up to the first right minus the last left
  }
  for (std::size_t sheet = 0; sheet < into_.size(); ++sheet) {
    if (crowded[sheet] || std::abs(angle[sheet] - std::numbers::pi) > kStraight) {
      into_[sheet].setZero();
      continue;
    }
    // The directions of the two borders are opposite, so that their difference lies along the border.
    const Vec3 exact = normal[sheet].cross(into_[sheet]).stableNormalized();
    into_[sheet] = kStep * (exact / kStep).array().round();
  }
}

}  // namespace penumbra
