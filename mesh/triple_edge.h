// mesh/triple_edge.h
//
// Triple-edge (EEE) events: from a point of the receiver an edge of the source and two silhouette edges of
// blockers appear to meet in one point (thesis 5.2; Gigus and Malik 1990). The lines that touch three skew
// edges rule a quadric, and its trace on the receiver is a piece of a conic.

#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "mesh/silhouettes.h"
#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

using EdgeEnds = std::array<Vec3, 2>;

// A line that touches three edges and the receiver's plane.
struct Transversal {
  std::array<Vec3, 3> on_edge;  // on the source's edge, and on the two of blockers
  Vec3 on_receiver;
};

// The lines through three edges, by the place on the first where they touch it.
class RuledSurface {
 public:
  // `normal` and `origin` are of the receiver's plane.
  RuledSurface(const EdgeEnds& source, const EdgeEnds& first, const EdgeEnds& second, const Vec3& origin,
               const Vec3& normal)
      : source_(source), first_(first), second_(second), origin_(origin), normal_(normal) {}

  // True if no two of the edges lie in one plane, but for `rounding` [m].
  bool Skew(double rounding) const;

  struct Range {
    double t0, t1;
  };
  // Where on the source's edge the line through it and the two others touches these between their ends, from
  // 0 to 1: ascending, disjoint. The bounds are roots of linear functions.
  std::vector<Range> Domain() const;

  // The line through the source's point at t; nothing where it does not meet the two edges, and then the
  // receiver, all on the same side of the source's point.
  std::optional<Transversal> At(double t) const;

 private:
  EdgeEnds source_, first_, second_;
  Vec3 origin_, normal_;
};

// One event of a receiver and a source, with its trace as a polyline.
struct TripleEdgeTrace {
  std::int32_t source_edge = 0;
  PatchEdge first, second;  // of blockers
  struct Piece {
    Transversal from, to;
  };
  std::vector<Piece> pieces;  // their ends lie on the curve
};

struct TripleEdgeOptions {
  double tolerance = 0;      // no point of the curve lies farther from its polyline [m]
  bool keep_hidden = false;  // also where another blocker stands in the lines
  double gap = 0;            // what comes nearer to the receiver touches it [m]
  double rounding = 0;       // distances up to this are none [m]
};

// The events of all pairs of silhouette edges of the blockers. Edges that lie in one plane with another of
// the three are left out: their events are VE and EV events, or end in points. Pieces may run out of the
// receiver. REQUIRES: a positive tolerance.
std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options);

}  // namespace penumbra
