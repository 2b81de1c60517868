// display/viewer/probes.h
//
// The probes of thesis B.4.9 and B.4.10: what the irradiance at a point is made of, and what its sources look
// like from it.

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

struct ProbeResult {
  ProbedPoint at;
  std::int32_t face = -1;                  // as users count
  Rgb exact = Rgb::Zero();                 // [W/m^2]
  std::optional<Rgb> interpolated;         // [W/m^2]; by the mesh that was given
  std::vector<PatchContribution> sources;  // JoinFaces()
};
ProbeResult ProbeIrradiance(const LightState& light, const MeshState* mesh, const ProbedPoint& at);

// The face that names a patch, as users count: of several that it was merged of, the first; -1 without any.
std::int32_t FirstFace(const Scene& scene, PatchId patch);

// The contributions of the patches that a face was cut into as one, which names the first; the brightest
// first.
std::vector<PatchContribution> JoinFaces(const Scene& scene, const std::vector<PatchContribution>& sources);

// A line for standard output: x,y,z,patch, then exact, interpolated and their difference, a value a channel.
std::string ProbeLine(const ProbeResult& probe);
inline constexpr const char* kProbeHeader =
    "x,y,z,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b,diff_r,diff_g,diff_b";

// What is seen of one source, carried onto it.
struct BackprojectedPatch {
  PatchId source = kNoPatch;
  std::vector<std::array<Vec3, 3>> visible;        // triangles [m]
  std::vector<std::array<Vec3, 2>> blockers;       // edges that lie on the outline of a blocker
  std::vector<std::array<Vec3, 2>> triangulation;  // the others
};
// Of every source of the point's patch that sends light and has its front above the point's horizon; sources
// whose plane holds the point are left out.
std::vector<BackprojectedPatch> Backproject(const LightState& light, const ProbedPoint& at,
                                            const ExecutionContext& context);

}  // namespace penumbra::viewer
