#include "solver/scene/patch_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/size.h"
#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/convex_pieces.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/plane_projection.h"
#include "solver/scene/contact_cuts.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/face_check.h"

namespace penumbra {
namespace {

// A simple polygon on its way to patches: a face without its straight corners, a triangle of one that is not
// planar, or two triangles joined.
struct Outline {
  Polygon3 vertices;
  std::vector<std::int32_t> faces;
  std::int32_t material = 0;
  std::int32_t object = 0;
  std::int32_t owners = 0;     // equal for faces that belong to the same objects
  Vec3 normal = Vec3::Zero();  // unit
  double diameter = 0;
  bool is_piece = false;              // of a face that is not planar
  bool joined = false;                // into the outline of a lower index
  std::vector<std::int32_t> winners;  // outlines that cut this one
};

void Measure(Outline& outline) {
  outline.normal = VectorArea(outline.vertices).normalized();
  outline.diameter = Diameter(outline.vertices);
}

PlaneProjection Projection(const Outline& outline) { return {outline.vertices[0], outline.normal}; }

std::vector<Vec2> Project(const PlaneProjection& projection, std::span<const Vec3> points) {
  std::vector<Vec2> projected;
  for (const Vec3& p : points) projected.push_back(projection.ToPlane(p));
  return projected;
}

bool LiesInPlaneOf(const Outline& a, const Outline& b, double tolerance) {
  return std::all_of(a.vertices.begin(), a.vertices.end(),
                     [&](const Vec3& p) { return std::abs(b.normal.dot(p - b.vertices[0])) <= tolerance; });
}

bool LookTheSameWayInOnePlane(const Outline& a, const Outline& b) {
  if (a.normal.dot(b.normal) <= 0) return false;
  const double tolerance = kCoplanarTolerance * std::max(a.diameter, b.diameter);
  return LiesInPlaneOf(a, b, tolerance) && LiesInPlaneOf(b, a, tolerance);
}

class PatchBuilder {
 public:
  explicit PatchBuilder(Scene& scene) : scene_(scene) {}

  PatchReport Build();

 private:
  void MakeOutlines();
  std::vector<std::int32_t> FindOwners() const;
  void JoinTriangularOutlines();
  void RankOutlines();
  void FindOverlaps();
  bool Overlap(const Outline& a, const Outline& b);
  void EmitPatches(const Outline& outline);
  void EmitPieces(const Outline& outline);

  Scene& scene_;
  std::vector<Outline> outlines_;
  std::vector<std::int32_t> rank_;  // of each outline: the lower wins
  ConstrainedTriangulator triangulator_;
};

PatchReport PatchBuilder::Build() {
  MakeOutlines();
  JoinTriangularOutlines();
  RankOutlines();
  FindOverlaps();
  scene_.patches.clear();
  PatchReport report;
  for (const Outline& outline : outlines_) {
    EmitPatches(outline);
    if (!outline.winners.empty())
      report.cut_faces.insert(report.cut_faces.end(), outline.faces.begin(), outline.faces.end());
  }
  std::sort(report.cut_faces.begin(), report.cut_faces.end());
  FindConvexSolids(scene_);
  CutAtWalls(scene_);
  return report;
}

// Of each face, a number that it shares with just those faces that belong to the same objects and groups.
std::vector<std::int32_t> PatchBuilder::FindOwners() const {
  std::vector<std::vector<std::int32_t>> objects_of(scene_.faces.size());
  for (std::int32_t o = 0; o < Size(scene_.objects); ++o)
    for (const std::int32_t face : scene_.objects[o].faces) objects_of[face].push_back(o);
  std::map<std::vector<std::int32_t>, std::int32_t> numbers;
  std::vector<std::int32_t> owners;
  for (const std::vector<std::int32_t>& objects : objects_of)
    owners.push_back(numbers.try_emplace(objects, Size(numbers)).first->second);
  return owners;
}

void PatchBuilder::MakeOutlines() {
  const std::vector<std::int32_t> owners = FindOwners();
  for (std::int32_t f = 0; f < Size(scene_.faces); ++f) {
    const Face& face = scene_.faces[f];
    if (face.vertices.empty()) continue;
    const std::vector<Polygon3> pieces = FlatPieces(face.vertices);
    for (const Polygon3& piece : pieces) {
      Outline outline;
      const PlaneProjection projection(piece[0], VectorArea(piece));
      for (const std::int32_t i : WithoutStraightCorners(Project(projection, piece)))
        outline.vertices.push_back(piece[i]);
      outline.faces = {f};
      outline.material = face.material;
      outline.object = face.object;
      outline.owners = owners[f];
      outline.is_piece = pieces.size() > 1;
      Measure(outline);
      outlines_.push_back(std::move(outline));
    }
  }
}

// Joins pairs of triangular outlines with a common edge, the best shaped quadrilateral first.
void PatchBuilder::JoinTriangularOutlines() {
  using Point = std::array<double, 3>;
  const auto point = [](const Vec3& p) { return Point{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; };  // -0 is 0
  struct Side {
    Point from, to;
    std::int32_t outline;
    int k;
  };
  std::vector<Side> sides;
  for (std::int32_t i = 0; i < Size(outlines_); ++i)
    if (outlines_[i].vertices.size() == 3 && !outlines_[i].is_piece)
      for (int k = 0; k < 3; ++k)
        sides.push_back({point(outlines_[i].vertices[k]), point(outlines_[i].vertices[(k + 1) % 3]), i, k});
  const auto less = [](const Side& a, const Side& b) {
    return std::tie(a.from, a.to, a.outline) < std::tie(b.from, b.to, b.outline);
  };
  std::sort(sides.begin(), sides.end(), less);

  struct Candidate {
    double quality;
    std::int32_t a, b;
    Polygon3 joined;
  };
  std::vector<Candidate> candidates;
  for (const Side& side : sides) {
    const Outline& a = outlines_[side.outline];
    const Side back{side.to, side.from, side.outline + 1, 0};
    for (auto other = std::lower_bound(sides.begin(), sides.end(), back, less);
         other != sides.end() && other->from == back.from && other->to == back.to; ++other) {
      const Outline& b = outlines_[other->outline];
      if (a.material != b.material || a.owners != b.owners || !LookTheSameWayInOnePlane(a, b)) continue;
      Polygon3 joined = a.vertices;
      joined.insert(joined.begin() + side.k + 1, b.vertices[(other->k + 2) % 3]);
      const Frame frame = MakeFrame(joined[0], a.normal);
      const double quality = QuadrilateralQuality(frame.ToPlane(joined[0]), frame.ToPlane(joined[1]),
                                                  frame.ToPlane(joined[2]), frame.ToPlane(joined[3]));
      if (quality > 0) candidates.push_back({quality, side.outline, other->outline, std::move(joined)});
    }
  }
  // Rounding must not decide between equally good ones, or a regular grid would be joined at random.
  constexpr double kSameQuality = 1e-9;
  const auto grade = [](const Candidate& c) { return std::floor(c.quality / kSameQuality); };
  std::sort(candidates.begin(), candidates.end(), [&](const Candidate& p, const Candidate& q) {
    return std::tuple(-grade(p), p.a, p.b) < std::tuple(-grade(q), q.a, q.b);
  });
  std::vector<char> taken(outlines_.size(), 0);
  for (Candidate& candidate : candidates) {
    if (taken[candidate.a] || taken[candidate.b]) continue;
    taken[candidate.a] = taken[candidate.b] = 1;
    Outline& outline = outlines_[candidate.a];
    outline.vertices = std::move(candidate.joined);
    outline.faces.push_back(outlines_[candidate.b].faces.front());
    outlines_[candidate.b].joined = true;
    Measure(outline);
  }
  std::erase_if(outlines_, [](const Outline& outline) { return outline.joined; });
}

void PatchBuilder::RankOutlines() {
  std::vector<std::int32_t> order(outlines_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_partition(order.begin(), order.end(), [&](std::int32_t i) {
    return scene_.materials[outlines_[i].material].emittance.maxCoeff() > 0;
  });
  rank_.resize(order.size());
  for (std::int32_t r = 0; r < Size(order); ++r) rank_[order[r]] = r;
}

// Sweeps along x for outlines whose boxes meet.
void PatchBuilder::FindOverlaps() {
  struct OutlineBox {
    Vec3 low, high;
    std::int32_t outline;
  };
  std::vector<OutlineBox> boxes;
  for (std::int32_t i = 0; i < Size(outlines_); ++i) {
    const Outline& outline = outlines_[i];
    OutlineBox box{outline.vertices[0], outline.vertices[0], i};
    for (const Vec3& p : outline.vertices) {
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
    box.low.array() -= kCoplanarTolerance * outline.diameter;
    box.high.array() += kCoplanarTolerance * outline.diameter;
    boxes.push_back(box);
  }
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const OutlineBox& a, const OutlineBox& b) { return a.low.x() < b.low.x(); });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x() <= boxes[i].high.x(); ++j) {
      const OutlineBox &p = boxes[i], &q = boxes[j];
      if (p.low.y() > q.high.y() || q.low.y() > p.high.y()) continue;
      if (p.low.z() > q.high.z() || q.low.z() > p.high.z()) continue;
      const bool p_wins = rank_[p.outline] < rank_[q.outline];
      const std::int32_t winner = p_wins ? p.outline : q.outline, loser = p_wins ? q.outline : p.outline;
      if (Overlap(outlines_[loser], outlines_[winner])) outlines_[loser].winners.push_back(winner);
    }
  for (Outline& outline : outlines_) std::sort(outline.winners.begin(), outline.winners.end());
}

// True if a line through an edge of `a` has a on its left and b on its right, to within the tolerance.
bool EdgeSeparates(std::span<const Vec2> a, std::span<const Vec2> b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2& from = a[i];
    const Vec2 along = (a[(i + 1) % a.size()] - from).normalized();
    const auto left = [&](const Vec2& p) { return Cross2(along, p - from); };
    if (std::all_of(a.begin(), a.end(), [&](const Vec2& p) { return left(p) >= -tolerance; }) &&
        std::all_of(b.begin(), b.end(), [&](const Vec2& p) { return left(p) <= tolerance; }))
      return true;
  }
  return false;
}

// Appends the polygon's vertices to the points and its edges, with the tag, to the constraints.
void AddLoop(std::span<const Vec2> loop, std::int32_t tag, std::vector<Vec2>& points,
             std::vector<ConstraintSegment>& constraints) {
  const std::int32_t first = Size(points);
  for (std::int32_t i = 0; i < Size(loop); ++i) {
    points.push_back(loop[i]);
    constraints.push_back({first + i, first + (i + 1) % Size(loop), tag});
  }
}

double TriangleArea(const ConstrainedTriangulation& mesh, const std::array<std::int32_t, 3>& t) {
  return SignedArea(std::array{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
}

bool PatchBuilder::Overlap(const Outline& a, const Outline& b) {
  if (!LookTheSameWayInOnePlane(a, b)) return false;
  const PlaneProjection projection = Projection(a);
  const std::vector<Vec2> p = Project(projection, a.vertices), q = Project(projection, b.vertices);
  const double larger = std::max(a.diameter, b.diameter);
  const double tolerance = kCoplanarTolerance * larger;
  if (EdgeSeparates(p, q, tolerance) || EdgeSeparates(q, p, tolerance)) return false;
  std::vector<Vec2> points;
  std::vector<ConstraintSegment> constraints;
  AddLoop(p, 0, points, constraints);
  AddLoop(q, 1, points, constraints);
  const ConstrainedTriangulation& mesh = triangulator_.Triangulate(points, constraints);
  const std::vector<std::int32_t> in_p = WindingNumbers(mesh, constraints, 0);
  const std::vector<std::int32_t> in_q = WindingNumbers(mesh, constraints, 1);
  double common = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (in_p[t] > 0 && in_q[t] > 0) common += TriangleArea(mesh, mesh.triangles[t].vertex);
  return common > tolerance * std::min(a.diameter, b.diameter);
}

void PatchBuilder::EmitPatches(const Outline& outline) {
  if (outline.winners.empty() && outline.vertices.size() <= 4) {
    const std::vector<Vec2> p = Project(Projection(outline), outline.vertices);
    const bool convex = p.size() == 3 || QuadrilateralQuality(p[0], p[1], p[2], p[3]) > 0;
    if (convex) {
      scene_.patches.push_back(MakePatch(outline.vertices, outline.material, outline.object, outline.faces));
      return;
    }
  }
  EmitPieces(outline);
}

// Triangulates what is inside the outline and outside all that cut it, and joins the triangles.
void PatchBuilder::EmitPieces(const Outline& outline) {
  const PlaneProjection projection = Projection(outline);
  std::vector<Vec2> points;
  std::vector<ConstraintSegment> constraints;
  std::vector<Vec3> given = outline.vertices;
  AddLoop(Project(projection, outline.vertices), kBorder, points, constraints);
  for (std::int32_t w = 0; w < Size(outline.winners); ++w) {
    const Polygon3& winner = outlines_[outline.winners[w]].vertices;
    AddLoop(Project(projection, winner), w, points, constraints);
    given.insert(given.end(), winner.begin(), winner.end());
  }
  const ConstrainedTriangulation& mesh = triangulator_.Triangulate(points, constraints);
  std::vector<char> lost(mesh.triangles.size(), 0);
  for (std::int32_t w = 0; w < Size(outline.winners); ++w) {
    const std::vector<std::int32_t> winding = WindingNumbers(mesh, constraints, w);
    for (std::size_t t = 0; t < lost.size(); ++t)
      if (winding[t] > 0) lost[t] = 1;
  }
  std::vector<std::array<std::int32_t, 3>> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangles[t].winding > 0 && !lost[t]) kept.push_back(mesh.triangles[t].vertex);

  std::vector<Vec3> lifted = given;
  for (std::size_t v = given.size(); v < mesh.vertices.size(); ++v)
    lifted.push_back(projection.FromPlane(mesh.vertices[v]));
  const Frame frame = MakeFrame(outline.vertices[0], outline.normal);  // shapes as they are, not as projected
  std::vector<Vec2> true_shape;
  for (const Vec3& p : lifted) true_shape.push_back(frame.ToPlane(p));
  for (const ConvexPiece& piece : JoinTriangles(true_shape, kept)) {
    Polygon3 polygon;
    for (int i = 0; i < piece.Size(); ++i) polygon.push_back(lifted[piece.vertex[i]]);
    // Drop slivers that rounding left over along an edge.
    if (VectorArea(polygon).norm() <=
        kCoplanarTolerance * outline.diameter * kCoplanarTolerance * outline.diameter)
      continue;
    scene_.patches.push_back(MakePatch(polygon, outline.material, outline.object, outline.faces));
  }
}

}  // namespace

PatchReport BuildPatches(Scene& scene) { return PatchBuilder(scene).Build(); }

}  // namespace penumbra
