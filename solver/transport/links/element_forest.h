// solver/transport/links/element_forest.h
//
// The quadtrees of elements, one quadtree for each patch (the thesis's Tree, 4.1), with geometry and topology
// only. Radiosities of elements are stored elsewhere, in arrays indexed by ElementId.
//
// All corners of elements lie on the integer lattice of their patch. With N = kLatticeSize, the corners of a
// quadrilateral are (0,0), (N,0), (N,N) and (0,N); those of a triangle are (0,0), (N,0) and (0,N). Equal
// lattice points have bit-identical positions in space, so that neighbours, shared corners and hanging
// vertices are found by comparing integers, not distances.

#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Index of an element in ElementForest::elements.
using ElementId = std::int32_t;
inline constexpr ElementId kNoElement = -1;

inline constexpr int kMaxLevel = 20;
inline constexpr std::int32_t kLatticeSize = 1 << kMaxLevel;

struct LatticePoint {
  std::int32_t x = 0, y = 0;
  auto operator<=>(const LatticePoint&) const = default;
};

// The midpoint of two lattice points. REQUIRES: the midpoint is on the lattice.
inline LatticePoint Midpoint(const LatticePoint& a, const LatticePoint& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

struct LatticePointHash {
  std::size_t operator()(const LatticePoint& p) const {
    const std::uint64_t key =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.x)) << 32) | static_cast<std::uint32_t>(p.y);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> 7);
  }
};

// The position of a lattice point on a patch [m]: bilinear on a quadrilateral, affine on a triangle. The
// positions of the lattice's corners are bit-identical to the patch's vertices.
Vec3 LatticePosition(const Patch& patch, const LatticePoint& p);

struct Element {
  PatchId patch = kNoPatch;
  ElementId parent = kNoElement;
  // The id of the first of the four children, which have consecutive ids; kNoElement if the element is a
  // leaf.
  ElementId first_child = kNoElement;
  std::int32_t level = 0;  // level of the element in its quadtree: 0 for the root
  std::int32_t size = 0;   // number of the element's corners: 3 or 4
  // The corners of the element on the lattice, counter-clockwise; the fourth entry is unused in a triangle.
  std::array<LatticePoint, 4> corner;
  std::array<Vec3, 4> vertex;  // positions of the element's corners in space [m]
  double area = 0;             // area of the element [m^2]

  bool IsLeaf() const { return first_child == kNoElement; }
  std::span<const Vec3> Vertices() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
  std::span<const LatticePoint> Corners() const { return {corner.data(), static_cast<std::size_t>(size)}; }
};

// The corners of the four quarters of an element [m], in the order of its children, whether or not the
// children exist.
std::array<std::array<Vec3, 4>, 4> Quarters(const Element& element);

// All quadtrees of a scene. While the quadtrees grow, ElementIds stay valid, but references to elements
// become invalid.
class ElementForest {
 public:
  ElementForest() = default;
  // Makes one root element for each patch; the root of patch p is element p. The scene must outlive the
  // ElementForest.
  explicit ElementForest(const Scene& scene);

  // A copy of the quadtrees that refers to the scene `other`, which must have the same patches but may have
  // other materials. The scene `other` must outlive the copy.
  ElementForest Of(const Scene& other) const;

  const Scene& scene() const { return *scene_; }
  std::span<const Element> elements() const { return elements_; }
  const Element& operator[](ElementId id) const { return elements_[static_cast<std::size_t>(id)]; }
  std::size_t size() const { return elements_.size(); }
  static ElementId Root(PatchId patch) { return patch; }

  // Splits a leaf into four children: a triangle at its edge midpoints, a quadrilateral at its edge midpoints
  // and centre. Subdivide() returns the id of the leaf's first child. REQUIRES: the level of the leaf is
  // below kMaxLevel.
  ElementId Subdivide(ElementId leaf);

  // Undoes the newest subdivisions until `count` elements are left. REQUIRES: the forest had exactly `count`
  // elements at some time.
  void Truncate(std::size_t count);

  // Subdivides leaves until the levels of leaves that share an edge differ by at most one. Balance() returns
  // the number of leaves that were subdivided.
  std::size_t Balance(PatchId patch);

  // The leaves (elements without children) of a patch's quadtree, in depth-first order.
  std::vector<ElementId> Leaves(PatchId patch) const;
  // The leaves (elements without children) of all patches, patch by patch.
  std::vector<ElementId> AllLeaves() const;

  // The leaf of the patch that contains the point. For a point on a border between leaves, or outside the
  // patch because of rounding, LeafAt() returns one of the nearest leaves. REQUIRES: the point lies in the
  // patch's plane.
  ElementId LeafAt(PatchId patch, const Vec3& point) const;

  // Calls visit(id) for the element and all its descendants, parents first.
  void ForEachBelow(ElementId top, const std::function<void(ElementId)>& visit) const;

  // Checks that children tile their parents, that areas add up, and that parents and children refer to each
  // other.
  void Validate() const;

 private:
  const Scene* scene_ = nullptr;
  std::vector<Element> elements_;
};

}  // namespace penumbra
