#include "solver/visibility/area_form_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/visibility/form_factor.h"
#include "solver/visibility/point_view.h"
#include "solver/visibility/tube_blockers.h"

namespace penumbra {
namespace {

// Gauss's rule and Kronrod's extension of it, on [0, 1]. Gauss's nodes are those of odd index.
template <std::size_t N>
struct KronrodRule {
  std::array<double, N> node, kronrod, gauss;
};

// From the nodes in [0, 1) of the interval [-1, 1], the largest first, with the weights; 0 in the middle.
template <std::size_t N>
constexpr KronrodRule<N> MakeRule(const std::array<double, (N + 1) / 2>& node,
                                  const std::array<double, (N + 1) / 2>& kronrod,
                                  const std::array<double, (N + 1) / 2>& gauss) {
  KronrodRule<N> rule{};
  for (std::size_t i = 0; i < (N + 1) / 2; ++i) {
    rule.node[i] = 0.5 - 0.5 * node[i];
    rule.node[N - 1 - i] = 0.5 + 0.5 * node[i];
    rule.kronrod[i] = rule.kronrod[N - 1 - i] = 0.5 * kronrod[i];
    rule.gauss[i] = rule.gauss[N - 1 - i] = 0.5 * gauss[i];
  }
  return rule;
}

constexpr KronrodRule<7> kSeven =
    MakeRule<7>({0.96049126870802028, 0.77459666924148338, 0.43424374934680256, 0},
                {0.10465622602646727, 0.26848808986833344, 0.40139741477596222, 0.45091653865847414},
                {0, 0.55555555555555556, 0, 0.88888888888888889});
constexpr KronrodRule<15> kFifteen = MakeRule<15>(
    {0.99145537112081264, 0.94910791234275852, 0.86486442335976907, 0.74153118559939444, 0.58608723546769113,
     0.40584515137739717, 0.20778495500789847, 0},
    {0.022935322010529225, 0.063092092629978553, 0.10479001032225018, 0.14065325971552592,
     0.16900472663926790, 0.19035057806478541, 0.20443294007529889, 0.20948214108472783},
    {0, 0.12948496616886969, 0, 0.27970539148927667, 0, 0.38183005050511894, 0, 0.41795918367346939});

// QUADPACK's: where the integrand is analytic, Kronrod's error is the 1.5th power of the difference.
constexpr double kAnalyticScale = 200;

// What roundings make of a cell, relative to its value: point form factors are good to kFormFactorError where
// nothing blocks; the edges of shadows are crossings of planes.
constexpr double kClearNoise = 1e-14, kShadowNoise = 1e-12;

// Widths below this, relative to the area's diameter, are not cut further.
constexpr double kLeastWidth = 1e-13;
// Lines this near to each other or to a corner are one, relative to the same.
constexpr double kSameLine = 1e-10;

// Lines that are cut along before any point is looked at, so that small lit parts are not missed.
constexpr std::size_t kForcedLines = 16;

// The integrand changes over the height of an edge above the area, which points that lie
// farther apart would not notice. Edges lower than this, relative to the area's diameter, get lines around
// their feet, at distances that grow by this factor.
constexpr double kLowEdge = 0.05, kGrading = 8;

// Lines between two blockers grow as the square of their number: beyond this, halving finds them.
constexpr std::size_t kMostPairedBlockers = 40;
constexpr std::size_t kMostLines = 4096;

// Of the error that is asked for, the share that may stay in cells that are not refined in a round.
constexpr double kLeftAlone = 0.3;

// Of many pairs, each is known this well before it is decided which deserve more.
constexpr double kRoughTolerance = 1e-2;

using Quad = std::array<Vec2, 4>;

Vec2 At(const Quad& q, double s, double t) {
  return (1 - t) * ((1 - s) * q[0] + s * q[1]) + t * ((1 - s) * q[3] + s * q[2]);
}
double Jacobian(const Quad& q, double s, double t) {
  const Vec2 ds = (1 - t) * (q[1] - q[0]) + t * (q[2] - q[3]),
             dt = (1 - s) * (q[3] - q[0]) + s * (q[2] - q[1]);
  return Cross2(ds, dt);
}

// Convex quadrilaterals, and triangles as such with a repeated vertex, that make up a convex polygon.
void AddQuads(std::span<const Vec2> polygon, std::vector<Quad>& quads) {
  for (std::size_t i = 2; i < polygon.size(); i += 2)
    if (i + 1 < polygon.size())
      quads.push_back({polygon[0], polygon[i - 1], polygon[i], polygon[i + 1]});
    else
      quads.push_back({polygon[0], polygon[i - 1], polygon[i], polygon[0]});
}

Polygon2 ToPolygon(const Quad& quad) {
  Polygon2 polygon(quad.begin(), quad.end());
  if (quad[3] == quad[0]) polygon.pop_back();
  return polygon;
}

// What makes an event: a vertex and an edge, or an edge and its end alone where a blocker is seen edge-on.
struct Event {
  PatchId a = kNoPatch, b = kNoPatch;  // whose vertex, whose edge; kNoPatch stands for the source
  Vec3 vertex, from, to;               // in the receiver's frame [m]
  bool edge_on = false;
};

double DistanceToSegment(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double t = std::clamp((x - p).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - p - t * along).norm();
}

// How near to x, a point of the event's line, the nearer of vertex and edge is along the line of sight [m].
double Nearness(const Event& event, const Vec3& x) {
  if (event.edge_on) return DistanceToSegment(x, event.from, event.to);
  const Vec3 sight = event.vertex - x, edge = event.to - event.from;
  const Vec3 across = (event.from - event.vertex).cross(edge).cross(sight);
  const double slope = edge.dot(across);
  const double t = slope == 0 ? 0 : std::clamp((x - event.from).dot(across) / slope, 0.0, 1.0);
  return std::min(sight.norm(), (event.from + t * edge - x).norm());
}

// A line on which what is seen may change in kind, and its stretch that matters.
struct EventLine {
  Vec2 normal = Vec2::UnitX();  // unit
  double offset = 0;            // normal . p [m]
  double low = 0, high = 0;     // of the stretch, along Along() [m]
  double weight = 1;            // how many events coincide
  bool grade = false;           // or where the integrand changes fast
  double reach = 0;             // how near what makes it comes [m]
  std::vector<Event> events;    // none for grades

  Vec2 Along() const { return {-normal.y(), normal.x()}; }
};

// How near to the stretch of the line from low to high what makes it comes [m].
double Reach(const EventLine& line, double low, double high) {
  double reach = std::numeric_limits<double>::infinity();
  for (const double s : {0.0, 0.5, 1.0}) {
    const Vec2 p = line.normal * line.offset + line.Along() * (low + s * (high - low));
    for (const Event& event : line.events) reach = std::min(reach, Nearness(event, {p.x(), p.y(), 0}));
  }
  return reach;
}

// Where a line runs in a convex polygon; high <= low: nowhere.
struct Stretch {
  double low = 0, high = 0;
};
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

struct Cell {
  Quad quad;
  std::vector<PatchId> blockers;
  std::vector<std::int32_t> lines;  // that cross it
  double value = 0;                 // its part of the integral [m^2]
  double error_s = 0, error_t = 0;  // of the value, along the two parameters
  double unseen = 0;                // what lines may hide that have all points on one side
  std::int32_t unseen_line = -1;    // the worst of them
  bool shadowed = false;            // something may block
  bool settled = false;             // nothing is to be gained by splitting it
  std::size_t points = 0;

  double Error() const { return error_s + error_t + unseen; }
};

// The integral, over a convex part of one patch, of the form factor to a convex part of another.
class PairIntegral {
 public:
  PairIntegral(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
               std::vector<PatchId> blockers, const AreaFormFactorOptions& options);

  // [m^2]
  FormFactorEstimate Integrate();

 private:
  void FindLines(std::span<const PatchId> blockers);
  void FindGrades(std::span<const Vec3> polygon, PatchId owner);
  void AddWedges(std::span<const Vec3> vertices, std::span<const Vec3> edges, PatchId a, PatchId b);
  void AddWedge(const Vec3& v, const Vec3& p, const Vec3& q, PatchId a, PatchId b);
  void AddStretch(EventLine line, double low, double high);
  bool LooksAtSource(const Vec2& from, const Vec3& through) const;
  void MergeLines();

  bool Crosses(std::int32_t line, const Cell& cell) const;
  void InheritLines(const Cell& parent, Cell& cell) const;
  Cell PartOf(const Cell& parent, const Quad& quad) const;
  bool Alive(const EventLine& line, std::span<const PatchId> blockers) const;
  void Cut(const Cell& cell, const EventLine& line, std::vector<Cell>& parts) const;
  void Split(const Cell& cell, std::vector<Cell>& parts) const;
  void FindUnseen(Cell& cell, double largest) const;
  double Visible(const Vec2& p, std::span<const PatchId> blockers) const;
  template <std::size_t N>
  void Evaluate(Cell& cell, const KronrodRule<N>& rule) const;
  void Evaluate(Cell& cell) const;

  const Scene& scene_;
  PatchId receiver_, source_;
  Polygon3 source_part_;
  Frame frame_;  // of the receiver
  Polygon2 area_;
  Polygon3 local_source_;      // in the frame
  double diameter_ = 0;        // [m]
  double source_breadth_ = 0;  // its smallest [m]
  AreaFormFactorOptions options_;
  bool all_lines_known_ = true;
  std::vector<EventLine> lines_;
  std::vector<Cell> cells_;
};

PairIntegral::PairIntegral(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                           std::vector<PatchId> blockers, const AreaFormFactorOptions& options)
    : scene_(scene), receiver_(receiver), source_(source), source_part_(ends.source), options_(options) {
  const Patch& patch = scene.patches[receiver];
  frame_ = PolygonFrame(ends.receiver);
  frame_.n = patch.normal;
  for (const Vec3& v : ends.receiver) area_.push_back(frame_.ToPlane(v));
  const auto local = [&](const Vec3& v) {
    const Vec2 p = frame_.ToPlane(v);
    return Vec3(p.x(), p.y(), frame_.n.dot(v - frame_.origin));
  };
  for (const Vec3& v : source_part_) local_source_.push_back(local(v));
  diameter_ = Diameter(ends.receiver);
  source_breadth_ = Diameter(source_part_);
  for (std::size_t i = 0; i < source_part_.size(); ++i) {
    const Vec3 &p = source_part_[i], &q = source_part_[(i + 1) % source_part_.size()];
    double breadth = 0;
    for (const Vec3& v : source_part_)
      breadth = std::max(breadth, (q - p).cross(v - p).norm() / (q - p).norm());
    source_breadth_ = std::min(source_breadth_, breadth);
  }
  FindGrades(local_source_, kNoPatch);
  if (!blockers.empty()) FindLines(blockers);
  MergeLines();

  std::vector<Quad> quads;
  AddQuads(area_, quads);
  for (const Quad& quad : quads) {
    Cell cell;
    cell.quad = quad;
    cell.blockers = blockers;
    cell.lines.resize(lines_.size());
    std::iota(cell.lines.begin(), cell.lines.end(), 0);
    std::erase_if(cell.lines, [&](std::int32_t l) { return !Crosses(l, cell); });
    cells_.push_back(std::move(cell));
  }
  // The lines are sorted, the heaviest first.
  for (std::size_t l = 0, forced = 0; l < lines_.size(); ++l) {
    if (!lines_[l].grade && ++forced > kForcedLines) continue;
    std::vector<Cell> cut;
    for (const Cell& cell : cells_)
      if (std::find(cell.lines.begin(), cell.lines.end(), static_cast<std::int32_t>(l)) != cell.lines.end())
        Cut(cell, lines_[l], cut);
      else
        cut.push_back(cell);
    cells_ = std::move(cut);
  }
}

// Lines around the feet of edges that hang low over the area.
void PairIntegral::FindGrades(std::span<const Vec3> polygon, PatchId owner) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double height = std::min(p.z(), q.z());
    const Vec2 along = (q - p).head<2>();
    const double length = along.norm(), least = kSameLine * diameter_;
    if (height > kLowEdge * diameter_ || length <= least) continue;
    EventLine line;
    line.normal = Vec2(along.y(), -along.x()) / length;  // so that Along() runs from p to q
    line.grade = owner == kNoPatch;
    line.events = {{kNoPatch, owner, p, p, q, true}};
    const double foot = line.normal.dot(p.head<2>()), from = line.Along().dot(p.head<2>());
    line.offset = foot;
    AddStretch(line, from, from + length);
    if (height <= least) continue;  // it touches: the integrand changes on every scale, and that shows
    for (double away = height; away < diameter_; away *= kGrading)
      for (const double side : {-1.0, 1.0}) {
        line.offset = foot + side * away;
        AddStretch(line, from - away, from + length + away);
      }
  }
}

// The lines on which the sight of the source changes in kind: the traces of the wedges through a vertex of
// one polygon and an edge of another, and of the blockers' planes. Curved ones, of three edges, are left to
// halving.
void PairIntegral::FindLines(std::span<const PatchId> blockers) {
  const double rounding = kSameLine * diameter_;
  std::vector<std::pair<PatchId, Polygon3>> between;
  const Patch& source = scene_.patches[source_];
  for (const PatchId blocker : blockers) {
    const Patch& patch = scene_.patches[blocker];
    Polygon3 part = ClipToHalfSpace(patch.Vertices(), frame_.n, frame_.origin, rounding);
    part = ClipToHalfSpace(part, source.normal, source.vertex[0], rounding);
    if (part.empty()) continue;
    Polygon3 local;
    bool touches = false;
    for (const Vec3& v : part) {
      const Vec2 p = frame_.ToPlane(v);
      const double height = frame_.n.dot(v - frame_.origin);
      local.emplace_back(p.x(), p.y(), std::max(0.0, height));
      touches = touches || height <= rounding;
    }
    // Its plane, where it is seen edge-on.
    const Vec3 normal(frame_.u.dot(patch.normal), frame_.v.dot(patch.normal), frame_.n.dot(patch.normal));
    const double length = normal.head<2>().norm();
    if (length > 1e-9) {
      EventLine line;
      line.normal = normal.head<2>() / length;
      line.offset = normal.dot(local[0]) / length;
      line.weight = touches ? 8 : 1;
      for (std::size_t i = 0; i < local.size(); ++i)
        line.events.push_back({kNoPatch, blocker, local[i], local[i], local[(i + 1) % local.size()], true});
      AddStretch(line, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    }
    FindGrades(local, blocker);
    between.emplace_back(blocker, std::move(local));
  }
  for (const auto& [blocker, polygon] : between) {
    AddWedges(local_source_, polygon, kNoPatch, blocker);
    AddWedges(polygon, local_source_, kNoPatch, blocker);
  }
  if (between.size() <= kMostPairedBlockers)
    for (const auto& [a, vertices] : between)
      for (const auto& [b, edges] : between)
        if (a != b) AddWedges(vertices, edges, a, b);
}

void PairIntegral::AddWedges(std::span<const Vec3> vertices, std::span<const Vec3> edges, PatchId a,
                             PatchId b) {
  for (const Vec3& v : vertices)
    for (std::size_t i = 0; i < edges.size(); ++i) AddWedge(v, edges[i], edges[(i + 1) % edges.size()], a, b);
}

// The trace of the wedge through v and the edge from p to q: the points from which v is seen before or behind
// the edge.
void PairIntegral::AddWedge(const Vec3& v, const Vec3& p, const Vec3& q, PatchId a, PatchId b) {
  const double rounding = kSameLine * diameter_;
  const std::size_t before = lines_.size();
  if (v.z() <= rounding) return;
  const Vec3 normal = (p - v).cross(q - v);
  const double length = normal.head<2>().norm();
  if (length <= 1e-9 * (p - v).norm() * (q - v).norm()) return;
  EventLine line;
  line.normal = normal.head<2>() / length;
  line.offset = normal.dot(v) / length;
  line.events = {{a, b, v, p, q, false}};
  // The images of the edge's ends, from v onto the plane z = 0. An end below v has its image on this side.
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
  // Two blockers matter where the source is behind them.
  const EventLine& last = lines_.back();
  bool matters = false;
  for (const double s : {0.02, 0.25, 0.5, 0.75, 0.98})
    matters =
        matters ||
        LooksAtSource(last.normal * last.offset + last.Along() * (last.low + s * (last.high - last.low)), v);
  if (!matters) lines_.pop_back();
}

// Adds the line if its stretch from low to high runs through the area.
void PairIntegral::AddStretch(EventLine line, double low, double high) {
  const Stretch inside = Inside(line, area_);
  line.low = std::max(low, inside.low);
  line.high = std::min(high, inside.high);
  if (line.high - line.low > kSameLine * diameter_) lines_.push_back(std::move(line));
}

// Whether the ray from the point of the receiver's plane meets the source.
bool PairIntegral::LooksAtSource(const Vec2& from, const Vec3& through) const {
  const Vec3 eye(from.x(), from.y(), 0), direction = through - eye;
  for (std::size_t i = 0; i < local_source_.size(); ++i) {
    const Vec3 a = local_source_[i] - eye, b = local_source_[(i + 1) % local_source_.size()] - eye;
    if (b.cross(a).dot(direction) < 0) return false;
  }
  return true;
}

// Joins lines that coincide, and sorts them, the heaviest first.
void PairIntegral::MergeLines() {
  constexpr double kSteps = 1e8;  // angles this fine [1/rad]
  struct Key {
    std::int64_t angle;
    double offset;
    std::size_t line;
  };
  std::vector<Key> keys;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    EventLine& line = lines_[i];
    const bool flip = line.normal.y() < -1e-9 || (std::abs(line.normal.y()) <= 1e-9 && line.normal.x() < 0);
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
        keys[i].offset - keys[i - 1].offset <= kSameLine * diameter_) {
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
    line.reach = std::min(source_breadth_, 0.5 * Reach(line, line.low, line.high));
  all_lines_known_ = merged.size() <= kMostLines;
  if (merged.size() > kMostLines) merged.resize(kMostLines);
  lines_ = std::move(merged);
}

bool PairIntegral::Alive(const EventLine& line, std::span<const PatchId> blockers) const {
  const auto blocks = [&](PatchId p) {
    return p == kNoPatch || std::binary_search(blockers.begin(), blockers.end(), p);
  };
  return std::any_of(line.events.begin(), line.events.end(),
                     [&](const Event& event) { return blocks(event.a) && blocks(event.b); });
}

// Whether a stretch of the line runs through the cell, away from its border.
bool PairIntegral::Crosses(std::int32_t l, const Cell& cell) const {
  const EventLine& line = lines_[static_cast<std::size_t>(l)];
  double lowest = 0, highest = 0;
  for (const Vec2& p : cell.quad) {
    const double height = line.normal.dot(p) - line.offset;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  const double least = kSameLine * diameter_;
  if (lowest >= -least || highest <= least) return false;
  const Stretch inside = Inside(line, ToPolygon(cell.quad));
  return std::min(line.high, inside.high) - std::max(line.low, inside.low) > least;
}

void PairIntegral::InheritLines(const Cell& parent, Cell& cell) const {
  cell.lines.clear();
  for (const std::int32_t l : parent.lines)
    if (Crosses(l, cell)) cell.lines.push_back(l);
}

Cell PairIntegral::PartOf(const Cell& parent, const Quad& quad) const {
  Cell part;
  part.quad = quad;
  part.blockers = parent.blockers;
  InheritLines(parent, part);
  return part;
}

void PairIntegral::Cut(const Cell& cell, const EventLine& line, std::vector<Cell>& parts) const {
  const Polygon2 polygon = ToPolygon(cell.quad);
  Polygon2 above, below;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const auto height = [&](const Vec2& p) {
      const double h = line.normal.dot(p) - line.offset;
      return std::abs(h) <= kLeastWidth * diameter_ ? 0 : h;
    };
    const double ha = height(a), hb = height(b);
    if (ha >= 0) above.push_back(a);
    if (ha <= 0) below.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) {
      const Vec2 crossing = a + (b - a) * (ha / (ha - hb));
      above.push_back(crossing);
      below.push_back(crossing);
    }
  }
  std::vector<Quad> quads;
  if (above.size() >= 3) AddQuads(above, quads);
  if (below.size() >= 3) AddQuads(below, quads);
  for (const Quad& quad : quads) parts.push_back(PartOf(cell, quad));
}

// Along the line with the largest share, or where none is left across the direction of the larger error.
void PairIntegral::Split(const Cell& cell, std::vector<Cell>& parts) const {
  if (cell.unseen > std::max(cell.error_s, cell.error_t))
    return Cut(cell, lines_[static_cast<std::size_t>(cell.unseen_line)], parts);
  const EventLine* best = nullptr;
  double largest = 0;
  const Polygon2 polygon = ToPolygon(cell.quad);
  for (const std::int32_t l : cell.lines) {
    const EventLine& line = lines_[static_cast<std::size_t>(l)];
    if (!Alive(line, cell.blockers)) continue;
    const Stretch inside = Inside(line, polygon);
    const double share = line.weight * (std::min(line.high, inside.high) - std::max(line.low, inside.low));
    if (share > largest) {
      largest = share;
      best = &line;
    }
  }
  if (best) return Cut(cell, *best, parts);
  const Quad& q = cell.quad;
  std::array<Quad, 2> halves;
  if (cell.error_s >= cell.error_t) {
    const Vec2 low = 0.5 * (q[0] + q[1]), high = 0.5 * (q[3] + q[2]);
    halves = {Quad{q[0], low, high, q[3]}, Quad{low, q[1], q[2], high}};
  } else {
    const Vec2 low = q[3] == q[0] ? q[0] : Vec2(0.5 * (q[0] + q[3])), high = 0.5 * (q[1] + q[2]);
    halves = {Quad{q[0], q[1], high, low}, Quad{low, high, q[2], q[3]}};
  }
  for (const Quad& half : halves) parts.push_back(PartOf(cell, half));
}

double PairIntegral::Visible(const Vec2& p, std::span<const PatchId> blockers) const {
  ReceiverPoint at;
  at.position = frame_.FromPlane(p);
  at.normal = frame_.n;
  PointView view(scene_, at);
  if (!view.FaceSource(source_)) return 0;
  const DirectionPolygon seen = view.SeeSource(source_part_);
  if (seen.empty()) return 0;
  std::vector<Occluder>& occluders = view.occluder_stack();
  if (!view.FindBlockers(blockers, receiver_, seen, occluders)) return 0;
  return view.VisibleFormFactor(seen, occluders);
}

template <std::size_t N>
void PairIntegral::Evaluate(Cell& cell, const KronrodRule<N>& rule) const {
  double both = 0, gauss_s = 0, gauss_t = 0, largest = 0;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) {
      const double s = rule.node[i], t = rule.node[j];
      const double visible = Visible(At(cell.quad, s, t), cell.blockers);
      const double value = Jacobian(cell.quad, s, t) * visible;
      largest = std::max(largest, visible);
      both += rule.kronrod[i] * rule.kronrod[j] * value;
      gauss_s += rule.gauss[i] * rule.kronrod[j] * value;
      gauss_t += rule.kronrod[i] * rule.gauss[j] * value;
    }
  cell.value = both;
  cell.error_s = std::abs(both - gauss_s);
  cell.error_t = std::abs(both - gauss_t);
  cell.points = N * N;
  if (cell.shadowed && !cell.lines.empty()) FindUnseen(cell, largest);
}

// Adds up what lines may hide that cross the cell with all its points on one side, or with none near enough
// to see what changes fast. Away from contacts the integrand changes over the distance of what makes the
// event, or over the breadth of the source's image.
void PairIntegral::FindUnseen(Cell& cell, double largest) const {
  constexpr KronrodRule<7> rule = kSeven;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<Vec2, 49> points;
  for (std::size_t i = 0; i < 49; ++i) points[i] = At(cell.quad, rule.node[i / 7], rule.node[i % 7]);
  const Polygon2 polygon = ToPolygon(cell.quad);
  largest = std::max(largest, Visible(points[24], {}));
  double worst = 0;
  for (const std::int32_t l : cell.lines) {
    const EventLine& line = lines_[static_cast<std::size_t>(l)];
    double above = kNone, below = kNone;  // the distances of the nearest points
    for (const Vec2& p : points) {
      const double height = line.normal.dot(p) - line.offset;
      double& nearest = height > 0 ? above : below;
      nearest = std::min(nearest, std::abs(height));
    }
    const bool one_side = above == kNone || below == kNone;
    const double gap = std::max(above, below);
    if ((!one_side && line.reach > 0.5 * gap) || !Alive(line, cell.blockers)) continue;
    const Stretch inside = Inside(line, polygon);
    const double scale = std::min(
        source_breadth_, Reach(line, std::max(line.low, inside.low), std::min(line.high, inside.high)));
    const double length = inside.high - inside.low;
    double hidden = 0;
    if (one_side) {
      double depth = 0;
      for (const Vec2& p : polygon)
        depth = std::max(depth, (below == kNone ? -1 : 1) * (line.normal.dot(p) - line.offset));
      hidden = depth * length * largest * (depth < scale ? depth / scale : 1);
    } else if (scale < 0.5 * gap) {
      hidden = scale * length * largest;
    } else {
      continue;
    }
    cell.unseen += hidden;
    if (hidden <= worst) continue;
    worst = hidden;
    cell.unseen_line = l;
  }
}

void PairIntegral::Evaluate(Cell& cell) const {
  if (!cell.blockers.empty()) {
    TubeEnds ends;
    for (const Vec2& p : ToPolygon(cell.quad)) ends.receiver.push_back(frame_.FromPlane(p));
    ends.source = source_part_;
    std::vector<PatchId> blockers;
    if (!FindTubeBlockers(scene_, ends, receiver_, source_, cell.blockers, blockers)) {
      cell.settled = cell.shadowed = true;
      return;
    }
    cell.blockers = std::move(blockers);
  }
  cell.shadowed = !cell.blockers.empty();
  // The integrand is analytic where nothing blocks, and past a single blocker between its events: curved
  // events take edges of three polygons.
  bool analytic = !cell.shadowed;
  if (cell.shadowed) {
    Evaluate(cell, kSeven);
    analytic = cell.blockers.size() == 1 && all_lines_known_ &&
               std::none_of(cell.lines.begin(), cell.lines.end(), [&](std::int32_t l) {
                 return Alive(lines_[static_cast<std::size_t>(l)], cell.blockers);
               });
  } else {
    cell.lines.clear();
    Evaluate(cell, kFifteen);
  }
  if (analytic) {
    const auto reduced = [&](double difference) {
      const double x = kAnalyticScale * difference / cell.value;
      return cell.value > 0 ? std::min(difference, cell.value * x * std::sqrt(x)) : difference;
    };
    cell.error_s = reduced(cell.error_s);
    cell.error_t = reduced(cell.error_t);
  }
  const double noise = (cell.shadowed ? kShadowNoise : kClearNoise) * cell.value;
  double width = 0;
  for (const Vec2& p : cell.quad) width = std::max(width, (p - cell.quad[1]).norm());
  cell.settled = cell.Error() <= noise || width <= kLeastWidth * diameter_;
}

FormFactorEstimate PairIntegral::Integrate() {
  ParallelFor(cells_.size(), 1, [&](std::size_t i) { Evaluate(cells_[i]); });
  double value = 0, error = 0;
  bool shadowed = false;
  std::size_t points = 0;
  for (const Cell& cell : cells_) points += cell.points;
  for (;;) {
    value = error = 0;
    shadowed = false;
    for (const Cell& cell : cells_) {
      value += cell.value;
      error += cell.Error();
      shadowed = shadowed || cell.shadowed;
    }
    const double asked =
        std::max(options_.enough, value * (shadowed ? options_.tolerance : options_.clear_tolerance));
    if (error <= asked || points >= options_.max_points) break;
    if (options_.context && options_.context->Cancelled()) break;
    std::vector<std::size_t> order(cells_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return cells_[i].settled || cells_[i].Error() == 0; });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(-cells_[a].Error(), a) < std::pair(-cells_[b].Error(), b);
    });
    if (order.empty()) break;
    double left = 0;
    for (const std::size_t i : order) left += cells_[i].Error();
    std::size_t chosen = 0;
    const double alone = std::max(kLeftAlone * left, 0.5 * asked);
    while (chosen < order.size() && (left > alone || chosen == 0)) left -= cells_[order[chosen++]].Error();
    std::vector<std::vector<Cell>> parts(chosen);
    ParallelFor(chosen, 1, [&](std::size_t k) {
      Split(cells_[order[k]], parts[k]);
      for (Cell& part : parts[k]) Evaluate(part);
    });
    for (std::size_t k = 0; k < chosen; ++k) {
      for (const Cell& part : parts[k]) points += part.points;
      cells_[order[k]] = std::move(parts[k].front());
      cells_.insert(cells_.end(), std::make_move_iterator(parts[k].begin() + 1),
                    std::make_move_iterator(parts[k].end()));
    }
  }
  // Points are where they are meant to be but for a rounding of their coordinates; how much that matters
  // depends on how near the source is.
  const double apart =
      (Centroid(source_part_) - frame_.FromPlane(area_[0])).norm() - diameter_ - Diameter(source_part_);
  const double nearness = std::min(1 / diameter_, apart > 0 ? 4 / apart : 1 / diameter_);
  const double rounding =
      kFormFactorError +
      4 * std::numeric_limits<double>::epsilon() * scene_.patches[receiver_].extent * nearness +
      (shadowed ? kShadowNoise : 0);
  return {value, error + rounding * value};
}

double Area(const AreaPart& part) { return VectorArea(part.polygon).norm(); }

// What may stand between two areas, ascending.
void FindBetween(const PatchHierarchy& patches, const TubeEnds& ends, const Patch& receiver,
                 const Patch& source, std::vector<PatchId>& found) {
  Vec3 low = ends.receiver[0], high = low;
  for (const Polygon3* polygon : {&ends.receiver, &ends.source})
    for (const Vec3& v : *polygon) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  ConvexRegion region = {{receiver.normal, receiver.normal.dot(receiver.vertex[0])},
                         {source.normal, source.normal.dot(source.vertex[0])}};
  for (int axis = 0; axis < 3; ++axis) {
    region.push_back({Vec3::Unit(axis), low[axis]});
    region.push_back({-Vec3::Unit(axis), -high[axis]});
  }
  patches.Find(region, {}, found);
}

}  // namespace

std::vector<AreaPart> PartsOfFace(const Scene& scene, std::int32_t face) {
  std::vector<AreaPart> parts;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    if (std::find(patch.faces.begin(), patch.faces.end(), face) == patch.faces.end()) continue;
    Polygon3 part(patch.Vertices().begin(), patch.Vertices().end());
    if (patch.faces.size() > 1) {
      // Two triangles were joined: this one's share is what lies in it.
      const Polygon3& triangle = scene.faces[static_cast<std::size_t>(face)].vertices;
      for (std::size_t i = 0; i < triangle.size() && !part.empty(); ++i) {
        const Vec3 edge = triangle[(i + 1) % triangle.size()] - triangle[i];
        const Vec3 inwards = patch.normal.cross(edge);
        if (inwards.isZero(0)) continue;
        part = ClipToHalfSpace(part, inwards.normalized(), triangle[i], 1e-13 * patch.extent);
      }
      if (part.empty()) continue;
    }
    parts.push_back({static_cast<PatchId>(p), std::move(part)});
  }
  return parts;
}

FormFactorEstimate AreaFormFactor(const Scene& scene, const PatchHierarchy& patches, const AreaPart& from,
                                  const AreaPart& to, const AreaFormFactorOptions& options) {
  if (from.patch == to.patch) return {};
  const double from_area = Area(from);
  const bool swap = !options.points_on_first && Area(to) < from_area;
  const AreaPart &receiver = swap ? to : from, &source = swap ? from : to;
  const Patch &receiver_patch = scene.patches[static_cast<std::size_t>(receiver.patch)],
              &source_patch = scene.patches[static_cast<std::size_t>(source.patch)];
  const std::optional<TubeEnds> ends =
      ClipToEachOther(receiver.polygon, receiver_patch, source.polygon, source_patch);
  if (!ends) return {};
  std::vector<PatchId> found, blockers;
  FindBetween(patches, *ends, receiver_patch, source_patch, found);
  if (!FindTubeBlockers(scene, *ends, receiver.patch, source.patch, found, blockers)) return {};
  const FormFactorEstimate integral =
      PairIntegral(scene, *ends, receiver.patch, source.patch, std::move(blockers), options).Integrate();
  return {integral.factor / from_area, integral.error / from_area};
}

FormFactorEstimate AreaFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const AreaFormFactorOptions& options) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  const PatchHierarchy patches(scene, std::move(all));
  std::vector<FormFactorEstimate> pairs(from.size() * to.size());
  const auto flux_error = [&](std::size_t k) { return Area(from[k / to.size()]) * pairs[k].error; };
  const auto solve = [&](std::span<const std::size_t> which, const AreaFormFactorOptions& how) {
    ParallelFor(which.size(), 1, [&](std::size_t i) {
      if (how.context && how.context->Cancelled()) return;
      const std::size_t k = which[i];
      pairs[k] = AreaFormFactor(scene, patches, from[k / to.size()], to[k % to.size()], how);
    });
  };
  std::vector<std::size_t> which(pairs.size());
  std::iota(which.begin(), which.end(), std::size_t{0});
  if (pairs.size() == 1) {
    solve(which, options);
  } else {
    // First as well as is cheap, then those that matter as well as matters for the sum.
    AreaFormFactorOptions rough = options;
    rough.tolerance = std::max(options.tolerance, kRoughTolerance);
    solve(which, rough);
    double flux = 0, error = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      flux += Area(from[k / to.size()]) * pairs[k].factor;
      error += flux_error(k);
    }
    const double asked = options.tolerance * flux;
    if (error > asked) {
      const double share = 0.5 * asked / static_cast<double>(pairs.size());
      std::erase_if(which, [&](std::size_t k) { return flux_error(k) <= share; });
      AreaFormFactorOptions fine = options;
      fine.tolerance = 0;
      fine.enough = asked / static_cast<double>(2 * which.size());
      solve(which, fine);
    }
  }
  double area = 0;
  FormFactorEstimate sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double weight = Area(from[i]);
    area += weight;
    for (std::size_t j = 0; j < to.size(); ++j) {
      sum.factor += weight * pairs[i * to.size() + j].factor;
      sum.error += weight * pairs[i * to.size() + j].error;
    }
  }
  if (area == 0) return {};
  return {sum.factor / area, sum.error / area};
}

}  // namespace penumbra
