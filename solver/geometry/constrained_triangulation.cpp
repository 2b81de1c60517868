#include "solver/geometry/constrained_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "solver/base/check.h"
#include "solver/base/size.h"

namespace penumbra {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
// Nothing may be left to cross: the splitter computes all crossings.
using Cdt =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Triangle = ConstrainedTriangulation::Triangle;

// A face of CGAL's and its vertices, turned so that the smallest comes first.
struct FoundFace {
  std::array<std::int32_t, 3> vertex;
  Cdt::Face_handle face;
  int first;  // CGAL's number of vertex[0]
};

// By how much the winding number of the tag is greater on the triangle's side of its edge k than beyond it.
std::int32_t WindingStep(const ConstrainedTriangulation& mesh, const Triangle& triangle, int k,
                         std::span<const ConstraintSegment> constraints, std::int32_t tag) {
  if (triangle.edge[k] < 0) return 0;
  const bool along = triangle.vertex[k] < triangle.vertex[(k + 1) % 3];
  std::int32_t step = 0;
  for (const ConstrainedTriangulation::Cover& cover : mesh.Covers(mesh.edges[triangle.edge[k]]))
    if (constraints[cover.constraint].tag == tag) step += cover.forward == along ? 1 : -1;
  return step;
}

// Floods the triangles from outside the convex hull, where the number is 0.
void FloodWinding(const ConstrainedTriangulation& mesh, std::span<const ConstraintSegment> constraints,
                  std::int32_t tag, std::vector<std::int32_t>& winding, std::vector<std::int32_t>& stack) {
  constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::min();
  winding.assign(mesh.triangles.size(), kUnknown);
  stack.clear();
  for (std::int32_t t = 0; t < Size(mesh.triangles); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    for (int k = 0; k < 3 && winding[t] == kUnknown; ++k)
      if (triangle.neighbor[k] < 0) winding[t] = WindingStep(mesh, triangle, k, constraints, tag);
    if (winding[t] != kUnknown) stack.push_back(t);
  }
  while (!stack.empty()) {
    const std::int32_t t = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const std::int32_t next = mesh.triangles[t].neighbor[k];
      if (next < 0 || winding[next] != kUnknown) continue;
      winding[next] = winding[t] - WindingStep(mesh, mesh.triangles[t], k, constraints, tag);
      stack.push_back(next);
    }
  }
}

}  // namespace

struct ConstrainedTriangulator::Impl {
  Cdt cdt;
  SegmentSplitter splitter;
  ConstrainedTriangulation result;
  std::vector<SegmentPiece> pieces;
  std::vector<bool> used;
  std::vector<std::int32_t> first_at;  // of each input point, the first point in the same place
  std::vector<std::int32_t> order;
  std::vector<Cdt::Vertex_handle> handle;
  std::vector<FoundFace> found;
  std::vector<std::int32_t> winding, stack;

  void MergeEqualPoints();
  void CollectPieces(std::span<const ConstraintSegment> constraints);
  double SnapDistance() const;
  void BuildEdges();
  bool InsertAll();
  void ExtractTriangles();
  void MarkEdges(std::span<const ConstraintSegment> constraints);
  void MarkInside(std::span<const ConstraintSegment> constraints);
  bool TriangulatePieces(std::span<const ConstraintSegment> constraints);
};

void ConstrainedTriangulator::Impl::MergeEqualPoints() {
  const std::vector<Vec2>& points = result.vertices;
  order.resize(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    if (points[a].x() != points[b].x()) return points[a].x() < points[b].x();
    if (points[a].y() != points[b].y()) return points[a].y() < points[b].y();
    return a < b;
  });
  first_at.resize(points.size());
  used.assign(points.size(), true);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool repeated = k > 0 && points[order[k]] == points[order[k - 1]];
    first_at[order[k]] = repeated ? first_at[order[k - 1]] : order[k];
    if (repeated) used[order[k]] = false;
  }
}

void ConstrainedTriangulator::Impl::CollectPieces(std::span<const ConstraintSegment> constraints) {
  pieces.clear();
  for (std::int32_t i = 0; i < Size(constraints); ++i) {
    const std::int32_t from = first_at[constraints[i].from], to = first_at[constraints[i].to];
    if (from != to) pieces.push_back({from, to, i});
  }
}

double ConstrainedTriangulator::Impl::SnapDistance() const {
  if (result.vertices.empty()) return 0;
  Vec2 low = result.vertices.front(), high = low;
  for (const Vec2& p : result.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  // Far from the origin the coordinates' own rounding takes over.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  return std::max(kSnapDistance * (high - low).maxCoeff(), kRounding * largest);
}

// Groups the pieces by the pair of vertices that they join.
void ConstrainedTriangulator::Impl::BuildEdges() {
  const auto key = [](const SegmentPiece& p) {
    return std::array{std::min(p.from, p.to), std::max(p.from, p.to), p.source, p.from};
  };
  std::sort(pieces.begin(), pieces.end(),
            [&](const SegmentPiece& p, const SegmentPiece& q) { return key(p) < key(q); });
  result.edges.clear();
  result.covers.clear();
  for (const SegmentPiece& piece : pieces) {
    const auto [a, b, source, from] = key(piece);
    if (result.edges.empty() || result.edges.back().a != a || result.edges.back().b != b)
      result.edges.push_back({a, b, Size(result.covers), 0});
    result.covers.push_back({source, from == a});
    ++result.edges.back().count;
  }
}

// False if pieces cross.
bool ConstrainedTriangulator::Impl::InsertAll() {
  cdt.clear();
  handle.assign(result.vertices.size(), {});
  Cdt::Face_handle hint;
  std::size_t count = 0;
  for (std::int32_t v = 0; v < Size(result.vertices); ++v) {
    if (!used[v]) continue;
    if (!result.vertices[v].allFinite()) return false;
    handle[v] = cdt.insert(Kernel::Point_2(result.vertices[v].x(), result.vertices[v].y()), hint);
    handle[v]->info() = v;
    hint = handle[v]->face();
    ++count;
  }
  if (cdt.number_of_vertices() != count) return false;
  try {
    for (const ConstrainedTriangulation::Edge& edge : result.edges)
      cdt.insert_constraint(handle[edge.a], handle[edge.b]);
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

void ConstrainedTriangulator::Impl::ExtractTriangles() {
  found.clear();
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = -1;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    int first = 0;
    for (int k = 1; k < 3; ++k)
      if (f->vertex(k)->info() < f->vertex(first)->info()) first = k;
    found.push_back(
        {{f->vertex(first)->info(), f->vertex(Cdt::ccw(first))->info(), f->vertex(Cdt::cw(first))->info()},
         f,
         first});
  }
  std::sort(found.begin(), found.end(),
            [](const FoundFace& a, const FoundFace& b) { return a.vertex < b.vertex; });
  for (std::int32_t t = 0; t < Size(found); ++t) found[t].face->info() = t;
  result.triangles.clear();
  for (const FoundFace& f : found) {
    Triangle triangle;
    triangle.vertex = f.vertex;
    // CGAL's neighbour k lies across from vertex k; our edge k lies across from vertex k + 2.
    for (int k = 0; k < 3; ++k) triangle.neighbor[k] = f.face->neighbor((f.first + k + 2) % 3)->info();
    result.triangles.push_back(triangle);
  }
}

void ConstrainedTriangulator::Impl::MarkEdges(std::span<const ConstraintSegment> constraints) {
  for (Triangle& triangle : result.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = std::min(triangle.vertex[k], triangle.vertex[(k + 1) % 3]);
      const std::int32_t b = std::max(triangle.vertex[k], triangle.vertex[(k + 1) % 3]);
      const auto edge =
          std::lower_bound(result.edges.begin(), result.edges.end(), std::pair(a, b),
                           [](const auto& e, const auto& ab) { return std::pair(e.a, e.b) < ab; });
      triangle.tag[k] = kNoTag;
      triangle.border[k] = false;
      triangle.edge[k] = -1;
      if (edge == result.edges.end() || edge->a != a || edge->b != b) continue;
      triangle.edge[k] = static_cast<std::int32_t>(edge - result.edges.begin());
      for (const ConstrainedTriangulation::Cover& cover : result.Covers(*edge)) {
        const std::int32_t tag = constraints[cover.constraint].tag;
        if (tag == kBorder) triangle.border[k] = true;
        if (tag >= 0 && (triangle.tag[k] == kNoTag || tag < triangle.tag[k])) triangle.tag[k] = tag;
      }
    }
}

void ConstrainedTriangulator::Impl::MarkInside(std::span<const ConstraintSegment> constraints) {
  FloodWinding(result, constraints, kBorder, winding, stack);
  for (std::size_t t = 0; t < winding.size(); ++t) result.triangles[t].winding = winding[t];
}

std::vector<std::int32_t> WindingNumbers(const ConstrainedTriangulation& mesh,
                                         std::span<const ConstraintSegment> constraints, std::int32_t tag) {
  std::vector<std::int32_t> winding, stack;
  FloodWinding(mesh, constraints, tag, winding, stack);
  return winding;
}

// False if pieces cross, or points that are used lie in one place.
bool ConstrainedTriangulator::Impl::TriangulatePieces(std::span<const ConstraintSegment> constraints) {
  BuildEdges();
  if (!InsertAll()) return false;
  ExtractTriangles();
  MarkEdges(constraints);
  MarkInside(constraints);
  return true;
}

ConstrainedTriangulator::ConstrainedTriangulator() : impl_(std::make_unique<Impl>()) {}
ConstrainedTriangulator::~ConstrainedTriangulator() = default;
ConstrainedTriangulator::ConstrainedTriangulator(ConstrainedTriangulator&&) noexcept = default;
ConstrainedTriangulator& ConstrainedTriangulator::operator=(ConstrainedTriangulator&&) noexcept = default;

const ConstrainedTriangulation* ConstrainedTriangulator::TryTriangulate(
    std::span<const Vec2> points, std::span<const ConstraintSegment> constraints) {
  impl_->result.vertices.assign(points.begin(), points.end());
  impl_->MergeEqualPoints();
  impl_->CollectPieces(constraints);
  if (!impl_->splitter.Split(impl_->result.vertices, impl_->used, impl_->pieces, impl_->SnapDistance()))
    return nullptr;
  return impl_->TriangulatePieces(constraints) ? &impl_->result : nullptr;
}

const ConstrainedTriangulation& ConstrainedTriangulator::Triangulate(
    std::span<const Vec2> points, std::span<const ConstraintSegment> constraints) {
  const ConstrainedTriangulation* found = TryTriangulate(points, constraints);
  PENUMBRA_CHECK(found != nullptr);
  return *found;
}

const ConstrainedTriangulation& ConstrainedTriangulator::TriangulatePieces(
    std::span<const Vec2> points, const std::vector<bool>& used, std::span<const SegmentPiece> pieces,
    std::span<const ConstraintSegment> constraints) {
  impl_->result.vertices.assign(points.begin(), points.end());
  impl_->used = used;
  impl_->pieces.assign(pieces.begin(), pieces.end());
  PENUMBRA_CHECK(impl_->TriangulatePieces(constraints));
  return impl_->result;
}

}  // namespace penumbra
