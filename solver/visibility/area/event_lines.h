// solver/visibility/area/event_lines.h
//
// Lines in a receiver's plane on which what is seen of a source past blockers changes in kind: the traces of
// wedges through a vertex and an edge, as in Heckbert, Discontinuity meshing for radiosity (1992), and of the
// blockers' planes. They are candidates of integration: every line that may matter, with the stretch where it
// may; whether something hides the event there is not asked, and what jumps across it is not known. (That is
// what the mesh's discontinuities are: exact visible segments with their jumps.)

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Lines this near to each other or to a corner are one, relative to the area's diameter: a choice, well above
// the roundings of what makes them, and below what would show in a sum.
inline constexpr double kSameLine = 1e-10;

// A part of a receiver and the part of a source that it sees, for which lines are sought.
struct SightPair {
  PatchId source = kNoPatch;
  Frame frame;                // of the receiver's plane
  Polygon2 area;              // the receiver's part, in the frame
  Polygon3 local_source;      // the source's part, in the frame: z is the height [m]
  double diameter = 0;        // of the area [m]
  double source_breadth = 0;  // the smallest of the source's part [m]
};

// What makes an event: a vertex and an edge, or an edge and its end alone where a blocker is seen edge-on.
struct Event {
  PatchId a = kNoPatch, b = kNoPatch;  // whose vertex, whose edge; kNoPatch stands for the source
  Vec3 vertex, from, to;               // in the receiver's frame [m]
  bool edge_on = false;
};

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

// Where a line runs in a convex polygon, along Along() [m]; high <= low: nowhere.
struct Stretch {
  double low = 0, high = 0;
};
Stretch Inside(const EventLine& line, std::span<const Vec2> polygon);

// How near to the stretch of the line from low to high what makes it comes [m].
double Reach(const EventLine& line, double low, double high);

// Whether some event of the line has just these blockers, which ascend, or the source.
bool IsCastByAny(const EventLine& line, std::span<const PatchId> blockers);

struct EventLines {
  std::vector<EventLine> lines;  // those that coincide are one; the heaviest first
  bool all_known = true;         // false if there were too many, and the lightest were left out
};

// The lines that run through the area: events of the source with the blockers, and of not too many blockers
// among each other; and lines around the feet of edges that hang low over the area, where the integrand
// changes fast. Curved events, of three edges, are left out.
EventLines FindEventLines(const Scene& scene, const SightPair& pair, std::span<const PatchId> blockers);

}  // namespace penumbra
