// mesh/discontinuities/irradiance_jump.h
//
// By how much the derivatives of the irradiance jump across a discontinuity, from the geometry at a point of
// its trace: the estimate behind weights in W/m^2 (thesis 8.2).
//
// Seen from a point x that moves across the trace, an edge of a blocker's image passes a vertex of the source
// (VE), or a vertex of the blocker's image an edge of the source (EV), with a speed w. The chord that the one
// cuts out of the other changes its slope there, and the second derivative of the visible area, hence of the
// irradiance, jumps by w^2 times that change. Where the two edges lie in one plane, the chord itself jumps by
// the length that they share, and the gradient by w times that.
//
// Where three edges meet in one point of the image (EEE), they enclose a triangle on either side of the
// event, whose area grows with the square of the way: (sum of lambda_i w_i)^2 / (2 |lambda_1 lambda_2
// lambda_3|), lambda_i the sine of the angle between the other two. One such triangle comes or goes.

#pragma once

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/silhouettes.h"
#include "solver/scene/scene.h"

namespace penumbra {

// At `x`, a point of the trace of a VE, EV, EEE or horizon discontinuity. `across` is a unit vector in the
// receiver's plane, across the trace. The source's radiosity is taken as 1 W/m^2 all over it; what hides part
// of it beside the event's own blocker is left out. All zero for a contact, which has no such estimate.
IrradianceJump JumpAt(const Scene& scene, const Silhouettes& silhouettes, const Discontinuity& d,
                      const Vec3& x, const Vec3& across);

// The edge of the source at its vertex `k` that lies in the plane of the vertex and the segment ab, or -1; of
// its two edges the one that comes nearer. `tolerance` in metres.
std::int32_t CoplanarEdge(const Patch& source, std::int32_t k, const Vec3& a, const Vec3& b,
                          double tolerance);

}  // namespace penumbra
