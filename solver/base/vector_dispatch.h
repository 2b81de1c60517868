// solver/base/vector_dispatch.h
//
// PENUMBRA_VECTOR_CLONES before a function compiles it for several vector widths; the program takes the
// widest that the processor has, when it starts. The binary stays portable x86-64.

#pragma once

// Run-time dispatch goes through an ifunc, which the sanitizers' run-time libraries cannot instrument that
// early.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PENUMBRA_VECTOR_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define PENUMBRA_VECTOR_CLONES
#endif
