// solver/transport/points/free_area.h
//
// The free area of each patch: the area that is not covered by other objects. For example, a box on a floor
// covers a part of the floor, which no light reaches; the sum of the floor's form factors is therefore (free
// area) / area instead of 1.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// A part of a patch's front between contacts, and what its middle sees.
struct ContactPart {
  Polygon3 polygon;  // convex, in the plane of the patch
  double area = 0;   // [m^2]
  bool sees_fronts = false;
  bool sees_sky = false;  // known only where it sees no fronts
};

// The parts of each patch. The function uses several threads; the result does not depend on their number, and
// is useless if the context is cancelled.
std::vector<std::vector<ContactPart>> ContactParts(const Scene& scene,
                                                   const ExecutionContext& context = ExecutionContext());

// The area of each group of faces' parts that nothing covers: what sees fronts or the sky [m^2]. `parts` are
// the ContactParts() of the scene.
std::vector<double> UncoveredAreas(const Scene& scene, const std::vector<std::vector<ContactPart>>& parts,
                                   const std::vector<std::vector<AreaPart>>& groups);

// Contacts divide a patch into parts. The free area of the patch is the total area of those parts that see
// the front of another patch [m^2]. The result is exact, except for slivers that CutLeavesAtContacts() does
// not cut off and for light through gaps that count as closed (ContactGap). In an open scene, the area of
// a part that sees only the sky is not counted. The function uses several threads; the result does not depend
// on their number. The result is useless if the context is cancelled.
std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
