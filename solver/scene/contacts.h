// solver/scene/contacts.h
//
// Contacts of patches: the segments across which irradiance and radiosity jump (D0 discontinuities; thesis,
// section 5.2).

#pragma once

#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A segment of nonzero length on a receiver along which another patch stands on the receiver or intersects
// the receiver, or along which a patch that lies flat on the receiver ends.
struct Contact {
  // The end points of the segment along which two surfaces touch [m].
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  PatchId other = kNoPatch;
};

// All contacts on the front of the receiver, sorted by the index of the touching patch (Contact::other).
// Patches whose distance from the receiver is at most ContactGap() count as touching the receiver. Contacts
// along the outline of the receiver are omitted, because no part of the receiver lies beyond its outline.
std::vector<Contact> FindContacts(const Scene& scene, PatchId receiver);

// A patch is divided below an edge that hangs above the patch if (height of the edge) / (length of the edge)
// is at most kMaxHangingHeight. Light that passes below an edge with (height) / (length) < kMaxHangingHeight
// is negligible, like light under a door.
inline constexpr double kMaxHangingHeight = 0.02;

// Finds the contacts of many receivers of one scene. The scene must outlive the ContactSearch.
class ContactSearch {
 public:
  explicit ContactSearch(const Scene& scene);

  // Returns the same contacts as FindContacts(scene, receiver).
  std::vector<Contact> Find(PatchId receiver) const;

  // Returns the feet on the front of the receiver: the segments along which other patches stand on the
  // receiver or hang closely above it. If a patch stands on the receiver, the foot is the contact of this
  // patch with the receiver. If a patch hangs above the receiver and (height of its lower edge) / (length of
  // the edge) is at most kMaxHangingHeight, the foot of the patch is the projection of this edge onto the
  // receiver. Patches that lie flat on the receiver have no foot.
  std::vector<Contact> FindWalls(PatchId receiver) const;

 private:
  const Scene& scene_;
  // The largest distance at which two surfaces of the scene count as touching, ContactGap() [m].
  double gap_;
  // near_[p] lists the patches whose bounding boxes are near that of patch p, sorted.
  std::vector<std::vector<PatchId>> near_;
};

}  // namespace penumbra
