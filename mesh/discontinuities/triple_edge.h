// mesh/discontinuities/triple_edge.h
//
// Triple-edge (EEE) events: as seen from a point of the receiver, three edges meet in one point. Either one
// edge is the source's and two are silhouette edges of blockers, or all three are silhouette edges of
// blockers in front of the source's interior (thesis 5.2; Gigus and Malik 1990). The lines that touch three
// skew edges rule a quadric. The quadric's trace on the receiver is a piece of a conic.
//
// For a point p of the first edge, the line through p and the other two edges has the direction n2 x n3,
// where n2 and n3 are normals of the planes through p and the second or the third edge. The normals n2 and n3
// are linear in p, and the direction n2 x n3 is therefore quadratic in p. The function whose sign tells on
// which side of another edge the line passes is quadratic in p, too. Events begin and end at roots of such
// quadratic functions.

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

// Traces the events of all triples of edges that consist of an edge of the source and two silhouette edges of
// blockers, or of three silhouette edges of blockers. Triples in which two of the edges lie in one plane are
// omitted: the events of such triples are VE or EV events, or degenerate to points. REQUIRES:
// options.tolerance > 0.
std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options);

}  // namespace penumbra
