// display/viewer/mesh_tools.h
//
// Functions on the triangles of a mesh, for the viewer's tools (selection, graphs, probes).

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/viewer/snapshot.h"

namespace penumbra::viewer {

std::array<Vec3, 3> TriangleVertices(const IrradianceMesh& mesh, std::uint32_t triangle);
double TriangleArea(const IrradianceMesh& mesh, std::uint32_t triangle);  // area of the triangle [m^2]
Vec3 NormalOf(const Scene& scene, const IrradianceMesh& mesh, std::uint32_t triangle);
// The point of a triangle at barycentric coordinates (s, t) [m].
Vec3 PointInTriangle(const IrradianceMesh& mesh, std::uint32_t triangle, double s, double t);

// The leaf of the solution's quadtrees that contains the triangle.
ElementId LeafOf(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle);

// True if `element` is `top` or a descendant of `top`.
bool IsBelow(const ElementForest& forest, ElementId element, ElementId top);

// The indices, in ascending order, of the triangles that lie in one of the listed elements.
std::vector<std::uint32_t> TrianglesOf(const LightState& light, const IrradianceMesh& mesh,
                                       std::span<const ElementId> elements);

// A mesh that consists of the listed triangles.
IrradianceMesh SubMesh(const IrradianceMesh& mesh, std::span<const std::uint32_t> triangles);

// The exact irradiance at the point with barycentric coordinates (s, t) of a triangle [W/m^2]. On the
// triangle's border, ExactInTriangle() returns the limit from the triangle's interior.
Rgb ExactInTriangle(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle, double s,
                    double t);

}  // namespace penumbra::viewer
