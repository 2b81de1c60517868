// mesh/discontinuities/triple_edge.h
//
// Triple-edge (EEE) events: as seen from a point of the receiver, three edges meet in one point. Either one
// edge is the source's and two are silhouette edges of blockers, or all three are silhouette edges of
// blockers in front of the source's interior (thesis 5.2; Gigus and Malik 1990). The lines that touch three
// skew edges rule a quadric. The quadric's trace on the receiver is a piece of a conic.
//
// Let p move along the first edge. The line through p and the other two edges is the intersection of two
// planes, which contain p and one of these edges each. The normals of both planes are linear in p. Therefore
// the line's direction is quadratic in p, and so is every function that tells on which side the line passes
// another line. Events begin and end at roots of such functions.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/discontinuities/silhouettes.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

// A line that touches three edges, from the receiver's plane to the source's plane.
struct Transversal {
  std::array<Vec3, 3> on_edge;
  Vec3 on_receiver, on_source;
};

// One event of a receiver and a source, with its trace as a polyline.
struct TripleEdgeTrace {
  std::array<PatchEdge, 3> edge;  // only the first can be an edge of the source
  struct Piece {
    Transversal from, to;
  };
  std::vector<Piece> pieces;  // their ends lie on the curve
};

struct TripleEdgeOptions {
  double tolerance = 0;      // largest distance of the curve from its polyline, apart from rounding [m]
  bool keep_hidden = false;  // keep the parts that other blockers hide
  double gap = 0;            // whatever is closer to the receiver touches it [m]
  double rounding = 0;       // distances up to this count as zero [m]
};

// The events of each pair of blockers' silhouette edges with an edge of the source, and of each triple of
// blockers' silhouette edges. Triples in which two edges lie in one plane are omitted: their events are VE or
// EV events, or degenerate to points. REQUIRES: options.tolerance > 0.
std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options);

}  // namespace penumbra
