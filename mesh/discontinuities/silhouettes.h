// mesh/discontinuities/silhouettes.h
//
// Which patches meet in an edge or a corner, and which of their edges are silhouettes: seen from a point, the
// two faces at an edge look to different sides, or there is one face only.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The edge of a patch from its vertex k to k + 1.
struct PatchEdge {
  PatchId patch = kNoPatch;
  std::int32_t k = 0;
};

// Corners and edges of a scene by number; those with the same coordinates are one.
class Silhouettes {
 public:
  explicit Silhouettes(const Scene& scene);

  // The number of the corner at a vertex, and of the edge that starts there.
  std::int32_t CornerAt(PatchId patch, std::int32_t k) const { return corner_at_[Index(patch, k)]; }
  std::int32_t EdgeAt(PatchId patch, std::int32_t k) const { return edge_at_[Index(patch, k)]; }

  const Vec3& Position(std::int32_t corner) const { return corners_[Size(corner)].position; }
  std::span<const std::int32_t> EdgesAround(std::int32_t corner) const {
    return corners_[Size(corner)].edges;
  }
  std::span<const PatchId> PatchesAround(std::int32_t corner) const { return corners_[Size(corner)].patches; }
  std::span<const PatchEdge> Sharing(std::int32_t edge) const { return edges_[Size(edge)].sharing; }
  // From one end of the edge to the other [m]. REQUIRES: the corner is one of its ends.
  Vec3 Away(std::int32_t edge, std::int32_t corner) const;

  // True unless exactly two faces meet in the edge and the point sees the fronts of both, or of neither; a
  // point in the plane of one sees a silhouette.
  bool IsSilhouette(std::int32_t edge, const Vec3& from) const;
  // False only if the edge is no silhouette from any point of the convex polygon.
  bool MayBeSilhouette(std::int32_t edge, std::span<const Vec3> polygon) const;

 private:
  struct Corner {
    Vec3 position;
    std::vector<std::int32_t> edges;
    std::vector<PatchId> patches;
  };
  struct Edge {
    std::int32_t a, b;  // corners
    std::vector<PatchEdge> sharing;
  };

  // How far the point lies before each of the two faces that meet in the edge, both turned as the first is
  // [m]; two zeros where other than two meet.
  std::array<double, 2> Sides(std::int32_t edge, const Vec3& from) const;

  static std::size_t Size(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::size_t Index(PatchId patch, std::int32_t k) { return 4 * Size(patch) + Size(k); }

  const Scene& scene_;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> corner_at_, edge_at_;  // four a patch
};

}  // namespace penumbra
