// solver/transport/sources/source_set.h
//
// The light sources for the irradiance at points: the leaves of a radiosity solution with their radiosities,
// in depth-first order of their quadtrees. All receiver points use the same SourceSet, so that irradiance
// does not jump between receiver elements.

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/sources/source_polygon.h"
#include "solver/visibility/point/form_factor_batch.h"

namespace penumbra {

struct Fragment;
struct RadiositySolution;

// A part of a leaf of a SourceSet, with a radiosity of its own.
struct SourcePart {
  SourcePolygon polygon;
  Rgb radiosity = Rgb::Zero();  // radiosity of the part [W/m^2]
};

class SourceSet {
 public:
  // A node of a source's quadtree; nodes are stored in depth-first order. A subtree whose elements all have
  // the same radiosity becomes a single leaf of the SourceSet, because the form factor of a polygon is exact
  // for any size.
  struct Node {
    // Members that a traversal of the tree reads first are declared first, so that they lie in the same cache
    // lines.
    std::int32_t size = 0;  // number of corners of the node's polygon: 3 or 4
    std::int32_t skip = 1;  // number of nodes in this node's subtree, including the node itself; 1 for a leaf
    std::int32_t first_leaf = 0, leaf_count = 1;  // range of the subtree's leaves in the SourceSet
    std::array<std::int32_t, 4> corner = {};  // indices in Corners() of the vertices of the node's polygon
    // index of the solution's fragment (part of a cut leaf) that contains the node; -1 if none
    std::int32_t fragment = -1;
    std::int32_t element = -1;  // id of the quadtree element that equals or contains the node; -1 if none
    // For a subtree: the root mean square deviation of the leaves' radiosities B from their mean, divided by
    // max(mean, 1 % of the scene's mean reflected radiosity), for the channel with the largest quotient [1].
    double spread = 0;
    // The root mean square deviation of the radiosities of the subtree's leaves from their best linear fit,
    // with the same divisor as `spread`.
    double residual = 0;
    Vec3 centre = Vec3::Zero();  // centre of the node's polygon [m]
    double radius = 0;           // largest distance of a vertex from `centre` [m]
    double area = 0;             // area of the node's polygon [m^2]
    // Radiosity of the node, for a subtree the area-weighted mean over its leaves [W/m^2].
    Rgb radiosity = Rgb::Zero();

    std::array<Vec3, 4> vertex;  // vertices of the node's polygon [m]
    // Row c of `moment` is the sum over the subtree's leaves of (B - mean B) * area * centre, for channel c
    // of the leaf's radiosity B [W m].
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    // Row c of `slope` is the gradient, in the polygon's plane, of the best linear fit of the leaves'
    // radiosities, for channel c [W/m^3].
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    // The integral of d d^T over the node's polygon [m^4], where d is the position relative to the centroid.
    Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  };

  // Makes a SourceSet of the leaves of the solution, with their radiosities.
  static SourceSet FromSolution(const RadiositySolution& solution);
  // Makes a SourceSet of the leaves of the solution, in which cut leaves are divided into `fragments`, not
  // into the solution's own fragments. REQUIRES: `fragments` is sorted by leaf.
  static SourceSet FromSolution(const RadiositySolution& solution, std::span<const Fragment> fragments);
  // Makes a SourceSet from the leaves of the solution that is valid for any radiosities that WithLight() or
  // TakeLight() set later. Subtrees of uniform radiosity are not joined into one leaf, unless their patch
  // reflects nothing.
  static SourceSet ForAnyLight(const RadiositySolution& solution);
  // Makes a SourceSet of the emitters with their emittances, for direct light.
  static SourceSet Emitters(const Scene& scene);

  // A function that returns the parts that tile a leaf; an empty list leaves the leaf undivided.
  using DivideLeaf = std::function<std::vector<SourcePart>(PatchId patch, const Node& leaf)>;
  // A SourceSet of the given patches, with their leaves divided by `divide`. In the SourceSet that Divided()
  // returns, no patch outside `patches` sends light.
  SourceSet Divided(std::span<const PatchId> patches, const DivideLeaf& divide) const;
  // New radiosities of the elements, and of the fragments (parts of cut leaves), from which a SourceSet was
  // made.
  struct Light {
    // The radiosities of elements and fragments [W/m^2]. If `fragment` is empty, fragments have the
    // radiosities of their elements.
    std::span<const Rgb> element, fragment;
    std::span<const Rgb> emittance;  // emittance of each patch [W/m^2]
  };
  // WithLight() returns a copy of this SourceSet with new radiosities; TakeLight() changes the radiosities of
  // this SourceSet. REQUIRES: the SourceSet was made from a solution.
  SourceSet WithLight(const Light& light) const;
  void TakeLight(const Light& light);
  // Sets the spread and the residual of each node to the maximum of this SourceSet and `other`, so that
  // spread and residual hold for the light of both sets. REQUIRES: `other` is the result of WithLight().
  void TakeSpreads(const SourceSet& other);

  // The light of a node in a compact form, for sums over many nodes. Each member of NodeLight has the same
  // meaning as the member of Node with the same name.
  struct NodeLight {
    std::array<double, 3> radiosity = {0, 0, 0};  // the value of Node::radiosity [W/m^2]
    std::array<float, 9> slope = {};              // the value of Node::slope, row by row [W/m^3]
    float spread = 0, residual = 0;
  };
  const NodeLight& LightOf(std::int32_t node) const { return light_[static_cast<std::size_t>(node)]; }

  const Node& NodeAt(std::size_t i) const { return nodes_[i]; }
  std::size_t IndexOf(const Node& node) const { return static_cast<std::size_t>(&node - nodes_.data()); }

  // The nodes of the quadtree of a patch; empty if the patch sends no light.
  std::span<const Node> Tree(PatchId patch) const {
    return {nodes_.data() + first_[patch], nodes_.data() + first_[patch + 1]};
  }

  // The corners of all nodes [m]; a corner that several nodes of a patch share is stored once.
  std::span<const Vec3> Corners() const { return corners_; }

  // LeafPolygons() and LeafRadiosities() list the polygons and radiosities of all leaves, quadtree after
  // quadtree.
  const PolygonBatch& LeafPolygons() const { return leaf_polygons_; }
  std::span<const Rgb> LeafRadiosities() const { return leaf_radiosity_; }
  std::span<const Vec3> LeafVertices(std::int32_t leaf) const {
    const Node& node = nodes_[static_cast<std::size_t>(leaf_node_[static_cast<std::size_t>(leaf)])];
    return {node.vertex.data(), static_cast<std::size_t>(node.size)};
  }

  // The index of the node that corresponds to leaf number `leaf`.
  std::int32_t NodeOfLeaf(std::int32_t leaf) const { return leaf_node_[static_cast<std::size_t>(leaf)]; }
  std::size_t NodeCount() const { return nodes_.size(); }
  std::size_t PatchCount() const { return emittance_.size(); }

  // The index of the solution's fragment (part of a cut leaf) that contains a leaf of the SourceSet; -1 if
  // none.
  std::int32_t FragmentOf(std::int32_t leaf) const {
    return nodes_[static_cast<std::size_t>(leaf_node_[static_cast<std::size_t>(leaf)])].fragment;
  }

  // The emittance of the patch [W/m^2].
  const Rgb& Emittance(PatchId patch) const { return emittance_[static_cast<std::size_t>(patch)]; }

 private:
  enum class UniformSubtrees : std::uint8_t { kJoin, kJoinIfBlack };
  static SourceSet Make(const RadiositySolution& solution, std::span<const Fragment> fragments,
                        UniformSubtrees uniform);
  // Computes all data of nodes that follow from the polygons of the nodes and the radiosities of the leaves.
  void Measure();
  void NumberLeaves();
  void NumberCorners();
  void MeasurePolygons();
  Rgb MeanReflected() const;
  void MeasureSubtrees();
  void CompactLight();

  std::vector<std::size_t> first_;  // index in nodes_ of the first node of each patch
  // The pseudo-inverse of the second moment of each subtree's polygon [1/m^4].
  std::vector<Eigen::Matrix3d> inverse_moment_;
  std::vector<Node> nodes_;
  std::vector<NodeLight> light_;
  std::vector<Vec3> corners_;
  PolygonBatch leaf_polygons_;
  std::vector<Rgb> leaf_radiosity_;
  std::vector<std::int32_t> leaf_node_;  // index in nodes_ of each leaf's node
  std::vector<Rgb> emittance_;           // emittance of each patch
};

// For each node of `from`, the index of the node of `to` with the same polygon at the same place of the
// quadtree; -1 if none. REQUIRES: both SourceSets belong to the same scene.
std::vector<std::int32_t> MapNodes(const SourceSet& from, const SourceSet& to);

}  // namespace penumbra
