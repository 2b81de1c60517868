// How many random cases a test looks at.

#pragma once

#include <cstdlib>

namespace penumbra {

// `usual`; under a sanitizer, which makes them ten to twenty times as slow, a tenth of that.
// PENUMBRA_TEST_FACTOR=N in the environment makes it N times as many, for a longer search by hand.
inline int CaseCount(int usual) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  usual = (usual + 9) / 10;
#endif
  const char* factor = std::getenv("PENUMBRA_TEST_FACTOR");
  return factor ? usual * std::atoi(factor) : usual;
}

}  // namespace penumbra
