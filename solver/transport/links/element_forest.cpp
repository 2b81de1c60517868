#include "solver/transport/links/element_forest.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The corners of the four children of a triangle (first three corners) or quadrilateral. Each corner is the
// midpoint of a pair of parent corners; the pair (0, 2) of a quadrilateral means the centre.
constexpr std::array<std::array<std::array<int, 2>, 3>, 4> kTriangleChildren = {{{{{0, 0}, {0, 1}, {2, 0}}},
                                                                                 {{{0, 1}, {1, 1}, {1, 2}}},
                                                                                 {{{2, 0}, {1, 2}, {2, 2}}},
                                                                                 {{{1, 2}, {2, 0}, {0, 1}}}}};
constexpr std::array<std::array<std::array<int, 2>, 4>, 4> kQuadrilateralChildren = {
    {{{{0, 0}, {0, 1}, {0, 2}, {3, 0}}},
     {{{0, 1}, {1, 1}, {1, 2}, {0, 2}}},
     {{{0, 2}, {1, 2}, {2, 2}, {2, 3}}},
     {{{3, 0}, {0, 2}, {2, 3}, {3, 3}}}}};

void PlaceVertices(const Patch& patch, Element& element) {
  for (int k = 0; k < element.size; ++k) element.vertex[k] = LatticePosition(patch, element.corner[k]);
  if (element.size == 3) element.vertex[3] = element.vertex[2];
  element.area = VectorArea(element.Vertices()).norm();
}

}  // namespace

Vec3 LatticePosition(const Patch& patch, const LatticePoint& p) {
  // The weights are dyadic fractions and thus exact; corners equal the patch's vertices to the bit.
  const double s = static_cast<double>(p.x) / kLatticeSize, t = static_cast<double>(p.y) / kLatticeSize;
  if (patch.size == 3) return (1 - s - t) * patch.vertex[0] + s * patch.vertex[1] + t * patch.vertex[2];
  return ((1 - s) * (1 - t)) * patch.vertex[0] + (s * (1 - t)) * patch.vertex[1] + (s * t) * patch.vertex[2] +
         ((1 - s) * t) * patch.vertex[3];
}

std::array<std::array<Vec3, 4>, 4> Quarters(const Element& element) {
  std::array<std::array<Vec3, 4>, 4> quarters;
  // The centre; the midpoints of the diagonals of an irregular quadrilateral differ from it.
  const Vec3 centre =
      0.25 * ((element.vertex[0] + element.vertex[2]) + (element.vertex[1] + element.vertex[3]));
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(element.size); ++k) {
      const auto [i, j] = element.size == 3 ? kTriangleChildren[c][k] : kQuadrilateralChildren[c][k];
      quarters[c][k] =
          i + 2 == j && element.size == 4 ? centre : Vec3(0.5 * (element.vertex[i] + element.vertex[j]));
    }
    if (element.size == 3) quarters[c][3] = quarters[c][2];
  }
  return quarters;
}

ElementForest::ElementForest(const Scene& scene) : scene_(&scene) {
  constexpr std::int32_t n = kLatticeSize;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    Element root;
    root.patch = static_cast<PatchId>(p);
    root.size = patch.size;
    if (patch.size == 3) {
      root.corner = {{{0, 0}, {n, 0}, {0, n}, {0, n}}};
    } else {
      root.corner = {{{0, 0}, {n, 0}, {n, n}, {0, n}}};
    }
    PlaceVertices(patch, root);
    elements_.push_back(root);
  }
}

ElementId ElementForest::Subdivide(ElementId leaf) {
  const Element parent = (*this)[leaf];
  PENUMBRA_CHECK(parent.IsLeaf() && parent.level < kMaxLevel);
  const auto first = static_cast<ElementId>(elements_.size());
  elements_[leaf].first_child = first;
  for (std::size_t c = 0; c < 4; ++c) {
    Element child;
    child.patch = parent.patch;
    child.parent = leaf;
    child.level = parent.level + 1;
    child.size = parent.size;
    for (std::size_t k = 0; k < static_cast<std::size_t>(parent.size); ++k) {
      const auto [i, j] = parent.size == 3 ? kTriangleChildren[c][k] : kQuadrilateralChildren[c][k];
      child.corner[k] = Midpoint(parent.corner[i], parent.corner[j]);
    }
    if (parent.size == 3) child.corner[3] = child.corner[2];
    PlaceVertices(scene_->patches[parent.patch], child);
    elements_.push_back(child);
  }
  return first;
}

void ElementForest::Truncate(std::size_t count) {
  for (std::size_t e = count; e < elements_.size(); ++e) {
    const auto parent = static_cast<std::size_t>(elements_[e].parent);
    if (parent < count) elements_[parent].first_child = kNoElement;
  }
  elements_.resize(count);
}

std::size_t ElementForest::Balance(PatchId patch) {
  // An edge of a leaf borders on leaves two levels finer if and only if one of its quarter points is a corner
  // of a leaf.
  std::unordered_set<LatticePoint, LatticePointHash> corners;
  std::vector<ElementId> pending = Leaves(patch);
  for (const ElementId id : pending)
    for (const LatticePoint& p : (*this)[id].Corners()) corners.insert(p);
  const auto too_coarse = [&](const Element& e) {
    if (e.level + 2 > kMaxLevel)
      return false;  // no leaf is two levels finer: its corners would be off the lattice
    for (int k = 0; k < e.size; ++k) {
      const LatticePoint a = e.corner[k], b = e.corner[(k + 1) % e.size], m = Midpoint(a, b);
      if (corners.contains(m) && (corners.contains(Midpoint(a, m)) || corners.contains(Midpoint(m, b))))
        return true;
    }
    return false;
  };
  std::size_t split = 0;
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<ElementId> next;
    for (const ElementId id : pending) {
      if (!too_coarse((*this)[id])) {
        next.push_back(id);
        continue;
      }
      const ElementId first = Subdivide(id);
      ++split;
      changed = true;
      for (ElementId child = first; child < first + 4; ++child) {
        for (const LatticePoint& p : (*this)[child].Corners()) corners.insert(p);
        next.push_back(child);
      }
    }
    pending = std::move(next);
  }
  return split;
}

ElementForest ElementForest::Of(const Scene& other) const {
  PENUMBRA_CHECK(other.patches.size() == scene_->patches.size());
  ElementForest same = *this;
  same.scene_ = &other;
  return same;
}

void ElementForest::ForEachBelow(ElementId top, const std::function<void(ElementId)>& visit) const {
  visit(top);
  const ElementId first = (*this)[top].first_child;
  if (first == kNoElement) return;
  for (ElementId child = first; child < first + 4; ++child) ForEachBelow(child, visit);
}

std::vector<ElementId> ElementForest::Leaves(PatchId patch) const {
  std::vector<ElementId> leaves;
  ForEachBelow(Root(patch), [&](ElementId id) {
    if ((*this)[id].IsLeaf()) leaves.push_back(id);
  });
  return leaves;
}

std::vector<ElementId> ElementForest::AllLeaves() const {
  std::vector<ElementId> leaves;
  for (std::size_t p = 0; p < scene_->patches.size(); ++p) {
    const std::vector<ElementId> own = Leaves(static_cast<PatchId>(p));
    leaves.insert(leaves.end(), own.begin(), own.end());
  }
  return leaves;
}

ElementId ElementForest::LeafAt(PatchId patch, const Vec3& point) const {
  const Vec3& normal = scene_->patches[patch].normal;
  ElementId at = Root(patch);
  while (!(*this)[at].IsLeaf()) {
    // The child that the point violates least.
    double best = -INFINITY;
    ElementId next = (*this)[at].first_child;
    for (ElementId child = (*this)[at].first_child; child < (*this)[at].first_child + 4; ++child) {
      const std::span<const Vec3> v = (*this)[child].Vertices();
      double inside = INFINITY;
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vec3 edge = v[(k + 1) % v.size()] - v[k];
        inside = std::min(inside, normal.cross(edge).dot(point - v[k]) / edge.norm());
      }
      if (inside > best) {
        best = inside;
        next = child;
      }
    }
    at = next;
  }
  return at;
}

void ElementForest::Validate() const {
  // Tolerance for the areas of children with rounded midpoints: a few rounding errors of coordinates times
  // edges.
  constexpr double kAreaError = 1e-9;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    if (e.IsLeaf()) continue;
    double area = 0;
    for (ElementId child = e.first_child; child < e.first_child + 4; ++child) {
      PENUMBRA_CHECK((*this)[child].parent == static_cast<ElementId>(i));
      PENUMBRA_CHECK((*this)[child].patch == e.patch && (*this)[child].level == e.level + 1);
      area += (*this)[child].area;
    }
    PENUMBRA_CHECK(std::abs(area - e.area) <= kAreaError * e.area);
  }
}

}  // namespace penumbra
