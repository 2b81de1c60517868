// solver/transport/sources/source_set.h
//
// The light sources of IrradianceAtPoint(): the radiosities of a solution's leaves, in an order that a walk
// down the trees can follow. The same set serves every receiver point, so that no step shows between receiver
// elements.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/form_factor_batch.h"

namespace penumbra {

struct Fragment;
struct RadiositySolution;

class SourceSet {
 public:
  // A node of a source's quadtree, in depth-first order. Subtrees of one radiosity are a single leaf: the
  // polygon's integral is exact whatever its size.
  struct Node {
    // What a walk asks every node for comes first: it shares cache lines.
    std::int32_t size = 0;                        // corners: 3 or 4
    std::int32_t skip = 1;                        // nodes in this subtree, this one counted: a leaf has 1
    std::int32_t first_leaf = 0, leaf_count = 1;  // the subtree's leaves, among all of the set
    std::array<std::int32_t, 4> corner = {};      // the places of its vertices, among all of the set
    std::int32_t fragment = -1;                   // that the node is a part of; -1: of none
    // Of a subtree: how far its leaves' radiosities are from their mean, relative to that or, where it is
    // darker, to the reflected light around; root mean square, the worst channel [1].
    double spread = 0;
    double residual = 0;          // the same, but from the plane that fits them best
    Vec3 centre = Vec3::Zero();   // of the polygon [m]
    double radius = 0;            // about it [m]
    double area = 0;              // [m^2]
    Rgb radiosity = Rgb::Zero();  // [W/m^2]; of a subtree, the mean by area

    std::array<Vec3, 4> vertex;  // [m]
    // One row a channel: its leaves' radiosities less their mean, times areas and places, summed [W m].
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    // One row a channel: how that plane rises along the polygon [W/m^3].
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
  };

  // What the leaves of the solution emit and reflect.
  static SourceSet FromSolution(const RadiositySolution& solution);
  // The same with other fragments than the solution's. REQUIRES: they ascend by leaf.
  static SourceSet FromSolution(const RadiositySolution& solution, std::span<const Fragment> fragments);
  // What surfaces emit of themselves: direct light.
  static SourceSet Emitters(const Scene& scene);

  const Node& NodeAt(std::size_t i) const { return nodes_[i]; }
  std::size_t IndexOf(const Node& node) const { return static_cast<std::size_t>(&node - nodes_.data()); }

  // The tree of a patch; empty if it sends no light.
  std::span<const Node> Tree(PatchId patch) const {
    return {nodes_.data() + first_[patch], nodes_.data() + first_[patch + 1]};
  }

  // The places that the corners of nodes have, each once a patch [m].
  std::span<const Vec3> Corners() const { return corners_; }

  // All leaves, tree after tree: their polygons and radiosities.
  const PolygonBatch& LeafPolygons() const { return leaf_polygons_; }
  std::span<const Rgb> LeafRadiosities() const { return leaf_radiosity_; }
  std::span<const Vec3> LeafVertices(std::int32_t leaf) const {
    const Node& node = nodes_[static_cast<std::size_t>(leaf_node_[static_cast<std::size_t>(leaf)])];
    return {node.vertex.data(), static_cast<std::size_t>(node.size)};
  }

  // The fragment that a leaf of the set is a part of, by its place in the list; -1: of none.
  std::int32_t FragmentOf(std::int32_t leaf) const {
    return nodes_[static_cast<std::size_t>(leaf_node_[static_cast<std::size_t>(leaf)])].fragment;
  }

  // What the patch emits of itself [W/m^2].
  const Rgb& Emittance(PatchId patch) const { return emittance_[static_cast<std::size_t>(patch)]; }

 private:
  void NumberLeaves();
  void NumberCorners();
  void MeasurePolygons();
  Rgb MeanReflected() const;
  void MeasureSubtrees();

  std::vector<std::size_t> first_;  // per patch, into nodes_
  std::vector<Node> nodes_;
  std::vector<Vec3> corners_;
  PolygonBatch leaf_polygons_;
  std::vector<Rgb> leaf_radiosity_;
  std::vector<std::int32_t> leaf_node_;  // into nodes_
  std::vector<Rgb> emittance_;           // per patch
};

}  // namespace penumbra
