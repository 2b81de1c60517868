// solver/visibility/area/event_lines.h
//
// Lines in a receiver's plane at which the topology of the visible part of a source may change: the traces of
// wedges through a vertex and an edge (Heckbert, Discontinuity meshing for radiosity, 1992) and the traces of
// the blockers' planes. An integration over the receiver may cut its cells along the event lines. Event lines
// are only candidates for discontinuities: an event may be hidden, and the size of the jump is unknown. The
// discontinuities in the mesh, in contrast, are exact visible segments with known jumps.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Two event lines, or an event line and a corner, count as coincident if their distance is below
// kSameLine * (diameter of the area). The tolerance kSameLine is far above the rounding error of event lines,
// and too small to affect an integral noticeably.
inline constexpr double kSameLine = 1e-10;

// The input of the search for event lines: a part of a receiver and a part of a source.
struct SightPair {
  PatchId source = kNoPatch;
  Frame frame;                // frame of the receiver's plane
  Polygon2 area;              // the receiver's part, in coordinates of `frame`
  Polygon3 local_source;      // the source's part, in coordinates of `frame`; z is the height [m]
  double diameter = 0;        // diameter of `area` [m]
  double source_breadth = 0;  // smallest width of the source's part [m]
};

// The cause of an event line: a vertex and an edge, or an edge of a blocker that is seen edge-on.
struct Event {
  PatchId a = kNoPatch, b = kNoPatch;  // patches of the vertex and of the edge; kNoPatch means the source
  Vec3 vertex, from, to;               // vertex, and end points of the edge, in the receiver's frame [m]
  bool edge_on = false;
};

// A line on which the topology of the visible part of the source may change, and the interval of the line on
// which a change is possible.
struct EventLine {
  Vec2 normal = Vec2::UnitX();  // unit normal of the line
  double offset = 0;            // the line consists of the points p with normal . p = offset [m]
  double low = 0, high = 0;     // ends of the interval, measured along Along() [m]
  double weight = 1;            // number of coincident events; contacts count more than once
  bool grade = false;  // true if a low edge of the source makes the integrand change fast near the line
  double reach = 0;    // the integrand changes within about this distance of the line [m]
  std::vector<Event> events;  // events of all coincident lines

  Vec2 Along() const { return {-normal.y(), normal.x()}; }
};

// The part of an event line inside a convex polygon, as an interval of coordinates along EventLine::Along()
// [m]; high <= low if this part is empty.
struct Stretch {
  double low = 0, high = 0;
};
Stretch Inside(const EventLine& line, std::span<const Vec2> polygon);

// The smallest distance [m] between an event line and the vertices and edges that cause the line. Reach()
// measures the distance along lines of sight from three points of the event line: those at `low` and `high`,
// and their midpoint.
double Reach(const EventLine& line, double low, double high);

// True if some event of the event line is caused only by patches in `blockers` and by the source: both
// Event::a and Event::b are in `blockers` or kNoPatch. REQUIRES: `blockers` is sorted in ascending order.
bool IsCastByAny(const EventLine& line, std::span<const PatchId> blockers);

struct EventLines {
  std::vector<EventLine> lines;  // without coincident lines; sorted by weight x length, descending
  bool all_known = true;         // false if there were too many lines and those of least weight are missing
};

// Finds the event lines that cross the area of the receiver. Event lines are caused by events of the source
// with each blocker and, if there are few blockers, by events between two blockers. FindEventLines() also
// returns lines around the projections of edges that lie low above the area, where the integrand changes
// fast. Curved events, which three edges cause (EEE), are not included.
EventLines FindEventLines(const Scene& scene, const SightPair& pair, std::span<const PatchId> blockers);

}  // namespace penumbra
