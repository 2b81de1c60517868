// mesh/refinement/refinement_step.h
//
// What can be done about triangles that err by too much: their leaf can be divided, or a discontinuity that
// the mesh goes without can become an edge of it.

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
  // An area of a triangle that errs and that is expected to keep to the error afterwards [m^2].
  struct Mended {
    std::uint32_t triangle = 0;  // of the mesh
    double area = 0;
  };

  PatchId patch = kNoPatch;
  ElementId leaf = kNoElement;    // that is divided; kNoElement: a discontinuity becomes an edge
  std::size_t discontinuity = 0;  // of OmittedOfPatch::found
  double cost = 0;                // triangles that it adds or makes anew
  std::vector<Mended> mended;

  bool Divides() const { return leaf != kNoElement; }
};

// All steps that help triangles which err by more than `error` (TriangleError::max): one for each of their
// leaves and, if `omitted` has one for each patch, for each discontinuity whose jumps tell enough of the
// error of a triangle that it crosses. Errors are relative to the irradiance, or to `floor` where it is
// darker [W/m^2].
std::vector<RefinementStep> FindRefinementSteps(const IrradianceMesh& mesh,
                                                std::span<const PatchTriangulation> triangulations,
                                                std::span<const TriangleError> errors,
                                                std::span<const OmittedOfPatch> omitted, double error,
                                                double floor);

// Those that mend most for what they cost, best first, until they mend so much area [m^2], or all. What
// several would mend counts for the first of them.
std::vector<std::size_t> ChooseRefinementSteps(std::span<const RefinementStep> steps, double area);

}  // namespace penumbra
