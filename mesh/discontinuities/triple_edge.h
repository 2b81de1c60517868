// mesh/discontinuities/triple_edge.h
//
// Finds triple-edge (EEE) events: as seen from a point of the receiver, three edges appear to meet in one
// point. In a triple-edge event, either one edge belongs to the source and two are silhouettes of blockers,
// or all three are silhouettes of blockers in front of the source (thesis 5.2; Gigus and Malik 1990). All
// lines that touch three skew edges form a ruled quadric. The intersection of the quadric with the receiver
// is a piece of a conic.
//
// The line through a point p of the first edge that meets the two other edges has the direction n2 x n3,
// where n2 and n3 are normals of the planes through p and the second or the third edge. The normals n2 and n3
// of the planes through p and an edge are linear in p, and the direction n2 x n3 is therefore quadratic in p.
// The function whose sign tells on which side of another edge the line n2 x n3 through p passes is also
// quadratic in p. A triple-edge event begins and ends at points p of the first edge where a quadratic
// function of p is zero.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/discontinuities/silhouettes.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A line that touches three edges, with its points on the edges, on the receiver's plane and on the source's
// plane.
struct Transversal {
  std::array<Vec3, 3> on_edge;
  Vec3 on_receiver, on_source;
};

// One triple-edge event of a receiver and a source, with its trace on the receiver as a polyline.
struct TripleEdgeTrace {
  // The three edges of the event, of which only the first can be an edge of the source.
  std::array<PatchEdge, 3> edge;
  struct Piece {
    Transversal from, to;
  };
  std::vector<Piece> pieces;  // segments of the polyline; the ends of each segment lie on the true curve
};

struct TripleEdgeOptions {
  // The largest distance between the true curve of an event and its polyline, apart from rounding errors [m].
  double tolerance = 0;
  bool keep_hidden = false;  // if true, keeps the parts of the curve that other blockers hide
  double gap = 0;            // blockers within the distance `gap` of the receiver count as touching it [m]
  double rounding = 0;       // distances up to `rounding` count as zero [m]
};

// Traces the triple-edge events of all triples of edges. A triple consists of an edge of the source and two
// silhouette edges of blockers, or of three silhouette edges of blockers. Triples of edges in which two edges
// lie in one plane are omitted, because the events of two coplanar edges are VE or EV events, or degenerate
// to points. REQUIRES: options.tolerance > 0.
std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options);

}  // namespace penumbra
