// solver/scene/contacts.h
//
// Where patches touch each other: the edges across which irradiance and radiosity jump (D0, thesis 5.2).

#pragma once

#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A segment of nonzero length on a receiver where another patch stands on it, crosses it, or covers it and
// ends.
struct Contact {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();  // [m]
  PatchId other = kNoPatch;
};

// All contacts on the front of the receiver that do not run along its outline, where nothing lies beyond; by
// other patch. What comes within ContactGap() of the receiver touches it.
std::vector<Contact> FindContacts(const Scene& scene, PatchId receiver);

// How high an edge may hang above a patch and still divide it, relative to the edge: light creeps through
// below, but as little as through the crack under a door.
inline constexpr double kHanging = 0.02;

// The same for many receivers of a scene, which must outlive the object.
class ContactSearch {
 public:
  explicit ContactSearch(const Scene& scene);

  // FindContacts().
  std::vector<Contact> Find(PatchId receiver) const;

  // The contacts on the front of the receiver of what rises from it, and the feet of what hangs closely above
  // it: the edges of other patches that rise from at most kHanging above it, projected onto it. What lies
  // flat on it is left out.
  std::vector<Contact> FindWalls(PatchId receiver) const;

 private:
  const Scene& scene_;
  double gap_;                              // ContactGap() [m]: finding it takes a look at all patches
  std::vector<std::vector<PatchId>> near_;  // per patch, ascending: whose boxes come that near
};

}  // namespace penumbra
