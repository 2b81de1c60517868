// display/viewer/probes.h
//
// Probes of the irradiance at a point (thesis B.4.9, B.4.10): the contributions of all sources, and
// backprojections, the visible parts of the sources as seen from the point.

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
  std::int32_t face = -1;                  // number of the probed face, in the user's numbering
  Rgb exact = Rgb::Zero();                 // exact irradiance at the point [W/m^2]
  std::optional<Rgb> interpolated;         // irradiance of the mesh's interpolant [W/m^2]
  std::vector<PatchContribution> sources;  // contributions of the source faces, joined by JoinFaces()
};
ProbeResult ProbeIrradiance(const LightState& light, const MeshState* mesh, const ProbedPoint& at);

// The number of the face to which a patch belongs, in the user's numbering. If the patch was merged from
// several faces, FirstFace() returns the first face; if the patch has no face, -1.
std::int32_t FirstFace(const Scene& scene, PatchId patch);

// Adds up the contributions of patches that belong to the same face. PatchContribution::source of each sum is
// the first patch of the face. The joined contributions are sorted by decreasing brightness.
std::vector<PatchContribution> JoinFaces(const Scene& scene, const std::vector<PatchContribution>& sources);

// A line of CSV about the irradiance at a probed point, for standard output. The columns are those of
// kProbeHeader: x, y, z, patch, and three channels each of exact irradiance, interpolated irradiance and
// their difference.
std::string ProbeLine(const ProbeResult& probe);
inline constexpr const char* kProbeHeader =
    "x,y,z,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b,diff_r,diff_g,diff_b";

// The visible part of one source, projected onto the source.
struct BackprojectedPatch {
  PatchId source = kNoPatch;
  std::vector<std::array<Vec3, 3>> visible;  // triangles of the visible part [m]
  // edges of the visible triangles that lie on a blocker's outline
  std::vector<std::array<Vec3, 2>> blockers;
  // Edges of the visible triangles that lie on no blocker's outline.
  std::vector<std::array<Vec3, 2>> triangulation;
};
// Computes the backprojection (visible part) of each source that the probed point's patch may see.
// Backproject() treats only sources that send light and whose front lies at least partly above the probed
// point's horizon. Sources whose plane contains the point are omitted.
std::vector<BackprojectedPatch> Backproject(const LightState& light, const ProbedPoint& at,
                                            const ExecutionContext& context);

}  // namespace penumbra::viewer
