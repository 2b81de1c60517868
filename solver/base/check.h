// solver/base/check.h
//
// The program distinguishes two kinds of failure: unusable input, and bugs. If the user's input cannot be
// used, the program throws InputError, and the command prints one line and ends with exit status 1. If the
// program has a bug, PENUMBRA_CHECK prints the violated condition and aborts.

#pragma once

#include <stdexcept>
#include <string>

namespace penumbra {

// The exception thrown if the user's input is wrong. The message what() of an InputError is one line of the
// form "FILE:LINE: error: what is wrong and how to mend it".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace internal {
[[noreturn]] void CheckFailed(const char* condition, const char* file, int line);
}  // namespace internal

}  // namespace penumbra

// PENUMBRA_CHECK checks its condition in every build. Use PENUMBRA_CHECK for contracts that are cheap to
// check.
#define PENUMBRA_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::penumbra::internal::CheckFailed(#condition, __FILE__, __LINE__))

// PENUMBRA_DCHECK checks its condition only in the builds dev, asan and tsan. Use PENUMBRA_DCHECK in inner
// loops and to validate whole data structures.
#ifdef PENUMBRA_CHECKS
#define PENUMBRA_DCHECK(condition) PENUMBRA_CHECK(condition)
#else
#define PENUMBRA_DCHECK(condition) static_cast<void>(sizeof(condition))
#endif
