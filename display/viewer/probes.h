// display/viewer/probes.h
//
// The probes of thesis B.4.9 and B.4.10: the contributions of all sources to the irradiance at a point, and
// the backprojections of the sources from a point.

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
  std::int32_t face = -1;                  // in the user's numbering
  Rgb exact = Rgb::Zero();                 // [W/m^2]
  std::optional<Rgb> interpolated;         // [W/m^2]; of the given mesh
  std::vector<PatchContribution> sources;  // after JoinFaces()
};
ProbeResult ProbeIrradiance(const LightState& light, const MeshState* mesh, const ProbedPoint& at);

// The face that names a patch, in the user's numbering: the first face of a patch that was merged from
// several; -1 if the patch has no face.
std::int32_t FirstFace(const Scene& scene, PatchId patch);

// Adds up the contributions of patches that belong to the same face. Each sum has the number of the face's
// first patch. The result is sorted by decreasing brightness.
std::vector<PatchContribution> JoinFaces(const Scene& scene, const std::vector<PatchContribution>& sources);

// A line of CSV for standard output with the columns of kProbeHeader: x, y, z, patch, and three channels each
// of exact irradiance, interpolated irradiance and their difference.
std::string ProbeLine(const ProbeResult& probe);
inline constexpr const char* kProbeHeader =
    "x,y,z,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b,diff_r,diff_g,diff_b";

// The visible part of one source, projected onto the source.
struct BackprojectedPatch {
  PatchId source = kNoPatch;
  std::vector<std::array<Vec3, 3>> visible;        // triangles [m]
  std::vector<std::array<Vec3, 2>> blockers;       // edges on the outline of a blocker
  std::vector<std::array<Vec3, 2>> triangulation;  // the other edges
};
// The backprojection of each source that the point's patch may see, if the source sends light and its front
// lies at least partly above the point's horizon. Sources whose plane contains the point are omitted.
std::vector<BackprojectedPatch> Backproject(const LightState& light, const ProbedPoint& at,
                                            const ExecutionContext& context);

}  // namespace penumbra::viewer
