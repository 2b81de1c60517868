// solver/transport/sources/source_quadrature.h
//
// Quadrature of the irradiance at a point from a source with varying radiosity: nodes and weights on the part
// of the source that the point sees. Polygons of constant radiosity have a closed form. For polynomials a
// closed form costs too much: degree 1 already needs special functions (Chen and Arvo, A closed-form solution
// for the irradiance due to linearly-varying luminaires, 2000).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/point_view.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// Bound of SourceQuadratureError() for a point whose height above the source's plane is at least 1e-3 times
// the coordinates.
inline constexpr double kSourceQuadratureError = 1e-11;

// Bound of |sum of weights - form factor of the part| [1], with and without blockers. Adds the error of ten
// Gauss nodes on about a hundred pieces and the rounding of the point's height above the source, to which all
// weights are proportional.
double SourceQuadratureError(const ReceiverPoint& at, const Patch& source);

struct SourceNode {
  Vec3 position;      // on the source [m]
  double weight = 0;  // the node's part of the form factor of the point [1]
};

// Appends nodes for a part of the source. For a radiosity f that is smooth over the part, sum weight *
// f(position) is the irradiance at the point from the part. Places Gauss nodes on pieces, which are halved
// until they are far from the point in relation to their size. REQUIRES: the part is convex, in the plane of
// `source`, above the point's horizon; the point is before that plane.
void AddSourceNodes(const ReceiverPoint& at, const Patch& source, std::span<const Vec3> part,
                    std::vector<SourceNode>& nodes);

// Appends nodes for the visible region of a convex part of a source: above the horizon, with the candidates
// cut out exactly. `own` is the receiver's patch. REQUIRES: the last view.FaceSource() was for this source
// and returned true.
void AddVisibleSourceNodes(PointView& view, std::span<const Vec3> part, std::span<const PatchId> candidates,
                           PatchId own, std::vector<SourceNode>& nodes);

}  // namespace penumbra
