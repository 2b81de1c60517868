#include "mesh/interpolants/midpoint_prediction.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace penumbra {
namespace {

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

}  // namespace

MidpointPrediction::MidpointPrediction(const IrradianceMesh& mesh, std::span<const std::array<Rgb, 3>> corner)
    : mesh_(mesh), corner_(corner), sheet_(3 * mesh.triangles.size()) {
  std::iota(sheet_.begin(), sheet_.end(), std::size_t{0});
  ForEachInnerEdge(mesh, [&](std::size_t a, std::size_t b) {
    if (mesh.triangles[a / 3].discontinuity[a % 3] || mesh.triangles[b / 3].discontinuity[b % 3]) return;
    // The other triangle traverses the edge in reverse.
    sheet_[Root(sheet_, a)] = Root(sheet_, NextCorner(b));
    sheet_[Root(sheet_, NextCorner(a))] = Root(sheet_, b);
  });
  for (std::size_t i = 0; i < sheet_.size(); ++i) sheet_[i] = Root(sheet_, i);

  gradient_.assign(sheet_.size(), Eigen::Matrix3d::Zero());
  std::vector<double> weight(sheet_.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& vertex = mesh.triangles[t].vertex;
    const Vec3 a = mesh.positions[vertex[1]] - mesh.positions[vertex[0]],
               b = mesh.positions[vertex[2]] - mesh.positions[vertex[0]], n = a.cross(b);
    const double area = n.norm();
    if (area == 0) continue;
    const Rgb da = corner[t][1] - corner[t][0], db = corner[t][2] - corner[t][0];
    const Eigen::Matrix3d weighted =
        (da.matrix() * b.cross(n).transpose() + db.matrix() * n.cross(a).transpose()) / area;
    for (std::size_t k = 0; k < 3; ++k) {
      gradient_[sheet_[3 * t + k]] += weighted;
      weight[sheet_[3 * t + k]] += area;
    }
  }
  for (std::size_t i = 0; i < gradient_.size(); ++i)
    if (weight[i] > 0) gradient_[i] /= weight[i];
}

MidpointPrediction::Midpoint MidpointPrediction::At(std::size_t t, std::size_t k) const {
  const std::size_t from = 3 * t + k, to = NextCorner(from);
  const auto& vertex = mesh_.triangles[t].vertex;
  const Vec3 along = mesh_.positions[vertex[to % 3]] - mesh_.positions[vertex[k]];
  Midpoint middle;
  middle.bend = ((gradient_[sheet_[from]] - gradient_[sheet_[to]]) * along).array() / 8;
  middle.value = 0.5 * (corner_[t][k] + corner_[t][to % 3]) + middle.bend;
  return middle;
}

}  // namespace penumbra
