#include "solver/transport/form_factors/link_form_factor_methods.h"

#include "solver/transport/form_factors/book_rays_form_factor.h"
#include "solver/transport/form_factors/contour_form_factor.h"
#include "solver/transport/form_factors/cubic_tetrahedron.h"
#include "solver/transport/form_factors/hemicube.h"
#include "solver/transport/form_factors/malley_form_factor.h"
#include "solver/transport/form_factors/monte_carlo_form_factor.h"
#include "solver/transport/form_factors/rays_form_factor.h"
#include "solver/transport/form_factors/single_plane.h"
#include "solver/transport/form_factors/two_planes.h"
#include "solver/transport/links/cubature_link_form_factor.h"
#include "solver/transport/links/disk_link_form_factor.h"
#include "solver/transport/links/exact_link_form_factor.h"

namespace penumbra {

LinkFormFactorRegistry& LinkFormFactorMethods() {
  static LinkFormFactorRegistry registry(
      "form-factor method of links",
      {CubatureLinkFormFactorMethod(), ExactLinkFormFactorMethod(), DiskLinkFormFactorMethod(),
       HemicubeMethod(), CubicTetrahedronMethod(), SinglePlaneMethod(), TwoPlanesMethod(),
       RaysFormFactorMethod(), BookRaysFormFactorMethod(), MalleyFormFactorMethod(),
       MonteCarloFormFactorMethod(), ContourFormFactorMethod()});
  return registry;
}

}  // namespace penumbra
