// mesh/refinement/refinement_step.h
//
// Refinement steps that reduce the errors of the interpolants of triangles. A refinement step divides the
// quadtree leaf that contains a triangle, or adds an edge along a discontinuity that the mesh omits.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/triangle_error.h"
#include "mesh/refinement/local_pass.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

struct RefinementStep {
  // A triangle, and the part of its area that is expected to meet the error limit after a refinement step
  // [m^2].
  struct Mended {
    std::uint32_t triangle = 0;  // the index of the triangle in the list of the mesh
    double area = 0;
  };

  PatchId patch = kNoPatch;
  ElementId leaf = kNoElement;    // the leaf to divide; kNoElement: a discontinuity becomes an edge
  std::size_t discontinuity = 0;  // discontinuity that becomes an edge: index in OmittedOfPatch::found
  // The number of triangles that the refinement step adds or triangulates again.
  double cost = 0;
  std::vector<Mended> mended;

  bool Divides() const { return leaf != kNoElement; }
};

// Returns all refinement steps that may reduce the error of triangles with TriangleError::max > error. There
// is one refinement step for each quadtree leaf that contains triangles with too large an error. There is
// also one refinement step for each omitted discontinuity that crosses a triangle with too large an error and
// causes a sufficiently large part of this error. Discontinuities are considered only if `omitted` has an
// entry for each patch. Errors are relative to max(irradiance, floor) [W/m^2].
std::vector<RefinementStep> FindRefinementSteps(const IrradianceMesh& mesh,
                                                std::span<const PatchTriangulation> triangulations,
                                                std::span<const TriangleError> errors,
                                                std::span<const OmittedOfPatch> omitted, double error,
                                                double floor);

// Chooses refinement steps in order of decreasing (sum of Mended::area) / cost, until the area that the steps
// bring below the error limit reaches `area` [m^2], or no step is left. Returns the indices of the chosen
// steps. If several refinement steps would bring the same triangle below the error limit, the triangle's area
// is counted only for the first of these steps.
std::vector<std::size_t> ChooseRefinementSteps(std::span<const RefinementStep> steps, double area);

}  // namespace penumbra
