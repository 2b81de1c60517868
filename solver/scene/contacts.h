// solver/scene/contacts.h
//
// Contacts of patches: the segments across which irradiance and radiosity jump (D0, thesis 5.2).

#pragma once

#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A segment of nonzero length on a receiver along which another patch stands on the receiver, intersects it,
// or ends while lying on it.
struct Contact {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  // [m]
  PatchId other = kNoPatch;
};

// All contacts on the front of the receiver, sorted by Contact::other. Patches within ContactGap() of the
// receiver count as touching the receiver. Contacts along the receiver's outline are omitted, because the
// receiver ends there.
std::vector<Contact> FindContacts(const Scene& scene, PatchId receiver);

// If an edge hangs above a patch, the patch is divided along the edge if (height of the edge) / (length of
// the edge) is at most kMaxHangingHeight. Light that passes below an edge with a smaller ratio is negligible,
// like light under a door.
inline constexpr double kMaxHangingHeight = 0.02;

// Finds the contacts of many receivers of one scene. The scene must outlive the object.
class ContactSearch {
 public:
  explicit ContactSearch(const Scene& scene);

  // Returns the same as FindContacts(scene, receiver).
  std::vector<Contact> Find(PatchId receiver) const;

  // The feet of other patches on the front of the receiver: the segments along which they stand on the
  // receiver. A patch that rises from the receiver has its contact as a foot. A patch that rises from an edge
  // at a height of at most kMaxHangingHeight times the edge's length has the projection of this edge onto the
  // receiver as a foot. Patches that lie flat on the receiver have no foot.
  std::vector<Contact> FindWalls(PatchId receiver) const;

 private:
  const Scene& scene_;
  double gap_;                              // ContactGap() [m], cached because it depends on all patches
  std::vector<std::vector<PatchId>> near_;  // per patch, sorted: patches with boxes within reach
};

}  // namespace penumbra
