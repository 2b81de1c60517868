#include "solver/scene/face_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/geometry/box_tree.h"
#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/nearby_segments.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/plane_projection.h"

namespace penumbra {
namespace {

// The two vertices farthest apart, and the one farthest from the line through them.
struct Extent {
  Vec3 a, b, c;
  double diameter = 0, width = 0;
};

Extent FindExtent(const Polygon3& face) {
  Extent extent;
  const auto [first, second] = FarthestPair(face);
  extent.a = face[first];
  extent.b = face[second];
  extent.diameter = (extent.a - extent.b).norm();
  if (extent.diameter == 0) return extent;
  const Vec3 along = (extent.b - extent.a) / extent.diameter;
  for (const Vec3& p : face)
    if (const double w = along.cross(p - extent.a).norm(); w > extent.width) {
      extent.width = w;
      extent.c = p;
    }
  return extent;
}

// A face and its reverse, begun anywhere, as one and the same polygon: what is computed from it does not
// depend on how the face was written.
struct Canonical {
  Polygon3 face;
  bool reversed = false;
};

bool ComesBefore(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

// Begun at the first vertex in the order of coordinates, towards the side whose vertices come first.
Canonical Canonicalise(const Polygon3& face) {
  // A face may come back to its first vertex as often as holes are joined to it there; of more ways than this
  // only some are compared, and a reversed face may then be cut along other lines.
  constexpr std::size_t kMostWays = 8;
  const Vec3 first = *std::min_element(face.begin(), face.end(), ComesBefore);
  struct Way {
    std::size_t begin, step;
  };
  const std::size_t size = face.size();
  const auto at = [&](const Way& way, std::size_t i) { return face[(way.begin + i * way.step) % size]; };
  std::optional<Way> best;
  std::size_t ways = 0;
  for (std::size_t i = 0; i < size && ways < kMostWays; ++i) {
    if (face[i] != first) continue;
    for (const std::size_t step : {std::size_t{1}, size - 1}) {
      const Way way{i, step};
      ++ways;
      std::size_t k = 0;
      while (best && k < size && at(way, k) == at(*best, k)) ++k;
      if (!best || (k < size && ComesBefore(at(way, k), at(*best, k)))) best = way;
    }
  }
  Canonical canonical{{}, best->step != 1};
  for (std::size_t i = 0; i < size; ++i) canonical.face.push_back(at(*best, i));
  return canonical;
}

struct FittedPlane {
  Vec3 point, normal;  // unit
  double off = 0;      // the largest distance of a vertex [m]
};

FittedPlane FitPlane(const Polygon3& face, const Extent& extent) {
  // A self-crossing face can have no area to take the normal from.
  constexpr double kLittleArea = 1e-6;
  FittedPlane plane;
  plane.normal = VectorArea(face);
  if (plane.normal.norm() < kLittleArea * extent.diameter * extent.width)
    plane.normal = (extent.b - extent.a).cross(extent.c - extent.a);
  plane.normal.normalize();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : face) mean += (p - face[0]) / static_cast<double>(face.size());
  plane.point = mean + face[0];
  for (const Vec3& p : face) plane.off = std::max(plane.off, std::abs(plane.normal.dot(p - plane.point)));
  return plane;
}

bool IsConvexQuadrilateral(const std::vector<Vec2>& p) {
  for (int i = 0; i < 4; ++i)
    if (Orientation(p[i], p[(i + 1) % 4], p[(i + 2) % 4]) <= 0) return false;
  return true;
}

// Whether two edges of a large outline cross where none of their ends is near the other: then it winds around
// some point otherwise than once, whatever else it does. To find all crossings of a disordered outline would
// take time by the square of its size.
bool SurelyCrosses(const std::vector<Vec2>& outline, double rounding) {
  constexpr std::size_t kLarge = 512;
  if (outline.size() < kLarge) return false;
  const auto size = static_cast<std::int32_t>(outline.size());
  std::vector<PlaneBox> boxes;
  std::vector<PlaneSegment> edges;
  PlaneBox all{outline[0], outline[0]};
  for (std::int32_t i = 0; i < size; ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % size];
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
    edges.push_back({a, b});
    all.low = all.low.cwiseMin(a);
    all.high = all.high.cwiseMax(a);
  }
  const double near = std::max(rounding, kSnapDistance * (all.high - all.low).maxCoeff());
  const auto apart = [&](const Vec2& a, const Vec2& b, const Vec2& p) {
    return std::abs(Cross2(b - a, p - a)) > near * (b - a).norm();
  };
  const auto cross = [&](std::int32_t i, std::int32_t j) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % size], &c = outline[j], &d = outline[(j + 1) % size];
    return Orientation(a, b, c) * Orientation(a, b, d) < 0 &&
           Orientation(c, d, a) * Orientation(c, d, b) < 0 && apart(a, b, c) && apart(a, b, d) &&
           apart(c, d, a) && apart(c, d, b);
  };
  if (const auto pairs = FindNearbyPairs(edges, 0))
    return std::any_of(pairs->begin(), pairs->end(),
                       [&](const auto& pair) { return cross(pair.first, pair.second); });
  // Where very many edges meet, some cross, and the first of them are found soon.
  BoxTree tree;
  tree.Build(boxes);
  std::vector<std::int32_t> found;
  for (std::int32_t i = 0; i < size; ++i) {
    tree.Find(boxes[i], found);
    for (const std::int32_t j : found)
      if (j > i && cross(i, j)) return true;
  }
  return false;
}

// The height of a triangle over its longest side.
double WidthOf(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  return longest > 0 ? std::abs(Cross2(b - a, c - a)) / longest : 0;
}

// In the plane: whether the outline winds around every point once or not at all, and around some point once.
// Triangles no wider than `rounding` [m] do not count.
FaceCondition CheckOutline(const std::vector<Vec2>& outline, double rounding) {
  if (outline.size() == 4 && IsConvexQuadrilateral(outline)) return FaceCondition::kFine;
  if (SurelyCrosses(outline, rounding)) return FaceCondition::kSelfCrossing;
  std::vector<ConstraintSegment> border;
  const auto size = static_cast<std::int32_t>(outline.size());
  for (std::int32_t i = 0; i < size; ++i) border.push_back({i, (i + 1) % size, kBorder});
  ConstrainedTriangulator triangulator;
  bool inside = false;
  const ConstrainedTriangulation* mesh = triangulator.TryTriangulate(outline, border);
  if (!mesh) return FaceCondition::kSelfCrossing;  // an outline that is simple beside rounding has a mesh
  for (const ConstrainedTriangulation::Triangle& triangle : mesh->triangles) {
    const auto vertex = [&](int k) { return mesh->vertices[triangle.vertex[k]]; };
    if ((triangle.winding < 0 || triangle.winding > 1) && WidthOf(vertex(0), vertex(1), vertex(2)) > rounding)
      return FaceCondition::kSelfCrossing;
    inside = inside || triangle.winding == 1;
  }
  return inside ? FaceCondition::kFine : FaceCondition::kZeroArea;
}

std::vector<Vec2> OnPlane(const Polygon3& face, const FittedPlane& plane) {
  const Frame frame = MakeFrame(plane.point, plane.normal);
  std::vector<Vec2> outline;
  for (const Vec3& p : face) outline.push_back(frame.ToPlane(p));
  return outline;
}

// 1 for an equilateral triangle, 0 for one without area, less for one that runs clockwise in the plane.
double ShapeOf(const Polygon3& face, const std::vector<Vec2>& outline, const std::array<std::size_t, 3>& t) {
  const double lengths = (face[t[0]] - face[t[1]]).squaredNorm() + (face[t[1]] - face[t[2]]).squaredNorm() +
                         (face[t[2]] - face[t[0]]).squaredNorm();
  const double area = SignedArea(std::array{outline[t[0]], outline[t[1]], outline[t[2]]});
  return 4 * std::numbers::sqrt3_v<double> * area / lengths;
}

// The two triangles of a quadrilateral whose worse one is the better shaped; none if it crosses itself.
std::vector<Polygon3> CutQuadrilateral(const Polygon3& face, const FittedPlane& plane) {
  using Halves = std::array<std::array<std::size_t, 3>, 2>;
  // Rounding must not decide between equally good diagonals, or a regular grid would be cut at random.
  constexpr double kSameShape = 1e-9;
  const std::vector<Vec2> outline = OnPlane(face, plane);
  double best_shape = 0;
  std::vector<Polygon3> best;
  for (const Halves& halves : {Halves{{{0, 1, 2}, {0, 2, 3}}}, Halves{{{0, 1, 3}, {1, 2, 3}}}}) {
    const double shape = std::min(ShapeOf(face, outline, halves[0]), ShapeOf(face, outline, halves[1]));
    if (shape <= best_shape + (best.empty() ? 0 : kSameShape)) continue;
    best_shape = shape;
    best.clear();
    for (const auto& t : halves) best.push_back({face[t[0]], face[t[1]], face[t[2]]});
  }
  return best;
}

// The triangles inside of a face of any number of vertices.
std::vector<Polygon3> CutPolygon(const Polygon3& face, const FittedPlane& plane) {
  const Frame frame = MakeFrame(plane.point, plane.normal);
  std::vector<ConstraintSegment> border;
  const auto size = static_cast<std::int32_t>(face.size());
  for (std::int32_t i = 0; i < size; ++i) border.push_back({i, (i + 1) % size, kBorder});
  ConstrainedTriangulator triangulator;
  const ConstrainedTriangulation& mesh = triangulator.Triangulate(OnPlane(face, plane), border);
  const auto lifted = [&](std::int32_t v) {
    return v < size ? face[v] : frame.FromPlane(mesh.vertices[v]);  // beyond: where the face touches itself
  };
  std::vector<Polygon3> pieces;
  for (const ConstrainedTriangulation::Triangle& t : mesh.triangles) {
    if (t.winding <= 0) continue;
    pieces.push_back({lifted(t.vertex[0]), lifted(t.vertex[1]), lifted(t.vertex[2])});
    if (!(VectorArea(pieces.back()).norm() > 0)) pieces.pop_back();
  }
  return pieces;
}

FaceCondition CheckUneven(const Polygon3& face, const FittedPlane& plane, double rounding) {
  if (face.size() == 4)
    return CutQuadrilateral(face, plane).empty() ? FaceCondition::kSelfCrossing : FaceCondition::kUneven;
  const FaceCondition condition = CheckOutline(OnPlane(face, plane), rounding);
  return condition == FaceCondition::kFine ? FaceCondition::kUneven : condition;
}

}  // namespace

int RemoveRepeatedVertices(Polygon3& face) {
  // A vertex that equals the last one kept goes; where it equals the one before, the last is the tip of a
  // spike.
  const std::size_t before = face.size();
  std::size_t kept = 0;  // face[0, kept)
  for (std::size_t i = 0; i < before; ++i) {
    if (kept >= 2 && face[kept - 2] == face[i]) --kept;
    if (kept >= 1 && face[kept - 1] == face[i]) continue;
    face[kept++] = face[i];
  }
  // The same where the end meets the beginning.
  std::size_t first = 0;
  while (kept - first >= 2) {
    if (face[first] == face[kept - 1])
      --kept;
    else if (kept - first >= 3 && face[first] == face[kept - 2])
      --kept;
    else if (kept - first >= 3 && face[first + 1] == face[kept - 1])
      ++first;
    else
      break;
  }
  face.resize(kept);
  face.erase(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(first));
  return static_cast<int>(before - face.size());
}

FaceCheck CheckFace(const Polygon3& given, const FaceTolerances& tolerances) {
  if (given.size() < 3) return {FaceCondition::kZeroArea};
  const Polygon3 face = Canonicalise(given).face;
  const Extent extent = FindExtent(face);
  double largest = 0;
  for (const Vec3& p : face) largest = std::max(largest, MaxAbs(p));
  const double binary = 4 * std::numeric_limits<double>::epsilon() * largest;
  if (extent.width <= std::max(kZeroWidth * extent.diameter, binary)) return {FaceCondition::kZeroArea};
  const double rounding = std::min(tolerances.rounding, kMostRounding * extent.diameter);
  const bool is_narrow = extent.width <= rounding;
  const double ignored = is_narrow ? 0 : rounding;
  // The area of a face too small for its square to be a double counts as none.
  const bool has_area = VectorArea(face).norm() > 0;
  if (face.size() == 3) return {has_area ? FaceCondition::kFine : FaceCondition::kZeroArea};

  const FittedPlane plane = FitPlane(face, extent);
  FaceCheck check{FaceCondition::kFine, plane.off, extent.diameter};
  if (plane.off > tolerances.cut * extent.diameter)
    check.condition = FaceCondition::kFolded;
  else if (plane.off > kPlanarTolerance * extent.diameter)
    check.condition = CheckUneven(face, plane, ignored);
  else {
    const PlaneProjection projection(plane.point, plane.normal);
    std::vector<Vec2> outline;
    for (const Vec3& p : face) outline.push_back(projection.ToPlane(p));
    check.condition = CheckOutline(outline, ignored);
  }
  if (check.condition == FaceCondition::kSelfCrossing && is_narrow)
    check.condition = FaceCondition::kZeroArea;
  if (check.condition == FaceCondition::kFine && !has_area) check.condition = FaceCondition::kZeroArea;
  return check;
}

std::vector<Polygon3> FlatPieces(const Polygon3& face) {
  if (face.size() <= 3) return {face};
  const Canonical canonical = Canonicalise(face);
  const Extent extent = FindExtent(canonical.face);
  const FittedPlane plane = FitPlane(canonical.face, extent);
  if (plane.off <= kPlanarTolerance * extent.diameter) return {face};
  std::vector<Polygon3> pieces =
      face.size() == 4 ? CutQuadrilateral(canonical.face, plane) : CutPolygon(canonical.face, plane);
  if (canonical.reversed)
    for (Polygon3& piece : pieces) std::reverse(piece.begin(), piece.end());
  return pieces;
}

}  // namespace penumbra
