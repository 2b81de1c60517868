// mesh/discontinuities/wedge_clip.h
//
// The visible parts of a wedge's trace. A wedge is the set of all lines of a VE or EV event from the receiver
// through the event's vertex to the source; it is a part of the critical plane of the event. The trace of a
// wedge is a segment on the receiver.

#pragma once

#include <array>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct Wedge {
  Vec3 apex;                  // the vertex through which all lines pass
  Vec3 normal;                // unit normal of the critical plane
  std::array<Vec3, 2> end;    // of the trace
  double apex_height = 0;     // above the receiver's plane [m]
  bool through_apex = false;  // EV: the lines continue beyond the apex, to the source
  Vec3 receiver_normal, source_normal;
  Vec3 on_receiver, on_source;  // a point of each plane
  double rounding = 0;          // distances up to this count as zero [m]
};

// The visible parts of a wedge's trace: ascending disjoint intervals of the parameter t, where t = 0 is the
// first end of the trace and t = 1 the second end.
class TraceParts {
 public:
  struct Part {
    double t0, t1;
  };
  // Removes the parts that the blocker hides: those where the blocker intersects the wedge's lines strictly
  // between source and receiver. A patch that lies in the critical plane, or only on one side of it, hides
  // nothing.
  void Hide(const Wedge& wedge, const Patch& blocker);
  const std::vector<Part>& parts() const { return parts_; }

 private:
  void Remove(double t0, double t1);
  std::vector<Part> parts_ = {{0, 1}};
};

}  // namespace penumbra
