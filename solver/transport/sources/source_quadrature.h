// solver/transport/sources/source_quadrature.h
//
// Quadrature of the irradiance at a point from a source with varying radiosity: quadrature nodes and weights
// on the part of the source that is visible from the point. For polygons of constant radiosity, quadrature is
// unnecessary, because the irradiance has a closed form. For polynomial radiosities, a closed form would be
// too expensive: degree 1 already needs special functions (Chen and Arvo, A closed-form solution for the
// irradiance due to linearly-varying luminaires, 2000).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/point_view.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// An upper bound of SourceQuadratureError() for a point whose height above the source's plane is at least
// 1e-3 * (largest coordinate of the point and of the source).
inline constexpr double kSourceQuadratureError = 1e-11;

// An upper bound of |sum of node weights - form factor of the point to the part of the source| [1], with and
// without blockers. SourceQuadratureError() is the sum of a quadrature error and a rounding error. The
// quadrature error is that of ten Gauss nodes on each of about a hundred pieces of the source. The rounding
// error is that of the point's height above the source, to which all weights are proportional.
double SourceQuadratureError(const ReceiverPoint& at, const Patch& source);

struct SourceNode {
  Vec3 position;      // position of the quadrature node on the source [m]
  double weight = 0;  // the contribution of the node to the form factor of the point [1]
};

// Appends quadrature nodes for a part of the source. For a radiosity f that is smooth over the part, sum of
// weight * f(position) is the irradiance at the point from the part. The part of the source is halved
// repeatedly until each piece is small relative to its distance from the point; each piece then gets Gauss
// nodes. REQUIRES: the part is convex, lies in the plane of `source`, and is above the point's horizon; the
// point lies in front of the plane of `source`.
void AddSourceNodes(const ReceiverPoint& at, const Patch& source, std::span<const Vec3> part,
                    std::vector<SourceNode>& nodes);

// Appends quadrature nodes for the visible region of a convex part of a source: the part is clipped to the
// receiver's horizon, and blockers among the candidates are cut out exactly. `own` is the patch on which the
// receiver point lies. REQUIRES: the last call of view.FaceSource() was for this source and returned true.
void AddVisibleSourceNodes(PointView& view, std::span<const Vec3> part, std::span<const PatchId> candidates,
                           PatchId own, std::vector<SourceNode>& nodes);

}  // namespace penumbra
