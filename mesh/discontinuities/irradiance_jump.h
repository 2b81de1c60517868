// mesh/discontinuities/irradiance_jump.h
//
// Jumps of the irradiance's derivatives across a discontinuity, computed from the geometry at a point of the
// trace. The weights of discontinuities in W/m^2 are estimated from the jumps (thesis 8.2).
//
// Consider a point x that moves across the trace. As seen from x, an edge of a blocker's image passes a
// vertex of the source (VE), or a vertex of the blocker's image passes an edge of the source (EV), with speed
// w. In both cases, the edge cuts the polygon to which the vertex belongs in a chord. At a VE or EV event,
// the derivative of the chord's length with respect to the position of the edge jumps by some s. The second
// derivative of the visible area, and thus of the irradiance, jumps by w^2 s. If the edge of the source and
// the edge of the blocker lie in one plane, their images overlap in a segment; in this case, the length of
// the chord itself jumps by the length of this segment, and the gradient of the irradiance jumps by w times
// this length.
//
// In an EEE event, three edges meet in one point of the image. If x is at the distance d from the trace of an
// EEE event, the three edges enclose a triangle of the area (d * sum lambda_i w_i)^2 / (2 |lambda_1 lambda_2
// lambda_3|), where w_i is the speed of edge i, and lambda_i is the sine of the angle between the other two
// edges. At an EEE event, the triangle on one side of the trace becomes visible or hidden.

#pragma once

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/silhouettes.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The jump at `x`, a point of the trace of a VE, EV, EEE, near or horizon discontinuity. `across` is a unit
// vector in the receiver's plane, across the trace. The source's radiosity is 1 W/m^2 everywhere; only the
// blockers that take part in the event are taken into account. All members are zero for a contact.
IrradianceJump JumpAt(const Scene& scene, const Silhouettes& silhouettes, const Discontinuity& d,
                      const Vec3& x, const Vec3& across);

// The edge of the source at its vertex `k` that lies within `tolerance` [m] of the plane of the vertex and
// the segment ab; if both edges at `k` do, the closer one; -1 if neither does.
std::int32_t CoplanarEdge(const Patch& source, std::int32_t k, const Vec3& a, const Vec3& b,
                          double tolerance);

}  // namespace penumbra
