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
  // free area of the patch (FreeAreas) [1]. In a closed scene 1, up to the error of the links. 0 for a patch
  // that is covered completely; such patches do not count for the values below.
  std::vector<double> closure;
  double closure_min = 0, closure_max = 0;
  double closure_mean = 0;  // weighted by free area
  double covered_area = 0;  // of all patches [m^2]

  // Reciprocity, |A1 F12 - A2 F21| / min(A1, A2) [1]: of pairs of links between the same two elements, and of
  // pairs of patches with the sum over all links between their trees. Links are split in one direction at a
  // time, so few links have a counterpart.
  std::size_t link_pairs = 0, patch_pairs = 0;
  double link_reciprocity = 0, patch_reciprocity = 0;  // the largest values
};
// The result is useless if the context is cancelled.
LinkDiagnostics DiagnoseLinks(const RadiositySolution& solution,
                              const ExecutionContext& context = ExecutionContext());

struct ViewDiagnostics {
  std::size_t rays = 0;
  double escaping = 0;  // fraction of the diffuse light leaving the fronts, evenly, that meets nothing
  // Numbers of the faces whose fronts see only backs, apart from covered parts; the order of their vertices
  // may be reversed.
  std::vector<std::int32_t> reversed_faces;
};
// Casts the same number of cosine-distributed low-discrepancy rays from each patch. Deterministic for a given
// seed. The result is useless if the context is cancelled.
ViewDiagnostics DiagnoseViews(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1,
                              const ExecutionContext& context = ExecutionContext());

// Numbers of the faces that emit but light no front, by `rays_per_patch` rays from each of their patches. An
// emitter lights nothing if an object before it hides it, or if it faces away from the scene.
std::vector<std::int32_t> DarkEmitters(const Scene& scene, std::size_t rays_per_patch = 512,
                                       std::uint64_t seed = 1);

// The total area of reflecting patches that emitters see from the front, and of those that emitters see only
// from the back [m^2].
struct LitSides {
  double front = 0, back = 0;
  // True if the scene, apart from its lamps, seems to be turned inside out: light reaches the walls of a room
  // from inside, however its faces are oriented. A single face that is lit from behind is not enough.
  bool TurnedInsideOut() const { return back > front; }
};
// Casts `rays_per_patch` rays from either side of each patch, and about a thousand from each emitter.
// Deterministic for a given seed.
LitSides FindLitSides(const Scene& scene, std::size_t rays_per_patch = 64, std::uint64_t seed = 1);

}  // namespace penumbra
