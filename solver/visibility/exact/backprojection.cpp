#include "solver/visibility/exact/backprojection.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

#include "solver/visibility/exact/exact_image.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Image = ExactImage<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Constrained_triangulation_face_base_2<Kernel>>,
    CGAL::Exact_predicates_tag>;

// For each place, the occluders that contain the place or whose outline passes through it: indices in
// image.occluders(), ascending.
std::vector<std::vector<std::int32_t>> OccludersAtPlaces(const Image& image) {
  std::vector<std::vector<std::int32_t>> at(image.places().size());
  for (std::size_t p = 0; p < at.size(); ++p) {
    const Image::Place& place = image.places()[p];
    for (std::size_t o = 0; o < image.occluders().size(); ++o) {
      const Image::Outline& outline = image.occluders()[o];
      if (!outline.box.Meets(place.box)) continue;
      bool inside = true;
      for (std::int32_t e = outline.first; e < outline.last && inside; ++e)
        inside = image.edges()[static_cast<std::size_t>(e)].line.oriented_side(place.point) != CGAL::NEGATIVE;
      if (inside) at[p].push_back(static_cast<std::int32_t>(o));
    }
  }
  return at;
}

// Edges are split at all places, so constraints do not cross.
void Triangulate(const Image& image, Cdt& cdt) {
  std::vector<Cdt::Vertex_handle> handle;
  Cdt::Face_handle hint;
  for (const Image::Place& place : image.places()) {
    const Cdt::Vertex_handle vertex = cdt.insert(place.point, hint);
    vertex->info() = static_cast<std::int32_t>(handle.size());
    hint = vertex->face();
    handle.push_back(vertex);
  }
  for (std::size_t e = 0; e < image.edges().size(); ++e) {
    const std::vector<std::int32_t>& on = image.PlacesOn(static_cast<std::int32_t>(e));
    for (std::size_t k = 1; k < on.size(); ++k)
      cdt.insert_constraint(handle[static_cast<std::size_t>(on[k - 1])],
                            handle[static_cast<std::size_t>(on[k])]);
  }
  PENUMBRA_CHECK(cdt.number_of_vertices() == image.places().size());
}

bool HaveCommon(const std::vector<std::int32_t>& a, const std::vector<std::int32_t>& b,
                const std::vector<std::int32_t>& c) {
  return std::any_of(a.begin(), a.end(), [&](std::int32_t o) {
    return std::binary_search(b.begin(), b.end(), o) && std::binary_search(c.begin(), c.end(), o);
  });
}

// Calls body(places, visible) for each triangle of the source's part.
template <class Body>
void ForEachTriangle(const Image& image, const Body& body) {
  if (image.empty()) return;
  Cdt cdt;
  Triangulate(image, cdt);
  const std::vector<std::vector<std::int32_t>> at = OccludersAtPlaces(image);
  // The hull of the places is the source's part. No outline crosses a triangle: a convex occluder that
  // contains the three vertices contains the triangle, and any other occluder contains no inner point of the
  // triangle.
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    std::array<std::int32_t, 3> place;
    for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(k)] = f->vertex(k)->info();
    const auto& [a, b, c] = place;
    body(place, !HaveCommon(at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)],
                            at[static_cast<std::size_t>(c)]));
  }
}

}  // namespace

double Backprojection::VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                         const Vec3& normal) const {
  double sum = 0;
  Image::ForEachPart(source, occluders, normal, min_segment_, [&](const Image& image) {
    const Vec3 base = image.plane().Base();
    ForEachTriangle(image, [&](const std::array<std::int32_t, 3>& place, bool visible) {
      if (!visible) return;
      std::array<Vec3, 3> offset;
      for (std::size_t k = 0; k < 3; ++k)
        offset[k] = image.plane().Lift(image.places()[static_cast<std::size_t>(place[k])].offset);
      sum += FormFactor(base, offset, normal);
    });
  });
  return sum;
}

BackprojectedSource Backprojection::Project(const DirectionPolygon& source,
                                            std::span<const Occluder> occluders, const Vec3& normal) const {
  BackprojectedSource result;
  Image::ForEachPart(source, occluders, normal, min_segment_, [&](const Image& image) {
    const auto first = static_cast<std::int32_t>(result.vertex.size());
    for (const Image::Place& place : image.places())
      result.vertex.emplace_back(image.plane().Base() + image.plane().Lift(place.offset));
    ForEachTriangle(image, [&](const std::array<std::int32_t, 3>& place, bool visible) {
      result.triangle.push_back({{first + place[0], first + place[1], first + place[2]}, visible});
    });
    for (std::size_t e = 0; e < image.edges().size(); ++e) {
      const EdgeOwner owner = image.edges()[e].owner;
      if (!owner.IsOccluder()) continue;
      const std::vector<std::int32_t>& on = image.PlacesOn(static_cast<std::int32_t>(e));
      for (std::size_t k = 1; k < on.size(); ++k)
        result.blocker_edge.push_back({first + on[k - 1], first + on[k], owner.OccluderNumber()});
    }
  });
  std::sort(result.blocker_edge.begin(), result.blocker_edge.end(), [](const auto& p, const auto& q) {
    return std::array{p.a, p.b, p.occluder} < std::array{q.a, q.b, q.occluder};
  });
  return result;
}

OcclusionRegistry::Method BackprojectionMethod() {
  return {"backprojection",
          "triangulates the source along the outlines of its blockers (thesis 6.2); exact",
          {"min-backprojection-segment"},
          [](const OcclusionOptions& options) {
            return std::make_unique<const Backprojection>(options.min_backprojection_segment);
          }};
}

}  // namespace penumbra
