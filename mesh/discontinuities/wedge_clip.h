// mesh/discontinuities/wedge_clip.h
//
// Finds the visible parts of the trace of a wedge, a part of the critical plane of a VE or EV event. A wedge
// is the set of all lines from the receiver through the vertex and the edge of a VE or EV event to the
// source. The trace of a wedge is the segment in which the wedge meets the receiver.

#pragma once

#include <array>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct Wedge {
  Vec3 apex;                // vertex through which all lines of the wedge pass
  Vec3 normal;              // unit normal of the plane in which the wedge lies
  std::array<Vec3, 2> end;  // end points of the trace on the receiver [m]
  double apex_height = 0;   // height of the apex above the receiver's plane [m]
  // True for an EV event: the lines of the wedge continue beyond the apex, to the source.
  bool through_apex = false;
  Vec3 receiver_normal, source_normal;
  Vec3 on_receiver, on_source;  // one point of the receiver's plane, and one of the source's plane
  double rounding = 0;          // distances up to `rounding` count as zero [m]
};

// The visible parts of a wedge's trace on the receiver: ascending disjoint intervals of the parameter t. The
// first end of the trace is at t = 0, the second end at t = 1.
class TraceParts {
 public:
  struct Part {
    double t0, t1;
  };
  // Removes the parts of the trace that the blocker hides: the parts where the blocker cuts the wedge's lines
  // of sight strictly between source and receiver. A patch that lies in the wedge's critical plane, or on
  // only one side of this plane, hides nothing.
  void Hide(const Wedge& wedge, const Patch& blocker);
  const std::vector<Part>& parts() const { return parts_; }

 private:
  void Remove(double t0, double t1);
  std::vector<Part> parts_ = {{0, 1}};
};

}  // namespace penumbra
