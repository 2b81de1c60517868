// mesh/discontinuities/silhouettes.h
//
// Finds the patches that meet in an edge or a corner, and the edges that are silhouettes as seen from a
// point. An edge is a silhouette from a point if one of its two faces faces the point and the other faces
// away. An edge that does not have exactly two faces is always a silhouette.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// An edge of a patch, from the patch's vertex k to vertex k + 1.
struct PatchEdge {
  PatchId patch = kNoPatch;
  std::int32_t k = 0;
};

// Numbers the corners and the edges of a scene. Corners with equal coordinates have the same number, and so
// have edges with equal end points.
class Silhouettes {
 public:
  explicit Silhouettes(const Scene& scene);

  // CornerAt() returns the number of the corner at vertex k of the patch, and EdgeAt() the number of the edge
  // that starts at this vertex.
  std::int32_t CornerAt(PatchId patch, std::int32_t k) const { return corner_at_[Index(patch, k)]; }
  std::int32_t EdgeAt(PatchId patch, std::int32_t k) const { return edge_at_[Index(patch, k)]; }

  const Vec3& Position(std::int32_t corner) const { return corners_[Size(corner)].position; }
  std::span<const std::int32_t> EdgesAround(std::int32_t corner) const {
    return corners_[Size(corner)].edges;
  }
  std::span<const PatchId> PatchesAround(std::int32_t corner) const { return corners_[Size(corner)].patches; }
  std::span<const PatchEdge> Sharing(std::int32_t edge) const { return edges_[Size(edge)].sharing; }
  // Returns the vector from the given end of the edge to the other end [m]. REQUIRES: the corner is an end of
  // the edge.
  Vec3 Away(std::int32_t edge, std::int32_t corner) const;

  // Returns false if exactly two faces meet in the edge, and the point sees the fronts of both faces or of
  // neither face. Seen from a point in the plane of one of its faces, an edge counts as a silhouette.
  bool IsSilhouette(std::int32_t edge, const Vec3& from) const;
  // A conservative test for a convex polygon of viewpoints: returns false only if the edge is a silhouette
  // from no point of the polygon.
  bool MayBeSilhouette(std::int32_t edge, std::span<const Vec3> polygon) const;

 private:
  struct Corner {
    Vec3 position;
    std::vector<std::int32_t> edges;
    std::vector<PatchId> patches;
  };
  struct Edge {
    std::int32_t a, b;  // numbers of the corners at the two ends of the edge
    std::vector<PatchEdge> sharing;
  };

  // Returns the heights of the point above the planes of the two faces that meet in the edge [m], with the
  // second face oriented like the first. The heights returned by Sides() are {0, 0} unless exactly two faces
  // meet in the edge.
  std::array<double, 2> Sides(std::int32_t edge, const Vec3& from) const;

  static std::size_t Size(std::int32_t i) { return static_cast<std::size_t>(i); }
  static std::size_t Index(PatchId patch, std::int32_t k) { return 4 * Size(patch) + Size(k); }

  const Scene& scene_;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  // The numbers of the corners and edges of each patch, with four entries per patch.
  std::vector<std::int32_t> corner_at_, edge_at_;
};

}  // namespace penumbra
