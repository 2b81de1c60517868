#include "display/viewer/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "solver/visibility/exact/backprojection.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra::viewer {
namespace {

ReceiverPoint ReceiverAt(const Scene& scene, const ProbedPoint& at) {
  ReceiverPoint receiver;
  receiver.position = at.position;
  receiver.normal = scene.patches[static_cast<std::size_t>(at.patch)].normal;
  return receiver;
}

// The point of the plane in the direction from the eye.
Vec3 OnPlane(const Vec3& eye, const Vec3& direction, const Patch& patch) {
  return eye + patch.normal.dot(patch.vertex[0] - eye) / patch.normal.dot(direction) * direction;
}

BackprojectedPatch Carry(const BackprojectedSource& seen, const Vec3& eye, const Patch& patch,
                         PatchId source) {
  std::vector<Vec3> on_source;
  on_source.reserve(seen.vertex.size());
  for (const Vec3& direction : seen.vertex) on_source.push_back(OnPlane(eye, direction, patch));
  const auto at = [&](std::int32_t i) { return on_source[static_cast<std::size_t>(i)]; };
  BackprojectedPatch carried;
  carried.source = source;
  std::set<std::pair<std::int32_t, std::int32_t>> blocking, drawn;
  for (const auto& edge : seen.blocker_edge)
    if (blocking.emplace(edge.a, edge.b).second) carried.blockers.push_back({at(edge.a), at(edge.b)});
  for (const auto& triangle : seen.triangle) {
    const auto& v = triangle.vertex;
    if (triangle.visible) carried.visible.push_back({at(v[0]), at(v[1]), at(v[2])});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = std::minmax(v[k], v[(k + 1) % 3]);
      const std::pair<std::int32_t, std::int32_t> key(edge.first, edge.second);
      if (!blocking.contains(key) && drawn.insert(key).second)
        carried.triangulation.push_back({at(key.first), at(key.second)});
    }
  }
  return carried;
}

}  // namespace

ProbeResult ProbeIrradiance(const LightState& light, const MeshState* mesh, const ProbedPoint& at) {
  const Scene& scene = light.scene();
  ProbeResult result;
  result.at = at;
  result.face = scene.FaceAt(at.patch, at.position);
  IrradianceParts parts;
  result.exact = light.Exact().OnPatch(at.patch, ReceiverAt(scene, at), &parts).irradiance;
  if (mesh)
    if (const auto place = mesh->Locator().Find(at.patch, at.position))
      result.interpolated = Rgb(IrradianceAt(mesh->mesh(), *place).max(0.0));
  result.sources = JoinFaces(scene, parts.contributions);
  return result;
}

std::int32_t FirstFace(const Scene& scene, PatchId patch) {
  const std::vector<std::int32_t>& faces = scene.patches[static_cast<std::size_t>(patch)].faces;
  return faces.empty() ? -1 : faces.front();
}

std::vector<PatchContribution> JoinFaces(const Scene& scene, const std::vector<PatchContribution>& sources) {
  std::vector<PatchContribution> joined;
  for (const PatchContribution& source : sources) {
    const std::int32_t face = FirstFace(scene, source.source);
    const auto same = std::find_if(joined.begin(), joined.end(), [&](const PatchContribution& other) {
      return face >= 0 && FirstFace(scene, other.source) == face;
    });
    if (same == joined.end())
      joined.push_back(source);
    else
      same->irradiance += source.irradiance;
  }
  std::stable_sort(joined.begin(), joined.end(), [](const PatchContribution& a, const PatchContribution& b) {
    return a.irradiance.sum() > b.irradiance.sum();
  });
  return joined;
}

std::string ProbeLine(const ProbeResult& probe) {
  std::string line = fmt::format("{:.17g},{:.17g},{:.17g},{}", probe.at.position.x(), probe.at.position.y(),
                                 probe.at.position.z(), probe.face);
  for (int c = 0; c < 3; ++c) line += fmt::format(",{:.17g}", probe.exact[c]);
  for (int c = 0; c < 3; ++c)
    line += probe.interpolated ? fmt::format(",{:.17g}", (*probe.interpolated)[c]) : ",nan";
  for (int c = 0; c < 3; ++c)
    line += probe.interpolated ? fmt::format(",{:.17g}", (*probe.interpolated)[c] - probe.exact[c]) : ",nan";
  return line;
}

std::vector<BackprojectedPatch> Backproject(const LightState& light, const ProbedPoint& at,
                                            const ExecutionContext& context) {
  const Scene& scene = light.scene();
  const ReceiverPoint receiver = ReceiverAt(scene, at);
  const Backprojection method;
  std::vector<BackprojectedPatch> seen;
  PointView view(scene, receiver, method);
  for (const PatchPair& pair : light.visibility().SourcesOf(at.patch)) {
    if (context.Cancelled()) break;
    if (!(light.solution().radiosity[static_cast<std::size_t>(ElementForest::Root(pair.source))] > 0).any())
      continue;
    if (!view.FaceSource(pair.source) || view.SourceInContact()) continue;
    const Patch& patch = scene.patches[static_cast<std::size_t>(pair.source)];
    const DirectionPolygon all = view.SeeSource(patch.Vertices());
    if (all.empty()) continue;
    std::vector<Occluder> occluders;
    if (!view.FindBlockers(light.visibility().Blockers(pair), at.patch, all, occluders)) {
      seen.push_back({pair.source, {}, {}, {}});
      continue;
    }
    seen.push_back(
        Carry(method.Project(all, occluders, receiver.normal), view.SourceEye(), patch, pair.source));
  }
  return seen;
}

}  // namespace penumbra::viewer
