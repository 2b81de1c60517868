// mesh/discontinuities/irradiance_jump.h
//
// Jumps of the irradiance's derivatives across a discontinuity, computed from the geometry at a point of the
// trace. Weights in W/m^2 are estimated from these jumps (thesis 8.2).
//
// Consider a point x that moves across the trace. As seen from x, an edge of a blocker's image passes a
// vertex of the source (VE), or a vertex of the blocker's image passes an edge of the source (EV), with speed
// w. The slope of the chord between the two changes there. The second derivative of the visible area, and
// thus of the irradiance, jumps by w^2 times the change of slope. If the two edges lie in one plane, the
// chord itself jumps by the length that the edges share, and the gradient jumps by w times this length.
//
// Three edges that meet in one point of the image (EEE) enclose a triangle on either side of the event. The
// triangle's area grows with the square of the distance: (sum of lambda_i w_i)^2 / (2 |lambda_1 lambda_2
// lambda_3|), where lambda_i is the sine of the angle between the other two edges. One such triangle appears
// or vanishes.

#pragma once

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/silhouettes.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The jump at `x`, a point of the trace of a VE, EV, EEE, near or horizon discontinuity. `across` is a unit
// vector in the receiver's plane, across the trace. The source's radiosity is 1 W/m^2 everywhere; of the
// blockers, only the event's own are taken into account. All members are zero for a contact.
IrradianceJump JumpAt(const Scene& scene, const Silhouettes& silhouettes, const Discontinuity& d,
                      const Vec3& x, const Vec3& across);

// The edge of the source at its vertex `k` that lies within `tolerance` [m] of the plane of the vertex and
// the segment ab; if both edges do, the closer one; -1 if neither does.
std::int32_t CoplanarEdge(const Patch& source, std::int32_t k, const Vec3& a, const Vec3& b,
                          double tolerance);

}  // namespace penumbra
