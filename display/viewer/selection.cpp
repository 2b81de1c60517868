#include "display/viewer/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "display/glm_conversion.h"
#include "display/viewer/links.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/triangulation_overlay.h"

namespace penumbra::viewer {
namespace {

std::string Text(const Vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z()); }
std::string Text(const Rgb& c) { return fmt::format("{:.5g} {:.5g} {:.5g}", c[0], c[1], c[2]); }

std::string FaceName(const Scene& scene, std::int32_t face, PatchId patch) {
  const Patch& p = scene.patches[static_cast<std::size_t>(patch)];
  return fmt::format("{} ({})", face,
                     scene.objects.empty() ? std::string("no object")
                                           : scene.objects[static_cast<std::size_t>(p.object)].name);
}

std::string PatchName(const Scene& scene, PatchId patch) {
  return patch == kNoPatch ? "none" : FaceName(scene, FirstFace(scene, patch), patch);
}

const Link& SelectedLink(const OverlayContext& context) {
  return context.snapshot.light->solution().links.links[static_cast<std::size_t>(context.selection.index)];
}

const Discontinuity& SelectedDiscontinuity(const OverlayContext& context) {
  return context.results.discontinuities->all[static_cast<std::size_t>(context.selection.index)];
}

std::vector<std::string> DescribeElement(const OverlayContext& context, ElementId id) {
  const RadiositySolution& solution = context.snapshot.light->solution();
  const Element& element = solution.forest[id];
  const auto i = static_cast<std::size_t>(id);
  std::size_t gathering = 0, leaves = 0;
  for (const Link& link : solution.links.links) gathering += link.receiver == id ? 1 : 0;
  solution.forest.ForEachBelow(id, [&](ElementId e) { leaves += solution.forest[e].IsLeaf() ? 1 : 0; });
  const Material& material = context.snapshot.scene->MaterialOf(element.patch);
  return {fmt::format("element {} of patch {}", id, PatchName(*context.snapshot.scene, element.patch)),
          fmt::format("level {}, {}", element.level,
                      element.IsLeaf() ? std::string("a leaf") : fmt::format("{} leaves", leaves)),
          fmt::format("area {:.5g} m^2", element.area),
          fmt::format("irradiance {} W/m^2", Text(solution.irradiance[i])),
          fmt::format("radiosity {} W/m^2", Text(solution.radiosity[i])),
          fmt::format("reflectance {}", Text(material.reflectance)),
          fmt::format("emittance {} W/m^2", Text(material.emittance)),
          fmt::format("{} links to it", gathering)};
}

std::vector<std::string> DescribeLink(const OverlayContext& context) {
  const RadiositySolution& solution = context.snapshot.light->solution();
  const Link& link = SelectedLink(context);
  std::vector<std::string> lines = {
      fmt::format("{} {}", context.selection.kind == SelectionKind::kTube ? "tube of link" : "link",
                  context.selection.index),
      fmt::format("receiver: element {} of {}", link.receiver,
                  PatchName(*context.snapshot.scene, solution.forest[link.receiver].patch)),
      fmt::format("source: element {} of {}", link.source,
                  PatchName(*context.snapshot.scene, solution.forest[link.source].patch)),
      fmt::format("{}", NameOf(ClassOf(solution, link))),
      fmt::format("form factor {:.6g}", link.form_factor),
      fmt::format("variation {:.3g}", link.variation),
      fmt::format("brings {:.5g} W/m^2", LinkIrradiance(solution, link)),
      fmt::format("{} blockers", link.blocker_count)};
  if (context.selection.kind == SelectionKind::kTube)
    for (const PatchId blocker : solution.links.Blockers(link))
      lines.push_back(fmt::format("  blocker {}", PatchName(*context.snapshot.scene, blocker)));
  return lines;
}

std::vector<std::string> DescribeTriangle(const OverlayContext& context) {
  const IrradianceMesh& mesh = context.mesh.mesh();
  const auto i = static_cast<std::uint32_t>(context.selection.index);
  std::vector<std::string> lines = {
      fmt::format("triangle {} of patch {}", i, PatchName(*context.snapshot.scene, mesh.triangles[i].patch)),
      fmt::format("area {:.5g} m^2", TriangleArea(mesh, i))};
  for (const Vec3& v : TriangleVertices(mesh, i)) lines.push_back("vertex " + Text(v));
  for (const auto& [s, t] : kSampleAt)
    lines.push_back(
        fmt::format("irradiance at ({:g}, {:g}): {} W/m^2", s, t, Text(mesh.irradiance[i].At(s, t))));
  const auto& edges = mesh.triangles[i].discontinuity;
  lines.push_back(fmt::format("{} discontinuity edges", std::count(edges.begin(), edges.end(), true)));
  if (context.results.error_map && i < context.results.error_map->error.size())
    lines.push_back(
        fmt::format("representation error {:.3g}", static_cast<double>(context.results.error_map->error[i])));
  return lines;
}

// Without a default: the compiler tells which kind has no name.
const char* NameOf(DiscontinuityKind kind) {
  switch (kind) {
    case DiscontinuityKind::kVE:
      return "VE";
    case DiscontinuityKind::kEV:
      return "EV";
    case DiscontinuityKind::kHorizon:
      return "horizon";
    case DiscontinuityKind::kContact:
      return "contact";
    case DiscontinuityKind::kEEE:
      return "EEE";
    case DiscontinuityKind::kNear:
      return "near";
  }
  return "";
}

const char* NameOf(DiscontinuityDegree degree) {
  switch (degree) {
    case DiscontinuityDegree::kD0:
      return "D0: the irradiance jumps";
    case DiscontinuityDegree::kD1:
      return "D1: its slope jumps";
    case DiscontinuityDegree::kD2:
      return "D2: its curvature jumps";
  }
  return "";
}

std::vector<std::string> DescribeDiscontinuity(const OverlayContext& context) {
  const Discontinuity& d = SelectedDiscontinuity(context);
  const Scene& scene = *context.snapshot.scene;
  const auto& ends = context.results.discontinuities->ends[static_cast<std::size_t>(context.selection.index)];
  return {fmt::format("discontinuity {}: {}", context.selection.index, NameOf(d.kind)),
          NameOf(d.degree),
          "source: " + PatchName(scene, d.source),
          "blocker: " + PatchName(scene, d.blocker),
          "receiver: " + PatchName(scene, d.receiver),
          fmt::format("weight {:.4g} W/m^2 (geometric {:.3g})", d.weight, d.geometric_weight),
          fmt::format("from {} to {}", Text(ends[0]), Text(ends[1]))};
}

std::vector<std::string> DescribePart(const OverlayContext& context) {
  const Scene& scene = *context.snapshot.scene;
  const auto index = static_cast<std::size_t>(context.selection.index);
  const bool object = context.selection.kind == SelectionKind::kObject;
  const std::vector<PatchId> patches = PatchesOf(scene, context.selection);
  double area = 0;
  Rgb light = Rgb::Zero();
  for (const PatchId p : patches) {
    const double a = scene.patches[static_cast<std::size_t>(p)].area;
    area += a;
    if (context.snapshot.light)
      light += a * context.snapshot.light->solution().irradiance[static_cast<std::size_t>(p)];
  }
  std::vector<std::string> lines = {
      object ? "object " + scene.objects[index].name : "material " + scene.materials[index].name,
      fmt::format("{} patches, {:.5g} m^2", patches.size(), area)};
  if (context.snapshot.light && area > 0)
    lines.push_back(fmt::format("mean irradiance {} W/m^2", Text(Rgb(light / area))));
  if (object) return lines;
  lines.push_back(fmt::format("reflectance {}", Text(scene.materials[index].reflectance)));
  lines.push_back(fmt::format("emittance {} W/m^2", Text(scene.materials[index].emittance)));
  return lines;
}

}  // namespace

std::optional<ProbedPoint> PointAt(const Scene& scene, const IrradianceMesh& drawn,
                                   const RenderedFrame& frame, const PixelRays& rays, double x, double y) {
  if (!(x >= 0 && x < frame.width && y >= 0 && y < frame.height)) return std::nullopt;
  const auto px = static_cast<int>(x), py = static_cast<int>(y);
  const std::uint32_t id = frame.triangle[frame.linear.Index(px, py)];
  if (id == kNoTriangle) return std::nullopt;
  const PatchId patch = drawn.triangles[id].patch;
  const Patch& p = scene.patches[static_cast<std::size_t>(patch)];
  const Vec3 eye = ToEigen(rays.eye), direction = ToEigen(rays.Direction(px + 0.5, py + 0.5));
  const double depth = p.normal.dot(p.vertex[0] - eye) / p.normal.dot(direction);
  if (!std::isfinite(depth)) return std::nullopt;
  return ProbedPoint{patch, eye + depth * direction};
}

Selection SelectSurface(const OverlayContext& context, const ProbedPoint& at) {
  if (!context.snapshot.light) return {SelectionKind::kElement, ElementForest::Root(at.patch)};
  if (context.settings.Shows(kTrianglesSwitch) || context.selection.kind == SelectionKind::kTriangle)
    if (const auto place = context.mesh.Locator().Find(at.patch, at.position))
      return {SelectionKind::kTriangle, place->triangle};
  const ElementForest& forest = context.snapshot.light->solution().forest;
  const ElementId root = ElementForest::Root(at.patch);
  if (context.selection.kind != SelectionKind::kElement) return {SelectionKind::kElement, root};
  const auto top = static_cast<ElementId>(context.selection.index);
  ElementId below = forest.LeafAt(at.patch, at.position);
  if (below == top) return context.selection;
  if (!IsBelow(forest, below, top)) return {SelectionKind::kElement, root};
  while (forest[below].parent != top) below = forest[below].parent;
  return {SelectionKind::kElement, below};
}

Selection SelectLine(const Selection& before, const Selection& picked) {
  const bool again = picked.kind == SelectionKind::kLink && picked.index == before.index &&
                     (before.kind == SelectionKind::kLink || before.kind == SelectionKind::kTube);
  return again ? Selection{SelectionKind::kTube, picked.index} : picked;
}

bool IsValid(const OverlayContext& context, const Selection& selection) {
  const auto index = static_cast<std::size_t>(selection.index);
  const LightState* light = context.snapshot.light.get();
  switch (selection.kind) {
    case SelectionKind::kNone:
      return true;
    case SelectionKind::kElement:
      return index < (light ? light->solution().forest.size() : context.snapshot.scene->patches.size());
    case SelectionKind::kLink:
    case SelectionKind::kTube:
      return light && index < light->solution().links.links.size();
    case SelectionKind::kTriangle:
      return index < context.mesh.mesh().triangles.size();
    case SelectionKind::kDiscontinuity:
      return context.results.discontinuities && index < context.results.discontinuities->all.size();
    case SelectionKind::kObject:
      return index < context.snapshot.scene->objects.size();
    case SelectionKind::kMaterial:
      return index < context.snapshot.scene->materials.size();
  }
  return false;
}

std::vector<PatchId> PatchesOf(const Scene& scene, const Selection& part) {
  std::vector<PatchId> patches;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const std::int32_t of =
        part.kind == SelectionKind::kObject ? scene.patches[p].object : scene.patches[p].material;
    if (of == part.index) patches.push_back(static_cast<PatchId>(p));
  }
  return patches;
}

std::vector<ElementId> SelectedElements(const OverlayContext& context) {
  std::vector<ElementId> elements;
  if (!IsValid(context, context.selection)) return elements;
  switch (context.selection.kind) {
    case SelectionKind::kNone:
    case SelectionKind::kTriangle:
      break;
    case SelectionKind::kElement:
      elements.push_back(static_cast<ElementId>(context.selection.index));
      break;
    case SelectionKind::kTube:
      for (const PatchId blocker : context.snapshot.light->solution().links.Blockers(SelectedLink(context)))
        elements.push_back(ElementForest::Root(blocker));
      [[fallthrough]];
    case SelectionKind::kLink:
      elements.push_back(SelectedLink(context).source);
      elements.push_back(SelectedLink(context).receiver);
      break;
    case SelectionKind::kDiscontinuity: {
      const Discontinuity& d = SelectedDiscontinuity(context);
      for (const PatchId patch : {d.source, d.blocker, d.receiver})
        if (patch != kNoPatch) elements.push_back(ElementForest::Root(patch));
      break;
    }
    case SelectionKind::kObject:
    case SelectionKind::kMaterial:
      for (const PatchId patch : PatchesOf(*context.snapshot.scene, context.selection))
        elements.push_back(ElementForest::Root(patch));
      break;
  }
  return elements;
}

std::vector<std::uint32_t> IsolatedTriangles(const OverlayContext& context, const IrradianceMesh& drawn) {
  if (context.selection.kind == SelectionKind::kTriangle) {
    if (&drawn != &context.mesh.mesh() || !IsValid(context, context.selection)) return {};
    return {static_cast<std::uint32_t>(context.selection.index)};
  }
  const std::vector<ElementId> elements = SelectedElements(context);
  if (context.snapshot.light) return TrianglesOf(*context.snapshot.light, drawn, elements);
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i < drawn.triangles.size(); ++i)
    if (std::find(elements.begin(), elements.end(), drawn.triangles[i].patch) != elements.end())
      triangles.push_back(i);
  return triangles;
}

std::vector<std::string> DescribeSelection(const OverlayContext& context) {
  if (!IsValid(context, context.selection)) return {};
  switch (context.selection.kind) {
    case SelectionKind::kNone:
      return {};
    case SelectionKind::kElement:
      if (context.snapshot.light)
        return DescribeElement(context, static_cast<ElementId>(context.selection.index));
      return {"patch " + PatchName(*context.snapshot.scene, static_cast<PatchId>(context.selection.index))};
    case SelectionKind::kLink:
    case SelectionKind::kTube:
      return DescribeLink(context);
    case SelectionKind::kTriangle:
      return DescribeTriangle(context);
    case SelectionKind::kDiscontinuity:
      return DescribeDiscontinuity(context);
    case SelectionKind::kObject:
    case SelectionKind::kMaterial:
      return DescribePart(context);
  }
  return {};
}

std::string DescribePlace(const ProbedPoint& at, const Scene& scene) {
  return fmt::format("at {} on patch {}", Text(at.position),
                     FaceName(scene, scene.FaceAt(at.patch, at.position), at.patch));
}

std::vector<std::string> DescribeProbe(const ProbeResult& probe, const Scene& scene) {
  constexpr std::size_t kMostSources = 12;
  std::vector<std::string> lines = {"at " + Text(probe.at.position),
                                    "on patch " + FaceName(scene, probe.face, probe.at.patch),
                                    fmt::format("analytic {} W/m^2", Text(probe.exact))};
  if (probe.interpolated) {
    lines.push_back(fmt::format("interpolated {} W/m^2", Text(*probe.interpolated)));
    lines.push_back(fmt::format("difference {} W/m^2", Text(Rgb(*probe.interpolated - probe.exact))));
  }
  const std::vector<PatchContribution>& sources = probe.sources;
  lines.push_back(fmt::format("from {} sources:", sources.size()));
  Rgb others = Rgb::Zero();
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (i < kMostSources)
      lines.push_back(
          fmt::format("  {}: {}", PatchName(scene, sources[i].source), Text(sources[i].irradiance)));
    else
      others += sources[i].irradiance;
  if (sources.size() > kMostSources)
    lines.push_back(fmt::format("  {} others: {}", sources.size() - kMostSources, Text(others)));
  return lines;
}

}  // namespace penumbra::viewer
