// solver/transport/solvers/diagnostics.h
//
// Diagnostics of defects of a scene and of its links: sums of form factors, reciprocity, light that escapes,
// and faces that are reversed. The diagnostics change neither the scene nor the links.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

struct LinkDiagnostics {
  // The closure of each patch: the sum of (receiver area) * (form factor) over all links whose receiver is an
  // element of the patch, divided by the free (uncovered) area of the patch (FreeAreas) [1]. In a closed
  // scene, the closure (sum of form factors) of a patch is 1, up to the error of the links' form factors. The
  // closure of a completely covered patch is set to 0, and completely covered patches are excluded from
  // closure_min, closure_max and closure_mean.
  std::vector<double> closure;
  double closure_min = 0, closure_max = 0;
  double closure_mean = 0;  // mean closure of the patches, weighted by their free areas
  double covered_area = 0;  // total area of the parts of patches that other objects cover [m^2]

  // The reciprocity error is |A1 F12 - A2 F21| / min(A1, A2) [1]. The member link_reciprocity measures the
  // reciprocity error of pairs of opposite links between the same two elements. The member patch_reciprocity
  // measures the reciprocity error |A1 F12 - A2 F21| / min(A1, A2) of pairs of patches, where each A F is a
  // sum over all links between elements of the two patches. Few links have an opposite link between the same
  // two elements, because links are split in one direction at a time.
  std::size_t link_pairs = 0, patch_pairs = 0;
  // The largest reciprocity errors of pairs of links, and of pairs of patches.
  double link_reciprocity = 0, patch_reciprocity = 0;
};
// Without links, all values of LinkDiagnostics are 0. If the computation is cancelled (ExecutionContext), the
// diagnostics must not be used.
LinkDiagnostics DiagnoseLinks(const RadiositySolution& solution,
                              const ExecutionContext& context = ExecutionContext());

struct ViewDiagnostics {
  std::size_t rays = 0;
  // The fraction of diffuse rays from a patch that hit fronts of other patches; rays that start on covered
  // parts of the patch do not count. In the solver `sampled`, which transports light along rays, the sum of a
  // patch's form factors is the fraction of its rays that hit fronts.
  double fronts_min = 0, fronts_max = 0, fronts_mean = 0;  // fronts_mean is weighted by free (uncovered) area
  double covered_area = 0;  // area of the covered parts of patches, estimated from the rays [m^2]
  double escaping = 0;  // fraction of the light that leaves the scene if all fronts have the same radiosity
  // The numbers of the faces from whose uncovered front only backs of other faces are visible. The user may
  // have given the vertices of the faces in reversed_faces in the wrong order.
  std::vector<std::int32_t> reversed_faces;
};
// Casts the same number of cosine-distributed low-discrepancy rays from each patch. ViewDiagnostics are
// deterministic for a given seed. If the computation is cancelled (ExecutionContext), the diagnostics must
// not be used.
ViewDiagnostics DiagnoseViews(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1,
                              const ExecutionContext& context = ExecutionContext());

// The numbers of the faces that emit light but do not illuminate any front, according to `rays_per_patch`
// rays from each patch of an emitting face. An emitter may illuminate no front because an object hides it, or
// because it faces away from the scene.
std::vector<std::int32_t> DarkEmitters(const Scene& scene, std::size_t rays_per_patch = 512,
                                       std::uint64_t seed = 1);

// `front` is the total area of the reflecting patches whose fronts are visible from emitters; `back` is the
// total area of the reflecting patches of which only the backs are visible from emitters [m^2].
struct LitSides {
  double front = 0, back = 0;
  // True if the faces of the scene, apart from its lamps, all seem to be reversed: the lamps illuminate
  // mostly the backs of faces. A single face that is lit from behind does not make TurnedInsideOut() true.
  bool TurnedInsideOut() const { return back > front; }
};
// Casts `rays_per_patch` rays from either side of each patch, and about a thousand rays from each emitter.
// The result of FindLitSides() is deterministic for a given seed.
LitSides FindLitSides(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1);

}  // namespace penumbra
