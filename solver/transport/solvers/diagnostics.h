// solver/transport/solvers/diagnostics.h
//
// Tests for defects of a scene and its links: the sums of form factors, the reciprocity of links, light that
// escapes, and faces that are reversed. The tests change nothing.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

struct LinkDiagnostics {
  // For each patch: sum of receiver area * form factor over all links that end in its tree, divided by the
  // free area of the patch (FreeAreas) [1]. In a closed scene, the closure of a patch is 1, up to the error
  // of the links. The closure of a completely covered patch is set to 0; such patches are excluded from
  // closure_min, closure_max and closure_mean.
  std::vector<double> closure;
  double closure_min = 0, closure_max = 0;
  double closure_mean = 0;  // weighted by free area
  double covered_area = 0;  // of all patches [m^2]

  // The error of reciprocity is |A1 F12 - A2 F21| / min(A1, A2) [1]. The error of reciprocity is measured for
  // pairs of links between the same two elements; and for pairs of patches, where A F is the sum over all
  // links between the trees of the patches. Few links have a counterpart in the other direction, because
  // links are split in one direction at a time.
  std::size_t link_pairs = 0, patch_pairs = 0;
  double link_reciprocity = 0, patch_reciprocity = 0;  // the largest values
};
// Without links, all values are 0. The result is useless if the context is cancelled.
LinkDiagnostics DiagnoseLinks(const RadiositySolution& solution,
                              const ExecutionContext& context = ExecutionContext());

struct ViewDiagnostics {
  std::size_t rays = 0;
  // For the patches that are not completely covered: which fraction of the rays that start uncovered hits
  // fronts. The sampled solver transports light along such rays, so that this is its closure.
  double fronts_min = 0, fronts_max = 0, fronts_mean = 0;  // the mean is weighted by free area
  double covered_area = 0;                                 // estimated from the rays [m^2]
  double escaping = 0;  // fraction of the diffuse light leaving the fronts, evenly, that meets nothing
  // The numbers of the faces from whose fronts only backs of other faces are visible, apart from covered
  // parts. The user may have given the vertices of reversed_faces in the wrong order.
  std::vector<std::int32_t> reversed_faces;
};
// Casts the same number of cosine-distributed low-discrepancy rays from each patch. The result is
// deterministic for a given seed. The result is useless if the context is cancelled.
ViewDiagnostics DiagnoseViews(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1,
                              const ExecutionContext& context = ExecutionContext());

// The numbers of the faces that emit light but do not illuminate any front, according to `rays_per_patch`
// rays from each of their patches. An emitter may illuminate no front because an object hides it, or because
// it faces away from the scene.
std::vector<std::int32_t> DarkEmitters(const Scene& scene, std::size_t rays_per_patch = 512,
                                       std::uint64_t seed = 1);

// `front` is the total area of the reflecting patches whose fronts are visible from emitters; `back` is the
// total area of the reflecting patches of which only the backs are visible from emitters [m^2].
struct LitSides {
  double front = 0, back = 0;
  // True if the faces of the scene, apart from its lamps, all seem to be reversed: lamps in a room illuminate
  // mostly the backs of its walls. A single face that is lit from behind does not make the result true.
  bool TurnedInsideOut() const { return back > front; }
};
// Casts `rays_per_patch` rays from either side of each patch, and about a thousand from each emitter. The
// result is deterministic for a given seed.
LitSides FindLitSides(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1);

}  // namespace penumbra
