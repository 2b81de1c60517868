// solver/visibility/area/event_lines.h
//
// Lines in a receiver's plane at which the topology of the visible part of a source may change: the traces of
// wedges through a vertex and an edge (Heckbert, Discontinuity meshing for radiosity, 1992) and the traces of
// the blockers' planes. A quadrature over the receiver may cut its integration cells along the event lines.
// Event lines are only candidates for discontinuities: blockers may hide the vertex or the edge that causes
// the line, and the size of the jump is unknown. The discontinuities in the mesh, in contrast, are exact
// visible segments with known jumps of irradiance or of its derivatives.

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
  Frame frame;    // the coordinate frame of the receiver's plane
  Polygon2 area;  // the part of the receiver, in the coordinates of `frame` [m]
  // The part of the source, in the coordinates of `frame`; z is the height above the receiver [m].
  Polygon3 local_source;
  double diameter = 0;        // the diameter of the receiver's part `area` [m]
  double source_breadth = 0;  // the smallest width of the part of the source [m]
};

// The cause of an event line: a vertex and an edge, or an edge of a blocker that is seen edge-on.
struct Event {
  // The patches that have the vertex and the edge; kNoPatch stands for the source.
  PatchId a = kNoPatch, b = kNoPatch;
  // The vertex and the end points of the edge, in the receiver's frame [m].
  Vec3 vertex, from, to;
  bool edge_on = false;
};

// A line on which the topology of the visible part of the source may change, and the interval of the line on
// which a change is possible.
struct EventLine {
  Vec2 normal = Vec2::UnitX();  // the unit normal of the line in the receiver's plane
  double offset = 0;            // the line consists of the points p with normal . p = offset [m]
  double low = 0, high = 0;     // the interval of the line is [low, high], measured along Along() [m]
  double weight = 1;  // number of coincident events; contacts of a blocker with the receiver count more
  // True if an edge of the source close to the receiver makes the form factor change fast near the line.
  bool grade = false;
  // Distance from the line within which the form factor of a point changes because of the events [m].
  double reach = 0;
  // The events (vertex and edge that align) of all lines that coincide with this line.
  std::vector<Event> events;

  Vec2 Along() const { return {-normal.y(), normal.x()}; }
};

// The part of an event line inside a convex polygon, as an interval of coordinates along EventLine::Along()
// [m]; high <= low if this part is empty.
struct Stretch {
  double low = 0, high = 0;
};
Stretch Inside(const EventLine& line, std::span<const Vec2> polygon);

// The smallest distance [m] from three points of an event line, at `low`, at `high` and midway, to the
// vertices and edges that cause the line. Reach() measures the distance between a point of the event line and
// a vertex or edge along the line of sight that passes through the point, the vertex and the edge.
double Reach(const EventLine& line, double low, double high);

// True if some event of the event line is caused only by patches in `blockers` and by the source: both
// Event::a and Event::b are in `blockers` or kNoPatch. REQUIRES: `blockers` is sorted in ascending order.
bool IsCastByAny(const EventLine& line, std::span<const PatchId> blockers);

struct EventLines {
  std::vector<EventLine> lines;  // no two of these lines coincide; sorted by weight x length, descending
  // False if there were too many event lines, so that those of least weight x length are missing.
  bool all_known = true;
};

// Finds the event lines that cross the area of the receiver. The vertex and the edge that cause an event line
// belong to the source and a blocker or, if there are few blockers, to two blockers. FindEventLines() also
// returns lines around the projections of edges that lie close above the receiver's area, where the form
// factor of a point changes fast. Curved discontinuities, which three edges cause (EEE events), are not
// included.
EventLines FindEventLines(const Scene& scene, const SightPair& pair, std::span<const PatchId> blockers);

}  // namespace penumbra
