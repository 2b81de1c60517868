#include "mesh/pipeline/solution_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh/pipeline/hdf5_image.h"
#include "solver/scene/scene_assembler.h"

namespace penumbra {
namespace {

void Demand(bool holds, const char* what) {
  if (!holds) throw Hdf5Error(what);
}

template <class Index>
bool IsIndex(Index index, std::size_t count) {
  return std::cmp_greater_equal(index, 0) && std::cmp_less(index, count);
}

bool AreIndices(const auto& indices, std::size_t count) {
  return std::all_of(indices.begin(), indices.end(), [&](auto index) { return IsIndex(index, count); });
}

bool IsFinite(const Vec3& v) { return v.allFinite(); }
bool IsLight(const Rgb& rgb) { return rgb.allFinite() && rgb.minCoeff() >= 0; }
bool IsAmount(double x) { return std::isfinite(x) && x >= 0; }

bool All(const auto& values, const auto& holds) { return std::all_of(values.begin(), values.end(), holds); }

}  // namespace

void CheckScene(const Scene& scene) {
  for (const Material& material : scene.materials)
    Demand(
        IsLight(material.reflectance) && material.reflectance.maxCoeff() < 1 && IsLight(material.emittance),
        "a material is none");
  for (const Face& face : scene.faces) {
    Demand(IsIndex(face.material, scene.materials.size()), "a face has no material");
    Demand(IsIndex(face.object, scene.objects.size()), "a face has no object");
    Demand(face.vertices.empty() || (face.vertices.size() >= 3 && All(face.vertices, IsFinite)),
           "a face is no polygon");
    Demand(face.uv.empty() || (face.uv.size() == face.vertices.size() &&
                               All(face.uv, [](const Vec2& place) { return place.allFinite(); })),
           "a face has other texture coordinates than vertices");
  }
  for (const Object& object : scene.objects)
    Demand(AreIndices(object.faces, scene.faces.size()), "an object has faces that are not there");
  for (const Patch& patch : scene.patches) {
    Demand((patch.size == 3 || patch.size == 4) && All(patch.Vertices(), IsFinite), "a patch is no polygon");
    const double area = VectorArea(patch.Vertices()).norm();
    Demand(std::isfinite(area) && area > 0, "a patch has no area");
    Demand(IsIndex(patch.material, scene.materials.size()), "a patch has no material");
    Demand(IsIndex(patch.object, scene.objects.size()), "a patch has no object");
    Demand(!patch.faces.empty() && AreIndices(patch.faces, scene.faces.size()) &&
               All(patch.faces, [&](std::int32_t face) { return !scene.faces[face].vertices.empty(); }),
           "a patch has no face");
  }
  for (const Camera& camera : scene.cameras)
    Demand(IsFinite(camera.eye) && IsFinite(camera.look_at) && IsFinite(camera.up) &&
               std::isfinite(camera.vertical_fov),
           "a camera has no place");
}

void CheckVisibility(const Scene& scene, const PatchVisibility::Rows& rows) {
  const std::size_t count = scene.patches.size();
  Demand(rows.first.size() == count + 1 && rows.first.front() == 0 &&
             rows.first.back() == rows.pairs.size() && std::is_sorted(rows.first.begin(), rows.first.end()),
         "the rows of visible patches do not divide the pairs");
  for (const PatchPair& pair : rows.pairs) {
    Demand(IsIndex(pair.source, count), "a pair of patches has no source");
    Demand(std::uint64_t{pair.first_blocker} + pair.blocker_count <= rows.blockers.size(),
           "a pair of patches has blockers that are not there");
  }
  Demand(AreIndices(rows.blockers, count), "a blocker is no patch");
}

ElementForest RestoreForest(const Scene& scene, std::span<const Element> elements) {
  const char* const kNoForest = "the elements do not form quadtrees";
  ElementForest forest(scene);
  std::vector<std::pair<ElementId, ElementId>> splits;  // first child, element
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (!elements[i].IsLeaf()) splits.emplace_back(elements[i].first_child, static_cast<ElementId>(i));
  std::sort(splits.begin(), splits.end());
  Demand(elements.size() == forest.size() + 4 * splits.size(), kNoForest);
  for (const auto& [first_child, id] : splits) {
    Demand(IsIndex(id, forest.size()) && forest[id].IsLeaf() && forest[id].level < kMaxLevel, kNoForest);
    Demand(forest.Subdivide(id) == first_child, kNoForest);
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Element &stored = elements[i], &made = forest.elements()[i];
    Demand(stored.patch == made.patch && stored.parent == made.parent && stored.level == made.level &&
               stored.corner == made.corner,
           kNoForest);
  }
  return forest;
}

void CheckLight(const RadiositySolution& solution) {
  const std::size_t elements = solution.forest.size(), patches = solution.forest.scene().patches.size();
  Demand(solution.irradiance.size() == elements && solution.radiosity.size() == elements &&
             solution.radiosity_spread.size() == elements && solution.spread_below.size() == elements,
         "not every element has its light");
  const auto is_finite = [](const Rgb& rgb) { return rgb.allFinite(); };
  Demand(All(solution.irradiance, is_finite) && All(solution.radiosity, is_finite) &&
             All(solution.radiosity_spread, IsAmount) && All(solution.spread_below, IsAmount),
         "an element's light is no number");
  Demand(solution.rays_per_point <= kMostRaysPerPoint, "its points gather along too many rays");
  for (const Link& link : solution.links.links) {
    Demand(IsIndex(link.receiver, elements) && IsIndex(link.source, elements), "a link has no ends");
    Demand(std::isfinite(link.form_factor) && IsAmount(link.variation) &&
               std::isfinite(link.source_variation) &&
               All(link.share, [](float share) { return std::isfinite(share); }),
           "a link's form factor is no number");
    Demand(std::uint64_t{link.first_blocker} + link.blocker_count <= solution.links.blockers.size(),
           "a link has blockers that are not there");
  }
  Demand(AreIndices(solution.links.blockers, patches), "a link's blocker is no patch");
  ElementId last = 0;
  for (const Fragment& fragment : solution.fragments) {
    Demand(
        IsIndex(fragment.leaf, elements) && solution.forest[fragment.leaf].IsLeaf() && fragment.leaf >= last,
        "a fragment has no leaf");
    Demand(fragment.polygon.size() >= 3 && All(fragment.polygon, IsFinite) && IsAmount(fragment.area),
           "a fragment is no polygon");
    Demand(is_finite(fragment.irradiance) && is_finite(fragment.radiosity),
           "a fragment's light is no number");
    last = fragment.leaf;
  }
}

void CheckMesh(const Scene& scene, const IrradianceMesh& mesh) {
  const auto has_place = [](const Vec3& v) { return IsFinite(v) && MaxAbs(v) <= kLargestCoordinate; };
  Demand(All(mesh.positions, has_place), "a vertex of the mesh has no place");
  PatchId last = 0;
  for (const IrradianceMesh::Triangle& triangle : mesh.triangles) {
    Demand(AreIndices(triangle.vertex, mesh.positions.size()), "a triangle has no vertices");
    Demand(IsIndex(triangle.patch, scene.patches.size()) && triangle.patch >= last,
           "a triangle has no patch");
    last = triangle.patch;
  }
  Demand(mesh.irradiance.size() == mesh.triangles.size(), "not every triangle has an interpolant");
  // The largest value that an interpolant may have on its triangle is a number.
  for (const QuadraticInterpolant& q : mesh.irradiance)
    Demand((q.a.abs() + q.b2.abs() + q.c2.abs() + q.d.abs() + q.e2.abs() + q.f.abs()).isFinite().all(),
           "an interpolant is no number");
}

void CheckEmitters(const RadiositySolution& solution, const IrradianceMesh& mesh,
                   std::span<const EmitterLight> emitters) {
  const std::size_t patches = solution.forest.scene().patches.size();
  std::vector<bool> taken(patches, false);
  for (const EmitterLight& light : emitters) {
    for (const PatchId patch : light.patches) {
      Demand(IsIndex(patch, patches) && !taken[static_cast<std::size_t>(patch)],
             "an emitter consists of patches that are not its own");
      taken[static_cast<std::size_t>(patch)] = true;
    }
    Demand(light.element.size() == solution.forest.size() &&
               light.fragment.size() == solution.fragments.size() &&
               light.interpolant.size() == mesh.triangles.size(),
           "an emitter does not light everything");
    const auto is_finite = [](const Rgb& rgb) { return rgb.allFinite(); };
    Demand(All(light.element, is_finite) && All(light.fragment, is_finite) &&
               All(light.interpolant,
                   [&](const QuadraticInterpolant& q) {
                     return is_finite(q.a) && is_finite(q.b2) && is_finite(q.c2) && is_finite(q.d) &&
                            is_finite(q.e2) && is_finite(q.f);
                   }),
           "an emitter's light is no number");
  }
}

}  // namespace penumbra
