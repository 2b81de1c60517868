// mesh/interpolants/vertex_light.h
//
// Irradiance at the vertices of the leaves of a quadtree, from which the light between the vertices is
// reconstructed: means of the leaves around a vertex (I. Ashdown, Radiosity: A Programmer's Perspective,
// 1994, section 4.16), or exact irradiance.

#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "solver/base/progress.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

// The irradiance at each vertex of the leaves of one patch [W/m^2].
using VertexLight = std::unordered_map<LatticePoint, Rgb, LatticePointHash>;

// For each patch, the unweighted means of the irradiances of the leaves that have the vertex as a corner. A
// leaf with a vertex in the middle of an edge (T-vertex) does not count at this vertex. `irradiance` is
// indexed by ElementId [W/m^2].
std::vector<VertexLight> NodalAverages(const ElementForest& forest, std::span<const Rgb> irradiance);

// For each patch, the exact irradiances at the vertices. Where the irradiance jumps at a vertex, the value is
// the limit from the first leaf, in the order of ElementForest::Leaves(), that has the vertex as a corner. If
// the computation is cancelled, the remaining values are 0.
std::vector<VertexLight> ExactAtVertices(const ElementForest& forest, const PointIrradiance& irradiance,
                                         const ExecutionContext& context);

// The light between the corners of a leaf: bilinear on a quadrilateral, linear on a triangle. (s, t) are the
// coordinates of the point in the leaf (ElementLocator::Place). REQUIRES: `light` has all corners of the
// leaf.
Rgb BilinearAt(const Element& leaf, const VertexLight& light, double s, double t);

}  // namespace penumbra
