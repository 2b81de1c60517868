// solver/visibility/area/area_form_factor.h
//
// The form factor between areas, past whatever stands between: the exact visible form factor of a point,
// integrated over the smaller area of each pair.

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

// The parts that make up what is left of a face (Scene::faces) once faces that overlap have been cut. A
// dropped face has none.
std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face);

struct FormFactorEstimate {
  double factor = 0;       // the fraction of the diffuse flux that leaves one front and reaches the other
  double error = 0;        // how far off the factor may be
  bool clear = false;      // nothing stands between
  std::size_t points = 0;  // at which it was looked
};

struct AreaFormFactorOptions {
  // Largest error relative to the factor that is asked for, where something stands between; of factors that
  // are less than the tolerance, relative to that, and never less than 2e-17.
  double tolerance = 1e-7;
  // The same where nothing stands between: roundings set the limit.
  double clear_tolerance = 2e-13;
  // An error that is small enough whatever the factor [m^2]: of the factor times the sender's area. A pair in
  // a sum gets its share of what the whole may err.
  double sufficient_error = 0;
  // Points that one pair of parts may cost; then the error is what it is. Where that is small beside 1
  // already [1], fewer are enough: penumbras past many edges take three times as many for every digit.
  std::size_t max_points = 10'000'000;
  double small = 1e-7;
  std::size_t sufficient_points = 200'000;
  // Takes the points on the first area whatever the sizes: for tests of reciprocity.
  bool points_on_first = false;
  // How occlusion is found at a point; null: the fastest exact way.
  const OcclusionMethod* method = nullptr;
  // Null, or what may cancel the work: the result is then of no use.
  const ExecutionContext* context = nullptr;
  // Whether a pair tells the context how far it is: only where it is alone. Several together always do.
  bool tells = false;
};

// From one part to another, past all patches of the scene; `patches` holds all of them. The error is an
// estimate from above: the differences of embedded Gauss and Kronrod rules, added up without their signs
// (where nothing blocks, reduced as in QUADPACK, Piessens et al. 1983), and what roundings do.
//
// The points lie on the smaller area, and the other factor follows by reciprocity. That area is cut where the
// other's plane meets it and along the lines on which what blocks begins and ceases to (the traces of wedges
// through a vertex and an edge, as in Heckbert, Discontinuity meshing for radiosity, 1992), those with the
// largest share first and only where the error asks for it; otherwise it is halved towards where the
// integrand is least even: common edges and corners, and curved events.
FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options = {});

// From several parts together to several others: sum A_i F_ij / sum A_i. Parallel, and the same for any
// number of threads.
FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options = {});

}  // namespace penumbra
