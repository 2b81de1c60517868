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
#include "solver/geometry/convex_clip.h"
#include "solver/geometry/convex_pieces.h"
#include "solver/geometry/plane_projection.h"
#include "solver/geometry/region_difference.h"
#include "solver/scene/contact_cuts.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/face_check.h"
#include "solver/scene/outline.h"
#include "solver/scene/plane_overlaps.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

void Measure(Outline& outline) {
  outline.normal = VectorArea(outline.vertices).normalized();
  outline.diameter = Diameter(outline.vertices);
}

PlaneProjection Projection(const Outline& outline) { return {outline.vertices[0], outline.normal}; }

bool LiesInPlaneOf(const Outline& a, const Outline& b, double tolerance) {
  return std::all_of(a.vertices.begin(), a.vertices.end(),
                     [&](const Vec3& p) { return std::abs(b.normal.dot(p - b.vertices[0])) <= tolerance; });
}

bool LookTheSameWayInOnePlane(const Outline& a, const Outline& b) {
  if (a.normal.dot(b.normal) <= 0) return false;
  const double tolerance = kCoplanarTolerance * std::max(a.diameter, b.diameter);
  return LiesInPlaneOf(a, b, tolerance) && LiesInPlaneOf(b, a, tolerance);
}

// Patches no wider than so many snap distances are left out: their leaves could not hold a point inside.
constexpr double kNarrowest = 4;

double DiagonalOf(std::span<const Face> faces) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Face& face : faces)
    for (const Vec3& v : face.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  return low.x() <= high.x() ? (high - low).norm() : 0;
}

class PatchBuilder {
 public:
  explicit PatchBuilder(Scene& scene)
      : scene_(scene), tolerance_(scene.coordinate_step, DiagonalOf(scene.faces)) {}

  PatchReport Build();

 private:
  void MakeOutlines();
  std::vector<std::int32_t> FindOwners() const;
  void JoinTriangularOutlines();
  void RankOutlines();
  void EmitPatches(const Outline& outline);
  std::vector<Polygon3> PiecesOf(const Outline& outline);
  static void AddFlat(Polygon3 piece, std::vector<Polygon3>& pieces);
  void AddPatch(std::span<const Vec3> vertices, const Outline& outline);

  Scene& scene_;
  PlaneTolerance tolerance_;
  PatchReport report_;
  std::vector<Outline> outlines_;
  std::vector<std::int32_t> rank_;  // of each outline: the lower wins
  RegionSubtractor subtractor_;
};

PatchReport PatchBuilder::Build() {
  MakeOutlines();
  JoinTriangularOutlines();
  RankOutlines();
  report_.largest_distance = FindOverlaps(outlines_, rank_, tolerance_);
  scene_.patches.clear();
  for (const Outline& outline : outlines_) {
    EmitPatches(outline);
    if (!outline.winners.empty())
      report_.cut_faces.insert(report_.cut_faces.end(), outline.faces.begin(), outline.faces.end());
  }
  std::sort(report_.cut_faces.begin(), report_.cut_faces.end());
  std::sort(report_.narrow_faces.begin(), report_.narrow_faces.end());
  FindConvexSolids(scene_);
  CutAtWalls(scene_);
  return std::move(report_);
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

void PatchBuilder::EmitPatches(const Outline& outline) {
  if (outline.winners.empty() && outline.vertices.size() <= 4) {
    const std::vector<Vec2> p = Project(Projection(outline), outline.vertices);
    const bool convex = p.size() == 3 || QuadrilateralQuality(p[0], p[1], p[2], p[3]) > 0;
    if (convex) return AddPatch(outline.vertices, outline);
  }
  for (const Polygon3& piece : PiecesOf(outline)) AddPatch(piece, outline);
}

// Convex pieces of what is inside the outline and outside all that cut it.
std::vector<Polygon3> PatchBuilder::PiecesOf(const Outline& outline) {
  const PlaneProjection projection = Projection(outline);
  double diameter = outline.diameter;
  std::vector<Vec2> flat = Project(projection, outline.vertices);
  std::vector<Polygon2> cuts;
  std::vector<Vec3> given = outline.vertices;
  for (const std::int32_t w : outline.winners) {
    const Polygon3& winner = outlines_[w].vertices;
    cuts.push_back(Project(projection, winner));
    given.insert(given.end(), winner.begin(), winner.end());
    diameter = std::max(diameter, outlines_[w].diameter);
  }
  const RegionDifference left = subtractor_.Subtract(flat, cuts, tolerance_.InPlane(projection, diameter));

  // Corners keep their bits, unless that would bend the pieces: the winner may lie a little off.
  const double bend = kCoplanarTolerance * diameter;
  std::vector<Vec3> lifted;
  for (std::size_t v = 0; v < left.vertices.size(); ++v) {
    const Vec3 in_plane = projection.FromPlane(left.vertices[v]);
    const bool keeps = v < outline.vertices.size() ||
                       (v < given.size() && projection.ToPlane(given[v]) == left.vertices[v] &&
                        std::abs(outline.normal.dot(given[v] - in_plane)) <= bend);
    lifted.push_back(keeps ? given[v] : in_plane);
  }
  const Frame frame = MakeFrame(outline.vertices[0], outline.normal);  // shapes as they are, not as projected
  std::vector<Vec2> true_shape;
  for (const Vec3& p : lifted) true_shape.push_back(frame.ToPlane(p));
  std::vector<Polygon3> pieces;
  for (const ConvexPiece& piece : JoinTriangles(true_shape, left.triangles)) {
    Polygon3 polygon;
    for (int i = 0; i < piece.Size(); ++i) polygon.push_back(lifted[piece.vertex[i]]);
    AddFlat(std::move(polygon), pieces);
  }
  return pieces;
}

// Halves a quadrilateral that corners off their plane bend: a small one may have what its face may not.
void PatchBuilder::AddFlat(Polygon3 piece, std::vector<Polygon3>& pieces) {
  if (piece.size() == 4) {
    const Vec3 normal = VectorArea(piece).normalized();
    const double bend = std::abs(normal.dot(piece[0] - piece[1] + piece[2] - piece[3])) / 4;
    if (bend > kPlanarTolerance * Diameter(piece)) {
      pieces.push_back({piece[0], piece[1], piece[2]});
      piece = {piece[0], piece[2], piece[3]};
    }
  }
  pieces.push_back(std::move(piece));
}

// What is no wider than the snap distance of its points has no inside. A lamp lights others all the same.
void PatchBuilder::AddPatch(std::span<const Vec3> vertices, const Outline& outline) {
  if (VectorArea(vertices).norm() > 0) {
    const Patch patch = MakePatch(vertices, outline.material, outline.object, outline.faces);
    const Frame frame = MakeFrame(vertices[0], patch.normal);
    Polygon2 shape;
    for (const Vec3& p : vertices) shape.push_back(frame.ToPlane(p));
    const Material& material = scene_.materials[outline.material];
    const bool lamp =
        (material.emittance > 0).any() && (material.reflectance == 0).all() && outline.winners.empty();
    if (lamp || NarrowestStrip(shape).width > kNarrowest * SnapDistance(patch)) {
      scene_.patches.push_back(patch);
      return;
    }
  }
  if (outline.winners.empty())
    report_.narrow_faces.insert(report_.narrow_faces.end(), outline.faces.begin(), outline.faces.end());
}

}  // namespace

PatchReport BuildPatches(Scene& scene) { return PatchBuilder(scene).Build(); }

}  // namespace penumbra
