// solver/visibility/area/area_form_factor.h
//
// The form factor between areas, with exact occlusion: the mean of the exact visible form factor of a point.
// The points lie on the smaller area of each pair.

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

// The parts of a face (Scene::faces) that are left after overlapping faces have been cut. Empty for a face
// that was dropped.
std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face);

struct FormFactorEstimate {
  double factor = 0;       // the fraction of the diffuse flux of one front that reaches the other
  double error = 0;        // estimate of |factor - true factor|
  bool clear = false;      // no blocker lies between the areas
  std::size_t points = 0;  // points at which the form factor was computed
};

struct AreaFormFactorOptions {
  // The largest error of a factor F of a pair with blockers: max(tolerance * max(F, tolerance), 2e-17).
  double tolerance = 1e-7;
  // The relative tolerance for pairs without blockers. The default is the limit that rounding sets.
  double clear_tolerance = 2e-13;
  // A pair is done when F times the sender's area has at most this error [m^2], whatever `tolerance` says. A
  // sum over pairs sets this to the error that it allows each pair.
  double sufficient_error = 0;
  // The largest number of points for one pair of parts: integration stops there, whatever its error. If the
  // error of F is at most `small_error` [1], integration stops at `sufficient_points`: where many edges cast
  // penumbras, each further digit of F takes three times as many points.
  std::size_t max_points = 10'000'000;
  double small_error = 1e-7;
  std::size_t sufficient_points = 200'000;
  // The points lie on the first area, whatever the sizes. For tests of reciprocity.
  bool points_on_first = false;
  // Computes occlusion at each point; null: the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // May cancel the work, which makes the result useless; may be null.
  const ExecutionContext* context = nullptr;
  // A single pair reports its progress to the context. Sums over several pairs always report.
  bool reports_progress = false;
};

// The form factor of one part to another, with all patches of the scene as blockers; `patches` holds all
// patches. The error is an upper estimate: the sum of the absolute differences of embedded Gauss and Kronrod
// rules plus a bound of the rounding errors. Differences in cells without blockers are reduced as in QUADPACK
// (Piessens et al. 1983).
//
// The points lie on the smaller area; reciprocity gives the other factor. That area is cut along the
// intersection with the other area's plane. While the error requires it, the area is cut along event lines,
// the heaviest first: the traces of wedges through a vertex and an edge (Heckbert, Discontinuity meshing for
// radiosity, 1992). Otherwise cells are halved where the integrand is least smooth: at common edges and
// corners, and at curved events.
FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options = {});

// The form factor of several parts together to several others: sum A_i F_ij / sum A_i. Parallel; the result
// does not depend on the number of threads.
FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options = {});

}  // namespace penumbra
