#include "solver/transport/solvers/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/points/diffuse_rays.h"
#include "solver/transport/points/free_area.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {
namespace {

const Link* FindLink(const std::vector<Link>& links, ElementId receiver, ElementId source) {
  const auto found = std::lower_bound(links.begin(), links.end(), std::pair(receiver, source),
                                      [](const Link& link, const std::pair<ElementId, ElementId>& key) {
                                        return std::pair(link.receiver, link.source) < key;
                                      });
  return found != links.end() && found->receiver == receiver && found->source == source ? &*found : nullptr;
}

}  // namespace

LinkDiagnostics DiagnoseLinks(const RadiositySolution& solution, const ExecutionContext& context) {
  const Scene& scene = solution.forest.scene();
  LinkDiagnostics diagnostics;
  diagnostics.closure.assign(scene.patches.size(), 0);
  if (solution.links.links.empty()) return diagnostics;
  // The flux per unit radiosity between two patches, lower number first: the flux in one direction minus that
  // in the other.
  struct Exchange {
    PatchId first, second;
    double difference;
  };
  std::vector<Exchange> exchanges;
  for (const Link& link : solution.links.links) {
    if (context.Cancelled()) return diagnostics;
    const Element& receiver = solution.forest[link.receiver];
    const Element& source = solution.forest[link.source];
    const double flux = receiver.area * link.form_factor;
    diagnostics.closure[static_cast<std::size_t>(receiver.patch)] += flux;
    const bool forth = receiver.patch < source.patch;
    exchanges.push_back({std::min(receiver.patch, source.patch), std::max(receiver.patch, source.patch),
                         forth ? flux : -flux});
    if (!forth) continue;
    const Link* back = FindLink(solution.links.links, link.source, link.receiver);
    if (!back) continue;
    ++diagnostics.link_pairs;
    diagnostics.link_reciprocity =
        std::max(diagnostics.link_reciprocity,
                 std::abs(flux - source.area * back->form_factor) / std::min(receiver.area, source.area));
  }
  std::stable_sort(exchanges.begin(), exchanges.end(), [](const Exchange& a, const Exchange& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  for (std::size_t begin = 0, end = 0; begin < exchanges.size(); begin = end) {
    const Exchange& pair = exchanges[begin];
    double difference = 0;
    for (;
         end < exchanges.size() && exchanges[end].first == pair.first && exchanges[end].second == pair.second;
         ++end)
      difference += exchanges[end].difference;
    ++diagnostics.patch_pairs;
    diagnostics.patch_reciprocity = std::max(
        diagnostics.patch_reciprocity,
        std::abs(difference) / std::min(scene.patches[pair.first].area, scene.patches[pair.second].area));
  }
  const std::vector<double> free_area = FreeAreas(scene, context);
  double flux = 0, area = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    diagnostics.covered_area += scene.patches[p].area - free_area[p];
    if (free_area[p] == 0) continue;
    flux += diagnostics.closure[p];
    double& closure = diagnostics.closure[p];
    closure /= free_area[p];
    diagnostics.closure_min = area == 0 ? closure : std::min(diagnostics.closure_min, closure);
    diagnostics.closure_max = std::max(diagnostics.closure_max, closure);
    area += free_area[p];
  }
  if (area > 0) diagnostics.closure_mean = flux / area;
  return diagnostics;
}

namespace {

// Numbers of rays, for each patch.
struct RayCounts {
  const std::vector<std::size_t>&away, &back, &covered;
};

void TellFronts(const Scene& scene, const RayCounts& counts, std::size_t rays_per_patch,
                ViewDiagnostics* diagnostics) {
  const auto rays = static_cast<double>(rays_per_patch);
  double area = 0, fronts = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const double covered = static_cast<double>(counts.covered[p]) / rays;
    diagnostics->covered_area += covered * scene.patches[p].area;
    if (counts.covered[p] == rays_per_patch) continue;
    const double lost = static_cast<double>(counts.away[p] + counts.back[p]) / rays;
    const double closure = 1 - lost / (1 - covered), free = (1 - covered) * scene.patches[p].area;
    diagnostics->fronts_min = area == 0 ? closure : std::min(diagnostics->fronts_min, closure);
    diagnostics->fronts_max = std::max(diagnostics->fronts_max, closure);
    fronts += free * closure;
    area += free;
  }
  if (area > 0) diagnostics->fronts_mean = fronts / area;
}

}  // namespace

ViewDiagnostics DiagnoseViews(const Scene& scene, std::size_t rays_per_patch, std::uint64_t seed,
                              const ExecutionContext& context) {
  ViewDiagnostics diagnostics;
  if (scene.patches.empty() || rays_per_patch == 0 || context.Cancelled()) return diagnostics;
  const RayCaster caster(scene);
  const double lift = ContactGap(scene);
  // For each patch: rays that hit nothing, rays that hit backs, and rays that start where something lies on
  // the patch.
  std::vector<std::size_t> away(scene.patches.size()), back(scene.patches.size()),
      covered(scene.patches.size());
  ParallelFor(scene.patches.size(), 8, [&](std::size_t p) {
    const auto id = static_cast<PatchId>(p);
    const Patch& patch = scene.patches[p];
    if (context.Cancelled()) return;
    for (std::size_t i = 0; i < rays_per_patch; ++i) {
      const DiffuseRay ray =
          MakeDiffuseRay(patch.Vertices(), patch.normal, lift, p * rays_per_patch + i, seed);
      const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, id);
      if (hit.patch == kNoPatch) ++away[p];
      if (hit.patch == kNoPatch || hit.front) continue;
      // Casts a ray through the patch from behind; the first ray started before the patch. A hit close to the
      // patch is something that lies on it.
      constexpr double kLiftsBehind = 3;
      const RayCaster::Hit lid =
          caster.Cast(ray.origin - kLiftsBehind * lift * patch.normal, patch.normal, id);
      ++(lid.patch != kNoPatch && lid.distance <= (kLiftsBehind + 1) * lift ? covered : back)[p];
    }
  });
  TellFronts(scene, {away, back, covered}, rays_per_patch, &diagnostics);
  double area = 0;
  std::map<std::int32_t, bool> blind;  // of faces with an uncovered part: true if they see only backs
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    area += scene.patches[p].area;
    diagnostics.escaping += scene.patches[p].area * static_cast<double>(away[p]);
    // Completely covered patches see nothing. A face is reversed only as a whole.
    if (covered[p] == rays_per_patch) continue;
    for (const std::int32_t face : scene.patches[p].faces) {
      const auto [at, is_new] = blind.emplace(face, true);
      at->second = at->second && back[p] + covered[p] == rays_per_patch;
    }
  }
  diagnostics.rays = scene.patches.size() * rays_per_patch;
  diagnostics.escaping /= area * static_cast<double>(rays_per_patch);
  for (const auto& [face, sees_backs] : blind)
    if (sees_backs) diagnostics.reversed_faces.push_back(face);
  return diagnostics;
}

std::vector<std::int32_t> DarkEmitters(const Scene& scene, std::size_t rays_per_patch, std::uint64_t seed) {
  const auto emits = [&](std::size_t p) {
    return (scene.MaterialOf(static_cast<PatchId>(p)).emittance > 0).any();
  };
  std::vector<char> lights(scene.patches.size(), 0);
  if (scene.patches.empty()) return {};
  const RayCaster caster(scene);
  ParallelFor(scene.patches.size(), 8, [&](std::size_t p) {
    const Patch& patch = scene.patches[p];
    for (std::size_t i = 0; emits(p) && i < rays_per_patch && !lights[p]; ++i) {
      // No lift: the object that hides the emitter may lie directly before it.
      const DiffuseRay ray = MakeDiffuseRay(patch.Vertices(), patch.normal, 0, p * rays_per_patch + i, seed);
      const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, static_cast<PatchId>(p));
      lights[p] = hit.patch != kNoPatch && hit.front;
    }
  });
  // A face lights something if one of its patches does.
  std::vector<char> dark(scene.faces.size(), 0);
  for (const bool light : {false, true})
    for (std::size_t p = 0; p < scene.patches.size(); ++p)
      if (emits(p) && (lights[p] != 0) == light)
        for (const std::int32_t face : scene.patches[p].faces) dark[static_cast<std::size_t>(face)] = !light;
  std::vector<std::int32_t> faces;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(dark.size()); ++f)
    if (dark[static_cast<std::size_t>(f)]) faces.push_back(f);
  return faces;
}

LitSides FindLitSides(const Scene& scene, std::size_t rays_per_patch, std::uint64_t seed) {
  // Rays from receivers find small lamps only by chance, and skies only from the side that emits.
  constexpr std::size_t kRaysOfEmitter = 1024;
  const RayCaster caster(scene);
  const double lift = ContactGap(scene);
  const auto emits = [&](PatchId p) { return (scene.MaterialOf(p).emittance > 0).any(); };
  struct Seen {
    bool front = false, back = false;  // an emitter sees this side
    std::vector<RayCaster::Hit> lit;   // hits of rays from this emitter
  };
  std::vector<Seen> seen(scene.patches.size());
  ParallelFor(seen.size(), 8, [&](std::size_t p) {
    const auto id = static_cast<PatchId>(p);
    const Patch& patch = scene.patches[p];
    const auto cast = [&](const Vec3& normal, std::size_t i) {
      const DiffuseRay ray = MakeDiffuseRay(patch.Vertices(), normal, lift, i, seed);
      return caster.Cast(ray.origin, ray.direction, id);
    };
    for (std::size_t i = 0; i < rays_per_patch; ++i)
      for (const bool front : {true, false}) {
        const RayCaster::Hit hit = cast(front ? patch.normal : Vec3(-patch.normal), p * rays_per_patch + i);
        if (hit.patch != kNoPatch && hit.front && emits(hit.patch))
          (front ? seen[p].front : seen[p].back) = true;
      }
    for (std::size_t i = 0; i < kRaysOfEmitter && emits(id); ++i)
      if (const RayCaster::Hit hit = cast(patch.normal, i); hit.patch != kNoPatch) seen[p].lit.push_back(hit);
  });
  for (std::size_t p = 0; p < seen.size(); ++p)
    for (const RayCaster::Hit& hit : seen[p].lit) {
      Seen& at = seen[static_cast<std::size_t>(hit.patch)];
      (hit.front ? at.front : at.back) = true;
    }
  LitSides sides;
  for (std::size_t p = 0; p < seen.size(); ++p) {
    if ((scene.MaterialOf(static_cast<PatchId>(p)).reflectance <= 0).all()) continue;
    if (seen[p].front)
      sides.front += scene.patches[p].area;
    else if (seen[p].back)
      sides.back += scene.patches[p].area;
  }
  return sides;
}

}  // namespace penumbra
