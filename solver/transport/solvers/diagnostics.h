// solver/transport/solvers/diagnostics.h
//
// What tells whether a scene and its links are sound: whether form factors add up, whether both links of a
// pair agree, whether light can leave, whether a face looks the wrong way. Nothing here changes anything.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

struct LinkDiagnostics {
  // Per patch: the sum of the form factors of all links that end in its tree, weighted by area and per free
  // area of the patch (FreeAreas) [1]. In a closed scene it is 1, but for the error of the links. 0 of a
  // patch that is wholly covered, which counts for none of the following.
  std::vector<double> closure;
  double closure_min = 0, closure_max = 0;
  double closure_mean = 0;  // weighted by free area
  double covered_area = 0;  // of all patches [m^2]

  // Reciprocity: |A1 F12 - A2 F21| / min(A1, A2) [1], of pairs of links between the same two elements (links
  // are split one way at a time, so that few have such a counterpart), and of all pairs of patches, each with
  // the sum over the links from one tree to the other.
  std::size_t link_pairs = 0, patch_pairs = 0;
  double link_reciprocity = 0, patch_reciprocity = 0;  // the worst
};
// Of no use if it was cancelled.
LinkDiagnostics DiagnoseLinks(const RadiositySolution& solution,
                              const ExecutionContext& context = ExecutionContext());

struct ViewDiagnostics {
  std::size_t rays = 0;
  double escaping = 0;  // share of what leaves the fronts, evenly and diffusely, that meets nothing
  // Faces whose fronts, where nothing lies on them, see nothing but backs, by number: their vertices may run
  // the wrong way.
  std::vector<std::int32_t> reversed_faces;
};
// Sends as many rays from each patch, by a low-discrepancy rule, cosine distributed. Deterministic for a
// given seed. Of no use if it was cancelled.
ViewDiagnostics DiagnoseViews(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1,
                              const ExecutionContext& context = ExecutionContext());

// Faces that emit, by number, and from whose fronts no light falls on any front, by as many rays of each of
// their patches: what hides an emitter lies before it, or it looks away from all there is.
std::vector<std::int32_t> DarkEmitters(const Scene& scene, std::size_t rays_per_patch = 512,
                                       std::uint64_t seed = 1);

// Area that reflects and that emitters see [m^2]: on fronts, whatever else, or on backs alone.
struct LitSides {
  double front = 0, back = 0;
  // Whether the scene, but for its lamps, is turned inside out: faces as they may be, a room's walls are lit
  // from inside. A single face that light meets from behind is none.
  bool TurnedInsideOut() const { return back > front; }
};
// By so many rays from either side of each patch, and a thousand from each emitter. Deterministic for a given
// seed.
LitSides FindLitSides(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1);

}  // namespace penumbra
