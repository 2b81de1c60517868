// solver/transport/form_factors/projected_form_factor.h
//
// Form factors by drawing what a point sees on planes before it: what hemicube, cubic tetrahedron and single
// plane have in common.

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/transport/form_factors/plane_grid.h"
#include "solver/transport/links/link_form_factor_method.h"

namespace penumbra {

// Makes the planes for a resolution, which it rounds up as it needs, with the form factors of their cells.
using PlaneMaker = std::function<std::vector<PlaneGrid>(int resolution)>;

// The mean over a few points of the receiver, or of the sender of a form factor between areas. The planes are
// turned about the normal by a seeded random angle at each point (Ashdown 1994, 5.10). A link takes the
// points of Cubature(): 4 of a quadrilateral, 3 of a triangle.
//
// A form factor between areas takes four times as many points on each part of the sender. Its error is
// |difference from a quarter of the points at half the resolution|, plus the flux that misses all planes,
// plus (the largest cell) / sqrt(number of points), since a target may be missed by less than a cell at each
// point. It indicates the error and does not bound it.
class ProjectedFormFactor final : public LinkFormFactorMethod {
 public:
  // `standard`: the resolution if the options ask for none.
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
