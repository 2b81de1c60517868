// solver/transport/sources/source_quadrature.h
//
// The irradiance at a point from a radiosity that varies over a source: nodes and weights on what the point
// sees of it. A polygon of constant radiosity has a closed form; polynomials have none that is worth its
// price (Chen and Arvo, A closed-form solution for the irradiance due to linearly-varying luminaires, 2000,
// needs special functions for degree 1 already).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/point_view.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// Bound of SourceQuadratureError() for points that are at least 1e-3 of their coordinates above the source's
// plane.
inline constexpr double kSourceQuadratureError = 1e-11;

// Largest error of the sum of the weights against the form factor of the same part [1], past blockers or not:
// that of ten Gauss nodes on some hundred pieces, and what the rounding of the point's height above the
// source makes of the weights, all of which are in proportion to it.
double SourceQuadratureError(const ReceiverPoint& at, const Patch& source);

struct SourceNode {
  Vec3 position;      // on the source [m]
  double weight = 0;  // form factor of the point to the node's share [1]
};

// Appends nodes with which sum weight x f(position) is the irradiance at the point from a part of the source
// of radiosity f, smooth over the part. The part is convex, in the plane of `source`, before the point's
// horizon; the point is before that plane. Gauss nodes on pieces that are halved until they are far from the
// point for their size.
void AddSourceNodes(const ReceiverPoint& at, const Patch& source, std::span<const Vec3> part,
                    std::vector<SourceNode>& nodes);

// The same for what the point sees of any convex part of a source, above the horizon and past the candidates,
// which are cut out exactly; `own` is the receiver's patch. REQUIRES: view.FaceSource() of that source, which
// gave true.
void AddVisibleSourceNodes(PointView& view, std::span<const Vec3> part, std::span<const PatchId> candidates,
                           PatchId own, std::vector<SourceNode>& nodes);

}  // namespace penumbra
