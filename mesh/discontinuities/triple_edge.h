// mesh/discontinuities/triple_edge.h
//
// Triple-edge (EEE) events: from a point of the receiver three edges appear to meet in one point, an edge of
// the source and two silhouette edges of blockers, or three of blockers before the inside of the source
// (thesis 5.2; Gigus and Malik 1990). The lines that touch three skew edges rule a quadric, and its trace on
// the receiver is a piece of a conic.
//
// Let p run along the first edge. The line through p and the two others lies in the planes of p with each of
// them, whose normals are linear in p; so the direction of the line is quadratic, and so is everything that
// tells on which side it passes another line. Where an event begins or ends are roots of such functions.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/discontinuities/silhouettes.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A line that touches three edges, from the receiver's plane to the source's.
struct Transversal {
  std::array<Vec3, 3> on_edge;
  Vec3 on_receiver, on_source;
};

// One event of a receiver and a source, with its trace as a polyline.
struct TripleEdgeTrace {
  std::array<PatchEdge, 3> edge;  // only the first can be the source's
  struct Piece {
    Transversal from, to;
  };
  std::vector<Piece> pieces;  // their ends lie on the curve
};

struct TripleEdgeOptions {
  double tolerance = 0;      // no point of the curve lies farther from its polyline, but for rounding [m]
  bool keep_hidden = false;  // also where another blocker stands in the lines
  double gap = 0;            // what comes nearer to the receiver touches it [m]
  double rounding = 0;       // distances up to this are none [m]
};

// The events of all pairs of silhouette edges of the blockers with an edge of the source, and of all three of
// blockers. Edges that lie in one plane with another of the three are left out: their events are VE and EV
// events, or end in points. REQUIRES: a positive tolerance.
std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options);

}  // namespace penumbra
