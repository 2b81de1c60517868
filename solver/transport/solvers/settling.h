// solver/transport/solvers/settling.h
//
// Sweeps until the light has converged, with a choice of iteration scheme and acceleration, and bounds the
// light that is still missing.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solver/base/progress.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra {

enum class Acceleration : std::uint8_t {
  kNone,      // plain sweeps, as in the thesis
  kAnderson,  // extrapolates between sweeps (AndersonAcceleration)
};

// A bound of the missing light for each channel, per unit of the largest change of a leaf's radiosity in the
// last sweep: the largest entry of M (I - M)^-1 1, where M is reflectance times the links' transport. In
// closed rooms of reflectance r, the bound is r / (1 - r); in open rooms, it is smaller. The bound is
// computed from partial sums of the series M + M^2 + ... and a geometric bound of the rest (a
// Collatz-Wielandt bound of the norm of M); it holds even if the form factors of the links do not add up to
// 1. The bound is infinite if the series diverges. If cancelled, returns the bound computed so far.
Rgb LightToCome(const PushPull& push_pull, const RadiositySolution& solution,
                const ExecutionContext& context = ExecutionContext());

struct Settled {
  // A bound of the error of every radiosity, relative to the largest reflected radiosity.
  double residual = 1;
  std::size_t sweeps = 0;
  double to_come = 0;  // the largest channel of LightToCome()
};

struct SettlingOptions {
  IterationScheme scheme;
  Acceleration acceleration;
  double cutoff;  // the residual at which the light has settled
};

// Sweeps until the residual is at most options.cutoff, or the context is cancelled.
Settled Settle(PushPull& push_pull, RadiositySolution& solution, std::span<const Rgb> correction,
               const SettlingOptions& options, const ExecutionContext& context);

}  // namespace penumbra
