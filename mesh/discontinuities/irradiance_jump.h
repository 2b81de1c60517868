// mesh/discontinuities/irradiance_jump.h
//
// Jumps of the irradiance's derivatives across a discontinuity, computed from the geometry at a point of the
// discontinuity. The weights of discontinuities in W/m^2 are estimated from the jumps of the irradiance's
// derivatives (thesis 8.2).
//
// Consider a point x of a receiver that moves across a discontinuity. As seen from x, an edge of a blocker
// passes a vertex of the source (VE), or a vertex of a blocker passes an edge of the source (EV), with speed
// w in the image. In a VE or EV event, the edge cuts the polygon to which the vertex belongs in a chord. At a
// VE or EV event, the derivative of the chord's length with respect to the position of the edge jumps by some
// value s. The second derivative of the source's visible area, and thus of the irradiance, jumps by w^2 s,
// where w is the speed of the edge in the image and s is the jump of the chord's derivative. If the edge of
// the source and the edge of the blocker lie in one plane with x, the images of the two edges overlap in a
// segment. If the source edge and the blocker edge are coplanar, the length of the chord itself jumps by the
// length of the overlap of the edges' images. For coplanar edges, the gradient of the irradiance jumps by
// (speed w of the edge in the image) * (length of the overlap).
//
// In an EEE (three-edge) event, three edges appear to meet in one point, as seen from a point of the
// receiver. At a distance d from the discontinuity of an EEE event, the three edges enclose a triangle of the
// area (d * sum lambda_i w_i)^2 / (2 |lambda_1 lambda_2 lambda_3|), where w_i is the speed of edge i in the
// image, and lambda_i the sine of the angle between the other two edges. On one side of the discontinuity of
// an EEE event, the part of the source in the triangle between the three edges becomes visible or hidden.

#pragma once

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/silhouettes.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Returns the jump of the irradiance's derivatives at `x`, a point of a discontinuity of any kind but
// kContact. `across` is a unit vector in the receiver's plane, perpendicular to the discontinuity. JumpAt()
// assumes a source with radiosity 1 W/m^2 everywhere. JumpAt() ignores all blockers except those whose edges
// or vertices cause the discontinuity. All members of the IrradianceJump are zero for a contact, where the
// irradiance itself jumps.
IrradianceJump JumpAt(const Scene& scene, const Silhouettes& silhouettes, const Discontinuity& d,
                      const Vec3& x, const Vec3& across);

// Returns the edge of the source at its vertex `k` that lies within `tolerance` [m] of the plane of the
// vertex and the segment ab. If both edges of the source at vertex `k` lie within `tolerance` of the plane,
// the edge closer to the plane is returned. CoplanarEdge() returns -1 if neither edge of the source at vertex
// `k` lies within `tolerance` of the plane.
std::int32_t CoplanarEdge(const Patch& source, std::int32_t k, const Vec3& a, const Vec3& b,
                          double tolerance);

}  // namespace penumbra
