#include "solver/transport/sources/leaf_fragments.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "solver/base/parallel.h"
#include "solver/geometry/segment_clip.h"
#include "solver/scene/contacts.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// A cut is not made if it leaves less than this fraction of the leaf's area on one side, since it would only
// make a sliver.
constexpr double kLeastShare = 1e-6;

// Cuts the pieces that the contact crosses along the contact's line.
void CutAll(const Contact& contact, const Vec3& normal, double snap, double least_area,
            std::vector<Polygon3>& pieces) {
  const Vec3 side = normal.cross(contact.b - contact.a).normalized();
  const std::size_t count = pieces.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto inside = ClipToPolygon(contact.a, contact.b, pieces[i], normal, 0);
    if (!inside || ((*inside)[1] - (*inside)[0]).norm() <= snap) continue;
    Polygon3 left = ClipToHalfSpace(pieces[i], side, contact.a, snap);
    Polygon3 right = ClipToHalfSpace(pieces[i], -side, contact.a, snap);
    if (VectorArea(left).norm() < least_area || VectorArea(right).norm() < least_area) continue;
    pieces[i] = std::move(left);
    pieces.push_back(std::move(right));
  }
}

// Cuts a leaf along the contacts, and appends its pieces unless it stays whole.
void CutLeafAt(const ElementForest& forest, ElementId leaf, std::span<const Contact> contacts, double snap,
               std::vector<Fragment>& fragments) {
  const Element& element = forest[leaf];
  const Vec3& normal = forest.scene().patches[element.patch].normal;
  std::vector<Polygon3> pieces = {Polygon3(element.Vertices().begin(), element.Vertices().end())};
  for (const Contact& contact : contacts) CutAll(contact, normal, snap, kLeastShare * element.area, pieces);
  if (pieces.size() == 1) return;
  for (Polygon3& piece : pieces) {
    Fragment fragment;
    fragment.leaf = leaf;
    fragment.area = VectorArea(piece).norm();
    fragment.polygon = std::move(piece);
    fragments.push_back(std::move(fragment));
  }
}

// Cuts the leaves below an element. Each element passes on only the contacts that reach it.
void CutLeavesBelow(const ElementForest& forest, ElementId id, std::span<const Contact> contacts, double snap,
                    std::vector<Fragment>& fragments) {
  const Element& element = forest[id];
  const Vec3& normal = forest.scene().patches[element.patch].normal;
  std::vector<Contact> reaching;
  for (const Contact& contact : contacts)
    if (ClipToPolygon(contact.a, contact.b, element.Vertices(), normal, snap)) reaching.push_back(contact);
  if (reaching.empty()) return;
  if (element.IsLeaf()) {
    CutLeafAt(forest, id, reaching, snap, fragments);
    return;
  }
  for (ElementId child = element.first_child; child < element.first_child + 4; ++child)
    CutLeavesBelow(forest, child, reaching, snap, fragments);
}

std::vector<Fragment> CutLeavesOf(const ElementForest& forest, const ContactSearch& search, PatchId id) {
  std::vector<Fragment> fragments;
  CutLeavesBelow(forest, ElementForest::Root(id), search.Find(id), SnapDistance(forest.scene().patches[id]),
                 fragments);
  return fragments;
}

}  // namespace

std::vector<Fragment> CutLeavesAtContacts(const ElementForest& forest, const ExecutionContext& context) {
  std::vector<std::vector<Fragment>> by_patch(forest.scene().patches.size());
  if (context.Cancelled()) return {};
  const ContactSearch search(forest.scene());
  ParallelFor(by_patch.size(), 1, [&](std::size_t p) {
    if (!context.Cancelled()) by_patch[p] = CutLeavesOf(forest, search, static_cast<PatchId>(p));
  });
  std::vector<Fragment> fragments;
  for (std::vector<Fragment>& own : by_patch)
    std::move(own.begin(), own.end(), std::back_inserter(fragments));
  std::stable_sort(fragments.begin(), fragments.end(),
                   [](const Fragment& a, const Fragment& b) { return a.leaf < b.leaf; });
  return fragments;
}

}  // namespace penumbra
