// solver/base/check.h
//
// There are two kinds of failure. InputError: the user's input cannot be used; the command ends with one line
// and exit status 1. PENUMBRA_CHECK: the program has a bug; the program prints the violated condition and
// aborts.

#pragma once

#include <stdexcept>
#include <string>

namespace penumbra {

// The error that the user's input is wrong. what() is one line, "FILE:LINE: error: what is wrong and how to
// mend it".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace internal {
[[noreturn]] void CheckFailed(const char* condition, const char* file, int line);
}  // namespace internal

}  // namespace penumbra

// Checks the condition in every build. Use PENUMBRA_CHECK for contracts that are cheap to check.
#define PENUMBRA_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::penumbra::internal::CheckFailed(#condition, __FILE__, __LINE__))

// Checks the condition only in the builds dev, asan and tsan. Use PENUMBRA_DCHECK in inner loops and to
// validate whole data structures.
#ifdef PENUMBRA_CHECKS
#define PENUMBRA_DCHECK(condition) PENUMBRA_CHECK(condition)
#else
#define PENUMBRA_DCHECK(condition) static_cast<void>(sizeof(condition))
#endif
