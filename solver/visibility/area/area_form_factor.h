// solver/visibility/area/area_form_factor.h
//
// The form factor between two areas, with exact occlusion. The form factor is the mean, over the points of
// the smaller area, of the exact form factor of a point to the visible part of the larger area.

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

// A convex part of the front of a patch, as a sender or receiver of light.
struct AreaPart {
  PatchId patch = kNoPatch;
  // The vertices of a polygon in the plane of the patch, counter-clockwise seen from the front [m].
  Polygon3 polygon;
};

// The convex parts of a face (Scene::faces) that remain after overlaps with other faces have been removed.
// The list of parts is empty for a face that was dropped.
std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face);

struct FormFactorEstimate {
  // The form factor: the fraction of the diffuse flux from one area that reaches the other.
  double factor = 0;
  double error = 0;    // an upper estimate of the error |factor - true form factor|
  bool clear = false;  // true if no blocker lies between the two areas of the form factor
  // The number of points of one area at which the form factor to the other area was computed.
  std::size_t points = 0;
};

struct AreaFormFactorOptions {
  // The largest permissible error of the form factor F between two areas with blockers between them is
  // max(tolerance * max(F, tolerance), 2e-17).
  double tolerance = 1e-7;
  // The relative tolerance of the form factor between two areas without blockers. The default of
  // clear_tolerance is the smallest tolerance that rounding errors permit.
  double clear_tolerance = 2e-13;
  // For every tolerance, integration also ends as soon as the error of (form factor) * (area of the sender)
  // is at most sufficient_error [m^2]. Functions that add up the results of several pairs of areas set
  // sufficient_error to the error that they allow for each pair.
  double sufficient_error = 0;
  // Limits of the number of integration points for one pair of convex parts of the two areas. Integration
  // stops after `max_points` points, even if the error is too large. If the error of the form factor is at
  // most `small_error` [1], integration already stops after `sufficient_points` points. Where many edges cast
  // penumbras, each further decimal digit of the form factor takes three times as many points.
  std::size_t max_points = 10'000'000;
  double small_error = 1e-7;
  std::size_t sufficient_points = 200'000;
  // If true, the integration points lie on the first area even if it is the larger area; for tests of
  // reciprocity.
  bool points_on_first = false;
  // The method that computes occlusion at each point; null selects the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // If not null, a context by which the computation may be cancelled. A cancelled computation returns a
  // useless result.
  const ExecutionContext* context = nullptr;
  // If true, AreaFormFactor() for a single pair reports progress to the context. AreaFormFactor() for several
  // parts always reports progress.
  bool reports_progress = false;
};

// The form factor from the part `from` to the part `to`, with all patches of the scene as blockers; `patches`
// is a hierarchy over all patches. The returned error is an upper estimate: the sum of the absolute
// differences of embedded Gauss and Kronrod rules, plus a bound of the rounding errors. In integration cells
// without blockers, the difference of the Gauss and the Kronrod rule is scaled down as in QUADPACK (Piessens
// et al. 1983).
//
// The integration points lie on the smaller area; reciprocity gives the form factor in the other direction.
// The smaller area is cut along the intersection with the plane of the larger area. As long as the error is
// too large, the smaller area is also cut along event lines, which are the traces of wedges through a vertex
// and an edge (Heckbert, Discontinuity meshing for radiosity, 1992). Event lines with the largest product of
// length and weight are used first; the weight counts the events that coincide on the line. Integration cells
// that no event line crosses are halved where the integrand is least smooth: at common edges and corners, and
// at curved discontinuities.
FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options = {});

// The form factor from all parts `from` together to all parts `to` together: (sum of A_i F_ij over all i and
// j) / (sum of A_i). The computation uses several threads; the result does not depend on the number of
// threads.
FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options = {});

}  // namespace penumbra
