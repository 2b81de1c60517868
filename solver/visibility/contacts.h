// solver/visibility/contacts.h
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

}  // namespace penumbra
