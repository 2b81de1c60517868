#include "solver/transport/links/link_form_factor_methods.h"

#include "solver/transport/links/cubature_link_form_factor.h"
#include "solver/transport/links/disk_link_form_factor.h"
#include "solver/transport/links/exact_link_form_factor.h"

namespace penumbra {

LinkFormFactorRegistry& LinkFormFactorMethods() {
  static LinkFormFactorRegistry registry(
      "form-factor method of links",
      {CubatureLinkFormFactorMethod(), ExactLinkFormFactorMethod(), DiskLinkFormFactorMethod()});
  return registry;
}

}  // namespace penumbra
