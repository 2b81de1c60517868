#include "solver/scene/contact_cuts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/base/size.h"
#include "solver/scene/contacts.h"
#include "solver/scene/convex_solids.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// Of the line from stop to stop, how much feet cover where they make a wall.
constexpr double kCovered = 0.6;
// The least size of feet that touch each other, beside the patch's diameter: a booth in a hall is a room, the
// leg of a chair is none.
constexpr double kLeastRoom = 0.02;
// A piece narrower than this part of the cut is not cut off: what a sheet of two sides covers.
constexpr double kLeastWidth = 1e-3;
// A patch smaller than this part of the largest that reflects is the side of some furniture, and in one room.
constexpr double kLeastPatch = 0.25;
// Nor is a solid's: what is cut is no solid any more, and casts its shadow side by side.
constexpr double kLeastOfSolid = 0.5;
// Of each patch, the most feet that are looked at, the longest first, and the most pieces.
constexpr std::size_t kMostFeet = 512, kMostPieces = 64;

// Where something stands on a patch, in the frame of its plane [m].
struct Foot {
  Vec2 a, b;
  Vec3 ends[2];
  SolidId solid = kNoSolid;
  PatchId other = kNoPatch;  // what stands there

  double Length() const { return (b - a).norm(); }
};

// A stretch of a line, from a point along a unit vector, between two distances [m].
struct Stretch {
  Vec2 from = Vec2::Zero(), along = Vec2::UnitX();
  double low = 0, high = 0;

  double HeightOf(const Vec2& p) const { return Cross2(along, p - from); }
  double PlaceOf(const Vec2& p) const { return along.dot(p - from); }
};

// Keeps of the stretch what lies in the convex polygon, counter-clockwise.
void ClipTo(std::span<const Vec2> polygon, Stretch& stretch) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    const double rise = Cross2(edge, stretch.along), height = Cross2(edge, stretch.from - polygon[k]);
    if (rise == 0) continue;
    if (rise > 0)
      stretch.low = std::max(stretch.low, -height / rise);
    else
      stretch.high = std::min(stretch.high, -height / rise);
  }
}

// How much of the stretch these intervals cover together.
double Covered(const Stretch& stretch, std::vector<std::pair<double, double>> intervals) {
  std::sort(intervals.begin(), intervals.end());
  double covered = 0, reached = stretch.low;
  for (const auto& [low, high] : intervals) {
    const double end = std::min(high, stretch.high);
    covered += std::max(0.0, end - std::max(low, reached));
    reached = std::max(reached, end);
  }
  return covered;
}

class PatchCutter {
 public:
  PatchCutter(const Scene& scene, PatchId id)
      : scene_(scene),
        patch_(scene.patches[id]),
        snap_(SnapDistance(patch_)),
        diameter_(Diameter(patch_.Vertices())),
        frame_(MakeFrame(patch_.vertex[0], patch_.normal)) {
    for (const Vec3& v : patch_.Vertices()) outline_.push_back(frame_.ToPlane(v));
  }

  // The pieces; empty if the patch stays whole. Appends the walls on the patch that cross other walls to
  // `crossing`.
  std::vector<Polygon3> Cut(std::span<const Contact> contacts, std::vector<PatchId>& crossing) {
    AddFeet(contacts);
    JoinFeet();
    std::vector<Polygon3> pieces = {Polygon3(patch_.Vertices().begin(), patch_.Vertices().end())};
    std::vector<const Foot*> walls;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const std::optional<Stretch> wall = WallOf(i);
      if (!wall) continue;
      CutAlong(*wall, pieces);
      walls.push_back(&feet_[i]);
    }
    for (const Foot* wall : walls)
      if (std::any_of(walls.begin(), walls.end(), [&](const Foot* other) { return Cross(*wall, *other); }))
        crossing.push_back(wall->other);
    if (pieces.size() == 1) return {};
    std::vector<Polygon3> small;
    for (const Polygon3& piece : pieces) AddQuadrilaterals(piece, small);
    return small;
  }

 private:
  void AddFeet(std::span<const Contact> contacts) {
    for (const Contact& c : contacts)
      feet_.push_back(
          {frame_.ToPlane(c.a), frame_.ToPlane(c.b), {c.a, c.b}, scene_.SolidOf(c.other), c.other});
    std::stable_sort(feet_.begin(), feet_.end(),
                     [](const Foot& p, const Foot& q) { return p.Length() > q.Length(); });
    if (feet_.size() > kMostFeet) feet_.resize(kMostFeet);
  }

  bool Touch(const Foot& p, const Foot& q) const {
    const auto on = [&](const Foot& foot, const Vec2& point) {
      const Vec2 along = foot.b - foot.a;
      const double t = std::clamp(along.dot(point - foot.a) / along.squaredNorm(), 0.0, 1.0);
      return (foot.a + t * along - point).norm() <= snap_;
    };
    return on(p, q.a) || on(p, q.b) || on(q, p.a) || on(q, p.b);
  }

  // True if feet of different solids cross each other: each has an end on either side of the other.
  bool Cross(const Foot& p, const Foot& q) const {
    if (p.solid != kNoSolid && p.solid == q.solid) return false;
    const auto divides = [&](const Foot& foot, const Foot& other) {
      const Stretch line{foot.a, (foot.b - foot.a) / foot.Length()};
      const double a = line.HeightOf(other.a), b = line.HeightOf(other.b);
      return std::min(a, b) < -snap_ && std::max(a, b) > snap_;
    };
    return divides(p, q) && divides(q, p);
  }

  // Finds of each foot how large the box is around all that touch it, and each other.
  void JoinFeet() {
    std::vector<std::size_t> root(feet_.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (std::size_t i = 0; i < feet_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (find(i) != find(j) && Touch(feet_[i], feet_[j])) root[find(i)] = find(j);
    std::vector<Vec2> low(feet_.size(), Vec2::Constant(INFINITY)),
        high(feet_.size(), Vec2::Constant(-INFINITY));
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      low[find(i)] = low[find(i)].cwiseMin(feet_[i].a).cwiseMin(feet_[i].b);
      high[find(i)] = high[find(i)].cwiseMax(feet_[i].a).cwiseMax(feet_[i].b);
    }
    for (std::size_t i = 0; i < feet_.size(); ++i) room_.push_back((high[find(i)] - low[find(i)]).norm());
  }

  // Where another foot limits a stretch or crosses it, and the solid that stands there.
  struct Stop {
    double at;
    SolidId solid = kNoSolid;
  };
  // The stops of a stretch: the nearest beyond both ends of the foot, and the outermost between the ends.
  struct Stops {
    Stop low, high;
    Stop first{INFINITY}, last{-INFINITY};
  };

  // The stretch along a foot that is to be cut; none if it is no wall.
  std::optional<Stretch> WallOf(std::size_t i) const {
    const Foot& foot = feet_[i];
    if (room_[i] < kLeastRoom * diameter_) return std::nullopt;
    const double length = foot.Length();
    Stretch line{foot.a, (foot.b - foot.a) / length, -INFINITY, INFINITY};
    ClipTo(outline_, line);
    Stops stops{{line.low}, {line.high}};
    std::vector<std::pair<double, double>> in_line;
    for (const Foot& other : feet_) {
      const double ha = line.HeightOf(other.a), hb = line.HeightOf(other.b);
      const double ta = line.PlaceOf(other.a), tb = line.PlaceOf(other.b);
      if (std::abs(ha) <= snap_ && std::abs(hb) <= snap_) {
        in_line.push_back(std::minmax(ta, tb));
        continue;
      }
      if (foot.solid != kNoSolid && other.solid == foot.solid) continue;
      if (std::min(ha, hb) > snap_ || std::max(ha, hb) < -snap_) continue;
      const double t = std::abs(ha) <= snap_   ? ta
                       : std::abs(hb) <= snap_ ? tb
                                               : ta + (tb - ta) * ha / (ha - hb);
      const bool crosses = std::min(ha, hb) < -snap_ && std::max(ha, hb) > snap_;
      if (t <= snap_ && t > stops.low.at) stops.low = {t, other.solid};
      if (t >= length - snap_ && t < stops.high.at) stops.high = {t, other.solid};
      if (t <= snap_ || t >= length - snap_ || !crosses) continue;
      if (t < stops.first.at) stops.first = {t, other.solid};
      if (t > stops.last.at) stops.last = {t, other.solid};
    }
    return CoveredPartOf(line, stops, in_line);
  }

  // The part of the line between stops of which feet cover enough. Where thick walls cross at the corner of a
  // room, the end of a foot sticks out on the other side of the wall that it crosses, and leads away from the
  // room. If feet cover too little of the whole stretch, the stretch therefore begins or ends where another
  // foot crosses the foot. What lies between two feet of one solid is within the solid, and no wall of a
  // room.
  std::optional<Stretch> CoveredPartOf(const Stretch& line, const Stops& stops,
                                       const std::vector<std::pair<double, double>>& in_line) const {
    const auto part = [&](const Stop& low, const Stop& high) {
      return Stretch{line.from, line.along, low.at, high.at};
    };
    const auto is_covered = [&](const Stretch& stretch) {
      return Covered(stretch, in_line) >= kCovered * (stretch.high - stretch.low);
    };
    const Stretch whole = part(stops.low, stops.high);
    if (is_covered(whole)) return whole;
    if (!std::isfinite(stops.first.at)) return std::nullopt;
    for (const auto& [low, high] : {std::pair(stops.first, stops.high), std::pair(stops.low, stops.last),
                                    std::pair(stops.first, stops.last)}) {
      const Stretch shorter = part(low, high);
      const bool within = low.solid != kNoSolid && low.solid == high.solid;
      if (!within && shorter.high - shorter.low >= kLeastRoom * diameter_ && is_covered(shorter))
        return shorter;
    }
    return std::nullopt;
  }

  void CutAlong(const Stretch& wall, std::vector<Polygon3>& pieces) const {
    const std::size_t count = pieces.size();
    for (std::size_t i = 0; i < count && pieces.size() < kMostPieces; ++i) {
      std::vector<Vec2> flat;
      for (const Vec3& v : pieces[i]) flat.push_back(frame_.ToPlane(v));
      Stretch inside = wall;
      ClipTo(flat, inside);
      if (inside.high - inside.low <= snap_) continue;
      Polygon3 left, right;
      if (!Split(pieces[i], flat, wall, left, right)) continue;
      pieces[i] = std::move(left);
      pieces.push_back(std::move(right));
    }
  }

  // Divides the convex polygon by the line of the stretch; false if one side would be too narrow. Both sides
  // have the same crossings, to the bit.
  bool Split(const Polygon3& piece, std::span<const Vec2> flat, const Stretch& line, Polygon3& left,
             Polygon3& right) const {
    std::vector<double> height;
    double lowest = 0, highest = 0;
    for (const Vec2& p : flat) {
      const double h = line.HeightOf(p);
      height.push_back(std::abs(h) <= snap_ ? 0 : h);
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
    }
    Stretch cut{line.from, line.along, -INFINITY, INFINITY};
    ClipTo(flat, cut);
    if (std::min(highest, -lowest) <= std::max(snap_, kLeastWidth * (cut.high - cut.low))) return false;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const std::size_t next = (k + 1) % piece.size();
      if (height[k] >= 0) left.push_back(piece[k]);
      if (height[k] <= 0) right.push_back(piece[k]);
      if (height[k] * height[next] >= 0) continue;
      const Vec3 crossing =
          AtFoot(piece[k] + height[k] / (height[k] - height[next]) * (piece[next] - piece[k]));
      left.push_back(crossing);
      right.push_back(crossing);
    }
    return left.size() >= 3 && right.size() >= 3;
  }

  // The end of a foot in this place, to the bit, else the place itself.
  Vec3 AtFoot(const Vec3& place) const {
    for (const Foot& foot : feet_)
      for (const Vec3& end : foot.ends)
        if ((end - place).norm() <= snap_) return end;
    return place;
  }

  // A convex piece as triangles and quadrilaterals around one of its corners: that which makes the best
  // shaped.
  static void AddQuadrilaterals(const Polygon3& piece, std::vector<Polygon3>& pieces) {
    std::vector<Polygon3> best;
    double best_shape = -1;
    for (std::size_t corner = 0; corner < piece.size(); ++corner) {
      std::vector<Polygon3> fan;
      double worst = INFINITY;
      for (std::size_t k = 1; k + 1 < piece.size(); k += 2) {
        Polygon3 part = {piece[corner]};
        for (std::size_t i = k; i < std::min(k + 3, piece.size()); ++i)
          part.push_back(piece[(corner + i) % piece.size()]);
        const double diameter = Diameter(part);
        worst = std::min(worst, VectorArea(part).norm() / (diameter * diameter));
        fan.push_back(std::move(part));
      }
      if (worst > best_shape) {
        best_shape = worst;
        best = std::move(fan);
      }
    }
    pieces.insert(pieces.end(), best.begin(), best.end());
  }

  const Scene& scene_;
  const Patch& patch_;
  const double snap_, diameter_;  // [m]
  const Frame frame_;
  std::vector<Vec2> outline_;
  std::vector<Foot> feet_;
  std::vector<double> room_;  // per foot: the size of all that touch it [m]
};

}  // namespace

void CutAtWalls(Scene& scene) {
  double largest = 0;
  for (PatchId id = 0; id < Size(scene.patches); ++id)
    if ((scene.MaterialOf(id).reflectance > 0).any())
      largest = std::max(largest, Diameter(scene.patches[id].Vertices()));
  std::vector<Patch> patches;
  const ContactSearch search(scene);
  std::vector<std::vector<Polygon3>> pieces_of(scene.patches.size());
  std::vector<PatchId> crossing, ignored;
  for (PatchId id = 0; id < Size(scene.patches); ++id) {
    const double least = scene.SolidOf(id) == kNoSolid ? kLeastPatch : kLeastOfSolid;
    if (Diameter(scene.patches[id].Vertices()) >= least * largest)
      pieces_of[id] = PatchCutter(scene, id).Cut(search.FindWalls(id), crossing);
  }
  // A wall that goes through another wall has parts in two rooms, however small the wall is.
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  for (const PatchId id : crossing)
    if (pieces_of[id].empty()) pieces_of[id] = PatchCutter(scene, id).Cut(search.FindWalls(id), ignored);
  for (PatchId id = 0; id < Size(scene.patches); ++id) {
    const Patch& patch = scene.patches[id];
    if (pieces_of[id].empty()) patches.push_back(patch);
    for (const Polygon3& piece : pieces_of[id]) {
      if (VectorArea(piece).norm() == 0) continue;  // rounding left a straight corner
      patches.push_back(MakePatch(piece, patch.material, patch.object, patch.faces));
    }
  }
  const bool cut = patches.size() != scene.patches.size();
  scene.patches = std::move(patches);
  if (cut) FindConvexSolids(scene);
}

}  // namespace penumbra
