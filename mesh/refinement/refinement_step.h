// mesh/refinement/refinement_step.h
//
// Remedies for triangles with too large an error: a division of the triangle's leaf, or an edge along a
// discontinuity that the mesh omits.

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
  // The area of a triangle, or a part of it, that is expected to meet the error after the step [m^2].
  struct Mended {
    std::uint32_t triangle = 0;  // index in the mesh
    double area = 0;
  };

  PatchId patch = kNoPatch;
  ElementId leaf = kNoElement;    // the leaf to divide; kNoElement: a discontinuity becomes an edge
  std::size_t discontinuity = 0;  // index in OmittedOfPatch::found
  double cost = 0;                // number of triangles added or made anew
  std::vector<Mended> mended;

  bool Divides() const { return leaf != kNoElement; }
};

// All steps that help triangles with TriangleError::max above `error`: one for each leaf of such triangles,
// and one for each omitted discontinuity whose jumps explain enough of the error of a triangle that the
// discontinuity crosses. Discontinuities take part only if `omitted` has an entry for each patch. Errors are
// relative to the irradiance, or to `floor` [W/m^2] if the irradiance is less.
std::vector<RefinementStep> FindRefinementSteps(const IrradianceMesh& mesh,
                                                std::span<const PatchTriangulation> triangulations,
                                                std::span<const TriangleError> errors,
                                                std::span<const OmittedOfPatch> omitted, double error,
                                                double floor);

// The indices of the steps with the largest (area mended) / cost, best first, until they mend `area` [m^2] or
// no step is left. An area that several steps would mend counts for the first of them.
std::vector<std::size_t> ChooseRefinementSteps(std::span<const RefinementStep> steps, double area);

}  // namespace penumbra
