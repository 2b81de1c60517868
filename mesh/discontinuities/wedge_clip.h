// mesh/discontinuities/wedge_clip.h
//
// How much of a wedge reaches the receiver past other blockers. A wedge is the part of a critical plane (the
// plane of a VE or EV event) that the lines from source to receiver sweep through the vertex; its trace is a
// segment on the receiver.

#pragma once

#include <array>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct Wedge {
  Vec3 apex;                  // the vertex through which all lines run
  Vec3 normal;                // unit, of the critical plane
  std::array<Vec3, 2> end;    // of the trace
  double apex_height = 0;     // above the receiver's plane [m]
  bool through_apex = false;  // EV: lines run on beyond the apex, up to the source
  Vec3 receiver_normal, source_normal;
  Vec3 on_receiver, on_source;  // a point of each plane
  double rounding = 0;          // distances up to this are none [m]
};

// The parts of a trace that are left, as fractions from its first end to its second: ascending, disjoint.
class TraceParts {
 public:
  struct Part {
    double t0, t1;
  };
  // Takes out what the patch hides: where it meets the wedge's lines strictly between source and receiver.
  // A patch that lies in the critical plane, or has no points on both sides of it, hides nothing.
  void Hide(const Wedge& wedge, const Patch& blocker);
  const std::vector<Part>& parts() const { return parts_; }

 private:
  void Remove(double t0, double t1);
  std::vector<Part> parts_ = {{0, 1}};
};

}  // namespace penumbra
