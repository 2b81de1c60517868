// display/viewer/mesh_tools.h
//
// Triangles of a mesh, as the tools of the viewer ask for them.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/viewer/snapshot.h"

namespace penumbra::viewer {

std::array<Vec3, 3> TriangleVertices(const IrradianceMesh& mesh, std::uint32_t triangle);
double TriangleArea(const IrradianceMesh& mesh, std::uint32_t triangle);  // [m^2]
Vec3 NormalOf(const Scene& scene, const IrradianceMesh& mesh, std::uint32_t triangle);
// The point at barycentric coordinates (s, t).
Vec3 PointInTriangle(const IrradianceMesh& mesh, std::uint32_t triangle, double s, double t);

// The leaf of the solution's quadtrees that the triangle lies in.
ElementId LeafOf(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle);

// Whether the element is `top` or lies below it.
bool IsBelow(const ElementForest& forest, ElementId element, ElementId top);

// The triangles within any of the elements, ascending.
std::vector<std::uint32_t> TrianglesOf(const LightState& light, const IrradianceMesh& mesh,
                                       std::span<const ElementId> elements);

// A mesh of some of the triangles.
IrradianceMesh SubMesh(const IrradianceMesh& mesh, std::span<const std::uint32_t> triangles);

// The exact irradiance at (s, t) of a triangle; on its border the limit from inside [W/m^2].
Rgb ExactInTriangle(const LightState& light, const IrradianceMesh& mesh, std::uint32_t triangle, double s,
                    double t);

}  // namespace penumbra::viewer
