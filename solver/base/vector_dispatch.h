// solver/base/vector_dispatch.h
//
// The macro PENUMBRA_VECTOR_CLONES before a function compiles the function for several widths of SIMD
// vectors. The program selects, when it starts, the version for the widest SIMD vectors that the processor
// supports. The binary runs on every x86-64 processor.

#pragma once

// PENUMBRA_VECTOR_CLONES is empty in sanitizer builds: the selection at run time uses an ifunc, which runs
// before the sanitizers' run-time libraries are initialised.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PENUMBRA_VECTOR_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define PENUMBRA_VECTOR_CLONES
#endif
