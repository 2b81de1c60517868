// solver/visibility/area/area_form_factor.h
//
// The form factor between two areas, with exact occlusion. The form factor is computed as the mean, over the
// smaller area, of the exact form factor of a point to the visible part of the larger area.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_hierarchy.h"

namespace penumbra {

class OcclusionMethod;

// A convex part of a patch's front.
struct AreaPart {
  PatchId patch = kNoPatch;
  Polygon3 polygon;  // in the patch's plane, counter-clockwise from its front
};

// The parts of a face (Scene::faces) that are left after overlapping faces have been cut. The list is empty
// for a face that was dropped.
std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face);

struct FormFactorEstimate {
  double factor = 0;       // the fraction of the diffuse flux of one front that reaches the other
  double error = 0;        // estimate of |factor - true factor|
  bool clear = false;      // no blocker lies between the areas
  std::size_t points = 0;  // points at which the form factor was computed
};

struct AreaFormFactorOptions {
  // The largest permissible error of the form factor F of a pair with blockers is max(tolerance * max(F,
  // tolerance), 2e-17).
  double tolerance = 1e-7;
  // The relative tolerance for pairs without blockers. The default is the smallest tolerance that rounding
  // errors permit.
  double clear_tolerance = 2e-13;
  // Integration also ends, whatever the tolerance, as soon as the error of F * (area of the sender) is at
  // most sufficient_error [m^2]. Functions that add up several pairs set sufficient_error to the error that
  // they allow for each pair.
  double sufficient_error = 0;
  // Limits of the number of points for one pair of parts. Integration stops after `max_points`, whatever the
  // error. If the error of F is at most `small_error` [1], integration already stops after
  // `sufficient_points`: where many edges cast penumbras, each further digit of F takes three times as many
  // points.
  std::size_t max_points = 10'000'000;
  double small_error = 1e-7;
  std::size_t sufficient_points = 200'000;
  // If true, the points lie on the first area even if it is larger; for tests of reciprocity.
  bool points_on_first = false;
  // The method that computes occlusion at each point; null selects the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // If not null, a context that may cancel the computation. A cancelled computation returns a useless result.
  const ExecutionContext* context = nullptr;
  // If true, AreaFormFactor() for a single pair reports progress to the context. AreaFormFactor() for several
  // parts always reports progress.
  bool reports_progress = false;
};

// The form factor of one part to another, with all patches of the scene as blockers; `patches` holds all
// patches. The error is an upper estimate: the sum of the absolute differences of embedded Gauss and Kronrod
// rules plus a bound of the rounding errors. In cells without blockers, the difference of the Gauss and the
// Kronrod rule is scaled down as in QUADPACK (Piessens et al. 1983).
//
// The integration points lie on the smaller area; reciprocity gives the form factor in the other direction.
// The smaller area is cut along the intersection with the plane of the larger area. As long as the error is
// too large, the area is also cut along event lines, those of the largest weight first: the traces of wedges
// through a vertex and an edge (Heckbert, Discontinuity meshing for radiosity, 1992). Cells that no event
// line crosses are halved where the integrand is least smooth: at common edges and corners, and at curved
// events.
FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options = {});

// The form factor of several parts together to several others: sum A_i F_ij / sum A_i. The function uses
// several threads; the result does not depend on their number.
FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options = {});

}  // namespace penumbra
