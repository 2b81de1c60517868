// solver/transport/points/free_area.h
//
// The free area of each patch: the area that other objects do not cover. For example, a box on a floor covers
// a part of the floor, which no light reaches. The sum of the form factors of a partly covered floor is (free
// area) / area instead of 1.

#pragma once

#include <vector>

#include "solver/base/progress.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// One of the parts into which contacts (lines where other surfaces touch) divide a patch, with the kinds of
// surfaces that the part's centroid sees.
struct ContactPart {
  Polygon3 polygon;  // the part, a convex polygon in the plane of its patch
  double area = 0;   // area of this part of a patch [m^2]
  bool sees_fronts = false;
  bool sees_sky = false;  // true if the part's centroid sees the sky; computed only if sees_fronts is false
};

// The parts into which contacts, the lines where other surfaces touch, divide each patch. ContactParts() uses
// several threads; the parts do not depend on the number of threads. If the computation is cancelled
// (ExecutionContext), the parts must not be used.
std::vector<std::vector<ContactPart>> ContactParts(const Scene& scene,
                                                   const ExecutionContext& context = ExecutionContext());

// For each group of parts of faces, the area that no other object covers [m^2]: the area of those parts that
// see the front of a patch, or the sky. `parts` is the result of ContactParts() for the scene.
std::vector<double> UncoveredAreas(const Scene& scene, const std::vector<std::vector<ContactPart>>& parts,
                                   const std::vector<std::vector<AreaPart>>& groups);

// Contacts, the lines where other surfaces touch a patch, divide the patch into parts. The free area of a
// patch is the total area of those parts that see the front of another patch [m^2]. Free areas are exact,
// except for slivers that CutLeavesAtContacts() does not cut off, and for light through gaps narrower than
// ContactGap(), which count as closed. In an open scene, parts that see only the sky do not count as free
// area. FreeAreas() uses several threads; the areas do not depend on the number of threads. If the
// computation is cancelled (ExecutionContext), the areas must not be used.
std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
