// solver/visibility/area/event_lines.h
//
// Lines in a receiver's plane at which the topology of the visible part of a source may change: the traces of
// wedges through a vertex and an edge (Heckbert, Discontinuity meshing for radiosity, 1992) and the traces of
// the blockers' planes. An integration over the receiver may cut its cells along the event lines. Event lines
// are only candidates: an event may be hidden, and the size of the jump is unknown. The mesh's
// discontinuities, in contrast, are exact visible segments with their jumps.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Two lines, or a line and a corner, coincide if their distance is below kSameLine * (diameter of the area).
// kSameLine is far above the rounding error of the lines, and too small to affect an integral noticeably.
inline constexpr double kSameLine = 1e-10;

// A part of a receiver and a part of a source, the input of the search for event lines.
struct SightPair {
  PatchId source = kNoPatch;
  Frame frame;                // of the receiver's plane
  Polygon2 area;              // the receiver's part, in `frame`
  Polygon3 local_source;      // the source's part, in `frame`: z is the height [m]
  double diameter = 0;        // of `area` [m]
  double source_breadth = 0;  // the smallest breadth of the source's part [m]
};

// The cause of an event line: a vertex and an edge, or the edge of a blocker that is seen edge-on.
struct Event {
  PatchId a = kNoPatch, b = kNoPatch;  // owners of vertex and edge; kNoPatch: the source
  Vec3 vertex, from, to;               // in the receiver's frame [m]
  bool edge_on = false;
};

// A line on which the topology of the visible part may change, and the stretch of the line where a change is
// possible.
struct EventLine {
  Vec2 normal = Vec2::UnitX();  // unit
  double offset = 0;            // normal . p [m]
  double low = 0, high = 0;     // ends of the stretch, along Along() [m]
  double weight = 1;            // the number of events that coincide; contacts count more
  bool grade = false;           // a low edge of the source makes the integrand change fast here
  double reach = 0;             // the integrand changes within about this distance of the line [m]
  std::vector<Event> events;    // of the lines that coincide

  Vec2 Along() const { return {-normal.y(), normal.x()}; }
};

// The part of a line inside a convex polygon, as an interval of coordinates along Along() [m]; high <= low if
// the part is empty.
struct Stretch {
  double low = 0, high = 0;
};
Stretch Inside(const EventLine& line, std::span<const Vec2> polygon);

// The smallest distance, measured along lines of sight, between the vertices and edges that cause the line
// and three points of the line: the two ends `low` and `high`, and their midpoint [m].
double Reach(const EventLine& line, double low, double high);

// True if for at least one event of the line, both owners, a and b, are in `blockers` or are the source.
// REQUIRES: `blockers` is sorted in ascending order.
bool IsCastByAny(const EventLine& line, std::span<const PatchId> blockers);

struct EventLines {
  std::vector<EventLine> lines;  // without coincident lines; the largest weight x length first
  bool all_known = true;         // false: there were too many lines, and the lightest are missing
};

// The event lines that cross the area: events of the source with each blocker, events between pairs of
// blockers if the blockers are few, and lines around the projections of edges that lie low above the area,
// where the integrand changes fast. Curved events (EEE) are not included.
EventLines FindEventLines(const Scene& scene, const SightPair& pair, std::span<const PatchId> blockers);

}  // namespace penumbra
