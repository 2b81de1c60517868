// solver/transport/form_factors/projected_form_factor.h
//
// The common code of the methods hemicube, cubic tetrahedron, single plane and two planes: form factors are
// found by drawing the scene, as seen from a point, on planes around the point.

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// A function that makes the planes for a resolution, with the form factors of their cells; the function may
// round the resolution up.
using PlaneMaker = std::function<std::vector<PlaneGrid>(int resolution)>;

// Computes a form factor as the mean of point form factors, each of which is found by drawing the scene on
// planes around the point. The points from which the scene is projected lie on the receiver of a link, or on
// the sender of a form factor between areas. At each point, the planes are turned about the normal by a
// seeded random angle (Ashdown 1994, 5.10). For a link, the scene is projected from the points of Cubature():
// 4 points on a quadrilateral, 3 on a triangle.
//
// For a form factor between areas, each part of the sender has 16 sample points on a quadrilateral, or 12 on
// a triangle: four times the number for the receiver of a link. The stated error of a form factor between
// areas is an estimate, not a bound, and is the sum of three terms. The first error term is the difference
// from the form factor that a quarter of the points and half the resolution give. The second error term is
// the fraction of the flux that misses all planes. The third error term is (largest form factor of a cell) /
// sqrt(number of points), because the drawn image of a target is up to one cell too large or too small.
class ProjectedFormFactor final : public LinkFormFactorMethod {
 public:
  // `standard` is the resolution of the planes if LinkFormFactorOptions::resolution is 0.
  ProjectedFormFactor(const PlaneMaker& planes, int standard, const LinkFormFactorOptions& options);

  void Find(ReceiverLinks* links, const ExecutionContext& context) const override;
  std::optional<FormFactorEstimate> Between(const Scene& scene, std::span<const AreaPart> from,
                                            std::span<const AreaPart> to,
                                            const ExecutionContext& context) const override;
  bool SeesAllAtOnce() const override { return true; }

 private:
  struct Areas;
  double Mean(const Areas& areas, const std::vector<PlaneGrid>& planes, int refinement,
              const ExecutionContext& context) const;

  PlaneMaker maker_;
  int resolution_;
  std::vector<PlaneGrid> planes_;
  std::uint64_t seed_;
  bool factors_only_;
};

}  // namespace penumbra
