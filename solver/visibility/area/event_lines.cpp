#include "solver/visibility/area/event_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace penumbra {
namespace {

// Below an edge at height h, the integrand changes over a distance of about h, which sample points farther
// apart would miss. Edges lower than kLowEdge times the area's diameter get lines parallel to their
// projections, at the distances h kGrading^k.
constexpr double kLowEdge = 0.05, kGrading = 8;

// The number of lines between two blockers grows as the square of the number of blockers. Above this number,
// halving of cells finds the events.
constexpr std::size_t kMostPairedBlockers = 40;
constexpr std::size_t kMostLines = 4096;

// If a plane meets the area's plane at an angle with a smaller sine, rounding of 1e-16 turns the line of
// intersection by 1e-7 or more. Such a line is useless; the integrand changes so slowly there that halving of
// cells suffices.
constexpr double kLeastSine = 1e-9;

// Of its two normals a line has the one with positive y, or with positive x if |y| is at most this. A tenth
// of the angle that MergeLines() distinguishes.
constexpr double kLevel = 1e-9;

// Weight of the plane of a blocker that touches the area, where the integrand jumps; along other lines only
// its slope jumps. A choice: cells are cut along contacts before other lines of about the same length.
constexpr double kContactWeight = 8;

// Positions along a line, from 0 to 1, at which AddWedge() tests whether the source lies behind two blockers.
constexpr std::array<double, 5> kAskedAt = {0.02, 0.25, 0.5, 0.75, 0.98};

// The integrand changes within about this fraction of the distance between line and event, because half of
// the change lies on either side of the line.
constexpr double kReachShare = 0.5;

double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double t = std::clamp((x - p).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - p - t * along).norm();
}

// The distance from x, a point of the event's line, to the nearer of vertex and edge, along the line of sight
// [m].
double Nearness(const Event& event, const Vec3& x) {
  if (event.edge_on) return DistanceToSegment(x, event.from, event.to);
  const Vec3 sight = event.vertex - x, edge = event.to - event.from;
  const Vec3 across = (event.from - event.vertex).cross(edge).cross(sight);
  const double slope = edge.dot(across);
  const double t = slope == 0 ? 0 : std::clamp((x - event.from).dot(across) / slope, 0.0, 1.0);
  return std::min(sight.norm(), (event.from + t * edge - x).norm());
}

class EventLineFinder {
 public:
  EventLineFinder(const Scene& scene, const SightPair& pair) : scene_(scene), pair_(pair) {}

  EventLines Find(std::span<const PatchId> blockers) {
    FindGrades(pair_.local_source, kNoPatch);
    if (!blockers.empty()) FindLines(blockers);
    MergeLines();
    return {std::move(lines_), all_known_};
  }

 private:
  void FindLines(std::span<const PatchId> blockers);
  void FindGrades(std::span<const Vec3> polygon, PatchId owner);
  void AddWedges(std::span<const Vec3> vertices, std::span<const Vec3> edges, PatchId a, PatchId b);
  void AddWedge(const Vec3& v, const Vec3& p, const Vec3& q, PatchId a, PatchId b);
  void AddStretch(EventLine line, double low, double high);
  bool LooksAtSource(const Vec2& from, const Vec3& through) const;
  void MergeLines();

  const Scene& scene_;
  const SightPair& pair_;
  bool all_known_ = true;
  std::vector<EventLine> lines_;
};

// Adds lines around the projections of edges that lie low above the area.
void EventLineFinder::FindGrades(std::span<const Vec3> polygon, PatchId owner) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double height = std::min(p.z(), q.z());
    const Vec2 along = (q - p).head<2>();
    const double length = along.norm(), least = kSameLine * pair_.diameter;
    if (height > kLowEdge * pair_.diameter || length <= least) continue;
    EventLine line;
    line.normal = Vec2(along.y(), -along.x()) / length;  // so that Along() has the direction from p to q
    line.grade = owner == kNoPatch;
    line.events = {{kNoPatch, owner, p, p, q, true}};
    const double foot = line.normal.dot(p.head<2>()), from = line.Along().dot(p.head<2>());
    line.offset = foot;
    AddStretch(line, from, from + length);
    if (height <= least) continue;  // it touches: the integrand changes on every scale, and samples show this
    for (double away = height; away < pair_.diameter; away *= kGrading)
      for (const double side : {-1.0, 1.0}) {
        line.offset = foot + side * away;
        AddStretch(line, from - away, from + length + away);
      }
  }
}

// Adds the lines at which the visible part of the source changes in kind: the traces of the wedges through a
// vertex of one polygon and an edge of another, and of the blockers' planes. Curved events (EEE) are left to
// halving of cells.
void EventLineFinder::FindLines(std::span<const PatchId> blockers) {
  const double rounding = kSameLine * pair_.diameter;
  std::vector<std::pair<PatchId, Polygon3>> between;
  const Patch& source = scene_.patches[pair_.source];
  for (const PatchId blocker : blockers) {
    const Patch& patch = scene_.patches[blocker];
    Polygon3 part = ClipToHalfSpace(patch.Vertices(), pair_.frame.n, pair_.frame.origin, rounding);
    part = ClipToHalfSpace(part, source.normal, source.vertex[0], rounding);
    if (part.empty()) continue;
    Polygon3 local;
    bool touches = false;
    for (const Vec3& v : part) {
      const Vec2 p = pair_.frame.ToPlane(v);
      const double height = pair_.frame.n.dot(v - pair_.frame.origin);
      local.emplace_back(p.x(), p.y(), std::max(0.0, height));
      touches = touches || height <= rounding;
    }
    // The blocker's plane, in which the blocker is seen edge-on.
    const Vec3 normal(pair_.frame.u.dot(patch.normal), pair_.frame.v.dot(patch.normal),
                      pair_.frame.n.dot(patch.normal));
    const double length = normal.head<2>().norm();
    if (length > kLeastSine) {
      EventLine line;
      line.normal = normal.head<2>() / length;
      line.offset = normal.dot(local[0]) / length;
      line.weight = touches ? kContactWeight : 1;
      for (std::size_t i = 0; i < local.size(); ++i)
        line.events.push_back({kNoPatch, blocker, local[i], local[i], local[(i + 1) % local.size()], true});
      AddStretch(line, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    }
    FindGrades(local, blocker);
    between.emplace_back(blocker, std::move(local));
  }
  for (const auto& [blocker, polygon] : between) {
    AddWedges(pair_.local_source, polygon, kNoPatch, blocker);
    AddWedges(polygon, pair_.local_source, kNoPatch, blocker);
  }
  if (between.size() <= kMostPairedBlockers)
    for (const auto& [a, vertices] : between)
      for (const auto& [b, edges] : between)
        if (a != b) AddWedges(vertices, edges, a, b);
}

void EventLineFinder::AddWedges(std::span<const Vec3> vertices, std::span<const Vec3> edges, PatchId a,
                                PatchId b) {
  for (const Vec3& v : vertices)
    for (std::size_t i = 0; i < edges.size(); ++i) AddWedge(v, edges[i], edges[(i + 1) % edges.size()], a, b);
}

// Adds the trace of the wedge through v and the edge from p to q: the points from which v and a point of the
// edge coincide.
void EventLineFinder::AddWedge(const Vec3& v, const Vec3& p, const Vec3& q, PatchId a, PatchId b) {
  const double rounding = kSameLine * pair_.diameter;
  const std::size_t before = lines_.size();
  if (v.z() <= rounding) return;
  const Vec3 normal = (p - v).cross(q - v);
  const double length = normal.head<2>().norm();
  if (length <= kLeastSine * (p - v).norm() * (q - v).norm()) return;
  EventLine line;
  line.normal = normal.head<2>() / length;
  line.offset = normal.dot(v) / length;
  line.events = {{a, b, v, p, q, false}};
  // Projects the edge's ends from v onto the plane z = 0. The image of an end below v lies on the same side
  // of v as the end.
  const Vec2 along = line.Along();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto rise = [&](const Vec3& e) { return std::abs(e.z() - v.z()) <= rounding ? 0 : e.z() - v.z(); };
  const auto image = [&](const Vec3& e) {
    return along.dot(v.head<2>() + (v - e).head<2>() * (v.z() / (e.z() - v.z())));
  };
  const double rise_p = rise(p), rise_q = rise(q);
  if (rise_p == 0 && rise_q == 0) return;
  if (rise_p == 0 || rise_q == 0) {
    const Vec3 &level = rise_p == 0 ? p : q, &other = rise_p == 0 ? q : p;
    const double end = image(other);
    const double out = along.dot((v - level).head<2>()) * (other.z() - v.z());
    AddStretch(line, out > 0 ? end : -infinity, out > 0 ? infinity : end);
    return;
  }
  const double low = std::min(image(p), image(q)), high = std::max(image(p), image(q));
  if ((rise_p > 0) == (rise_q > 0)) {
    AddStretch(line, low, high);
  } else {
    AddStretch(line, -infinity, low);
    AddStretch(line, high, infinity);
  }
  if (a == kNoPatch || lines_.size() == before) return;
  // The event of two blockers matters only where the source lies behind them.
  const EventLine& last = lines_.back();
  bool matters = false;
  for (const double s : kAskedAt)
    matters =
        matters ||
        LooksAtSource(last.normal * last.offset + last.Along() * (last.low + s * (last.high - last.low)), v);
  if (!matters) lines_.pop_back();
}

// Adds the line if the part between `low` and `high` runs through the area.
void EventLineFinder::AddStretch(EventLine line, double low, double high) {
  const Stretch inside = Inside(line, pair_.area);
  line.low = std::max(low, inside.low);
  line.high = std::min(high, inside.high);
  if (line.high - line.low > kSameLine * pair_.diameter) lines_.push_back(std::move(line));
}

// True if the ray from the point `from` of the receiver's plane through `through` meets the source.
bool EventLineFinder::LooksAtSource(const Vec2& from, const Vec3& through) const {
  const Vec3 eye(from.x(), from.y(), 0), direction = through - eye;
  for (std::size_t i = 0; i < pair_.local_source.size(); ++i) {
    const Vec3 a = pair_.local_source[i] - eye,
               b = pair_.local_source[(i + 1) % pair_.local_source.size()] - eye;
    if (b.cross(a).dot(direction) < 0) return false;
  }
  return true;
}

// Merges coincident lines, and sorts lines by weight x length, descending.
void EventLineFinder::MergeLines() {
  constexpr double kSteps = 1e8;  // resolution of angles [1/rad]
  struct Key {
    std::int64_t angle;
    double offset;
    std::size_t line;
  };
  std::vector<Key> keys;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    EventLine& line = lines_[i];
    const bool flip =
        line.normal.y() < -kLevel || (std::abs(line.normal.y()) <= kLevel && line.normal.x() < 0);
    if (flip) {
      line.normal = -line.normal;
      line.offset = -line.offset;
      std::swap(line.low, line.high);
      line.low = -line.low;
      line.high = -line.high;
    }
    keys.push_back({std::llround(kSteps * std::atan2(line.normal.y(), line.normal.x())), line.offset, i});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.angle, a.offset, a.line) < std::tie(b.angle, b.offset, b.line);
  });
  std::vector<EventLine> merged;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EventLine& line = lines_[keys[i].line];
    if (i > 0 && keys[i].angle == keys[i - 1].angle &&
        keys[i].offset - keys[i - 1].offset <= kSameLine * pair_.diameter) {
      EventLine& same = merged.back();
      same.low = std::min(same.low, line.low);
      same.high = std::max(same.high, line.high);
      same.weight += line.weight;
      same.grade = same.grade || line.grade;
      same.events.insert(same.events.end(), line.events.begin(), line.events.end());
    } else {
      merged.push_back(std::move(line));
    }
  }
  std::stable_sort(merged.begin(), merged.end(), [](const EventLine& a, const EventLine& b) {
    return a.weight * (a.high - a.low) > b.weight * (b.high - b.low);
  });
  for (EventLine& line : merged)
    line.reach = std::min(pair_.source_breadth, kReachShare * Reach(line, line.low, line.high));
  all_known_ = merged.size() <= kMostLines;
  if (merged.size() > kMostLines) merged.resize(kMostLines);
  lines_ = std::move(merged);
}

}  // namespace

double Reach(const EventLine& line, double low, double high) {
  double reach = std::numeric_limits<double>::infinity();
  for (const double s : {0.0, 0.5, 1.0}) {
    const Vec2 p = line.normal * line.offset + line.Along() * (low + s * (high - low));
    for (const Event& event : line.events) reach = std::min(reach, Nearness(event, {p.x(), p.y(), 0}));
  }
  return reach;
}

Stretch Inside(const EventLine& line, std::span<const Vec2> polygon) {
  Stretch inside{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const Vec2 along = line.Along();
  const auto add = [&](const Vec2& p) {
    const double s = along.dot(p);
    inside.low = std::min(inside.low, s);
    inside.high = std::max(inside.high, s);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ha = line.normal.dot(a) - line.offset, hb = line.normal.dot(b) - line.offset;
    if (ha == 0) add(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) add(a + (b - a) * (ha / (ha - hb)));
  }
  return inside;
}

bool IsCastByAny(const EventLine& line, std::span<const PatchId> blockers) {
  const auto blocks = [&](PatchId p) {
    return p == kNoPatch || std::binary_search(blockers.begin(), blockers.end(), p);
  };
  return std::any_of(line.events.begin(), line.events.end(),
                     [&](const Event& event) { return blocks(event.a) && blocks(event.b); });
}

EventLines FindEventLines(const Scene& scene, const SightPair& pair, std::span<const PatchId> blockers) {
  return EventLineFinder(scene, pair).Find(blockers);
}

}  // namespace penumbra
