// mesh/pipeline/solution_schema.h
//
// The layout of a solution file. Each Describe function writes data if `archive` is an ArchiveWriter, and
// reads data if it is an ArchiveReader (solution_archive.h). Every change of the layout must increment
// kSolutionSchema (solution_file.h).

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/pipeline/discontinuity_list.h"
#include "mesh/pipeline/solution_archive.h"
#include "mesh/refinement/emitter_light.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

template <class Archive, class SceneType>
void DescribeScene(Archive& archive, SceneType& scene) {
  Table(archive, "scene/materials", scene.materials)
      .Column("reflectance", &Material::reflectance)
      .Column("emittance", &Material::emittance)
      .Lists("name", &Material::name);
  Table(archive, "scene/objects", scene.objects).Lists("name", &Object::name).Lists("faces", &Object::faces);
  Table(archive, "scene/faces", scene.faces)
      .Column("material", &Face::material)
      .Column("object", &Face::object)
      .Lists("vertices", &Face::vertices);
  Table(archive, "scene/patches", scene.patches)
      .Column("vertices", &Patch::vertex)
      .Column("size", &Patch::size)
      .Column("material", &Patch::material)
      .Column("object", &Patch::object)
      .Lists("faces", &Patch::faces);
  Table(archive, "scene/cameras", scene.cameras)
      .Column("eye", &Camera::eye)
      .Column("look_at", &Camera::look_at)
      .Column("up", &Camera::up)
      .Column("vertical_fov", &Camera::vertical_fov)
      .Lists("name", &Camera::name);
  Table(archive, "scene/warnings", scene.warnings).Lists("text", std::identity());
  archive.Text("scene/name", scene.name);
}

template <class Archive, class Rows>
void DescribeVisibility(Archive& archive, Rows& rows) {
  Table(archive, "visibility/receivers", rows.first).Column("first_pair", std::identity());
  Table(archive, "visibility/pairs", rows.pairs)
      .Column("source", &PatchPair::source)
      .Column("visibility", &PatchPair::visibility)
      .Column("first_blocker", &PatchPair::first_blocker)
      .Column("blocker_count", &PatchPair::blocker_count);
  Table(archive, "visibility/blockers", rows.blockers).Column("patch", std::identity());
}

// The positions of quadtree elements are not stored, because they follow from the patches and the integer
// lattice coordinates of the elements' corners.
template <class Archive, class Elements>
void DescribeElements(Archive& archive, Elements& elements) {
  Table(archive, "elements", elements)
      .Column("patch", &Element::patch)
      .Column("parent", &Element::parent)
      .Column("first_child", &Element::first_child)
      .Column("level", &Element::level)
      .Column("corners", &Element::corner);
}

// Describes all parts of a radiosity solution except its quadtree elements.
template <class Archive, class Solution>
void DescribeLight(Archive& archive, Solution& solution) {
  Table(archive, "elements", solution.irradiance).Column("irradiance", std::identity());
  Table(archive, "elements", solution.radiosity).Column("radiosity", std::identity());
  Table(archive, "elements", solution.radiosity_spread).Column("radiosity_spread", std::identity());
  Table(archive, "elements", solution.spread_below).Column("spread_below", std::identity());
  Table(archive, "links", solution.links.links)
      .Column("receiver", &Link::receiver)
      .Column("source", &Link::source)
      .Column("form_factor", &Link::form_factor)
      .Column("variation", &Link::variation)
      .Column("share", &Link::share)
      .Column("source_variation", &Link::source_variation)
      .Column("visibility", &Link::visibility)
      .Column("first_blocker", &Link::first_blocker)
      .Column("blocker_count", &Link::blocker_count);
  Table(archive, "links/blockers", solution.links.blockers).Column("patch", std::identity());
  Table(archive, "fragments", solution.fragments)
      .Column("leaf", &Fragment::leaf)
      .Column("area", &Fragment::area)
      .Column("irradiance", &Fragment::irradiance)
      .Column("radiosity", &Fragment::radiosity)
      .Lists("polygon", &Fragment::polygon);
  std::vector<std::uint64_t> rays = {solution.rays_per_point};
  Table(archive, "gathering", rays).Column("rays_per_point", std::identity());
  if constexpr (!std::is_const_v<Solution>) solution.rays_per_point = rays.size() == 1 ? rays[0] : 0;
}

// `kind` is a vector that contains one MeshKind.
template <class Archive, class Mesh, class Kind>
void DescribeMesh(Archive& archive, Mesh& mesh, Kind& kind) {
  Table(archive, "mesh", kind).Column("kind", std::identity());
  Table(archive, "mesh", mesh.positions).Column("positions", std::identity());
  Table(archive, "mesh/triangles", mesh.triangles)
      .Column("vertices", &IrradianceMesh::Triangle::vertex)
      .Column("patch", &IrradianceMesh::Triangle::patch)
      .Column("discontinuity", &IrradianceMesh::Triangle::discontinuity);
  Table(archive, "mesh/triangles", mesh.irradiance).Column("interpolant", std::identity());
}

// Describes the texture coordinates of faces, which are empty where the scene's file gave none.
template <class Archive, class Faces>
void DescribeTextureCoordinates(Archive& archive, Faces& faces) {
  Table(archive, "scene/faces", faces).Lists("texture_coordinates", &Face::uv);
}

// Describes the light of each emitter; the table has no rows if the light of each emitter was not kept.
template <class Archive, class Emitters>
void DescribeEmitters(Archive& archive, Emitters& emitters) {
  Table(archive, "emitters", emitters)
      .Lists("patches", &EmitterLight::patches)
      .Lists("element_irradiance", &EmitterLight::element)
      .Lists("fragment_irradiance", &EmitterLight::fragment)
      .Lists("interpolant", &EmitterLight::interpolant);
}

// Discontinuities are stored only for other programs. Penumbra does not read the stored discontinuities, but
// computes discontinuities again.
inline void DescribeDiscontinuities(ArchiveWriter& archive, const DiscontinuityList& list) {
  Table(archive, "discontinuities", list.ends).Column("ends", std::identity());
  Table(archive, "discontinuities", list.all)
      .Column("receiver", &Discontinuity::receiver)
      .Column("source", &Discontinuity::source)
      .Column("blocker", &Discontinuity::blocker)
      .Column("kind", &Discontinuity::kind)
      .Column("degree", &Discontinuity::degree)
      .Column("source_part", &Discontinuity::source_part)
      .Column("blocker_part", &Discontinuity::blocker_part)
      .Column("geometric_weight", &Discontinuity::geometric_weight)
      .Column("weight", &Discontinuity::weight);
}

}  // namespace penumbra
