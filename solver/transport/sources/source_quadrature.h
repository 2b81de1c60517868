// solver/transport/sources/source_quadrature.h
//
// Quadrature of the irradiance at a point from a source with varying radiosity: nodes and weights on the part
// of the source that is visible from the point. For polygons of constant radiosity, quadrature is
// unnecessary, because the irradiance has a closed form. For polynomials, a closed form would be too
// expensive: degree 1 already needs special functions (Chen and Arvo, A closed-form solution for the
// irradiance due to linearly-varying luminaires, 2000).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/point_view.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A bound of SourceQuadratureError() for a point whose height above the source's plane is at least 1e-3 times
// the coordinates.
inline constexpr double kSourceQuadratureError = 1e-11;

// A bound of |sum of weights - form factor of the part| [1], with and without blockers. The bound is the sum
// of two errors: of quadrature with ten Gauss nodes on each of about a hundred pieces, and of the rounded
// height of the point above the source, to which all weights are proportional.
double SourceQuadratureError(const ReceiverPoint& at, const Patch& source);

struct SourceNode {
  Vec3 position;      // on the source [m]
  double weight = 0;  // the node's part of the form factor of the point [1]
};

// Appends nodes for a part of the source. For a radiosity f that is smooth over the part, sum weight *
// f(position) is the irradiance at the point from the part. The part is halved repeatedly until each piece is
// small relative to its distance from the point; each piece then gets Gauss nodes. REQUIRES: the part is
// convex, lies in the plane of `source`, and is above the point's horizon; the point lies before the plane of
// `source`.
void AddSourceNodes(const ReceiverPoint& at, const Patch& source, std::span<const Vec3> part,
                    std::vector<SourceNode>& nodes);

// Appends nodes for the visible region of a convex part of a source: the part is clipped to the horizon, and
// the candidates are cut out exactly. `own` is the receiver's patch. REQUIRES: the last view.FaceSource() was
// for this source and returned true.
void AddVisibleSourceNodes(PointView& view, std::span<const Vec3> part, std::span<const PatchId> candidates,
                           PatchId own, std::vector<SourceNode>& nodes);

}  // namespace penumbra
