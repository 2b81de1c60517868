// solver/transport/solvers/settling.h
//
// Makes sweeps (gathers over all links) until the light has converged, with a choice of iteration scheme and
// acceleration, and computes a bound of the light that is still missing.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solver/base/progress.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra {

enum class Acceleration : std::uint8_t {
  kNone,      // sweeps without acceleration, as in the thesis
  kAnderson,  // extrapolates between sweeps (AndersonAcceleration)
};

// For each channel, a bound of (radiosity still missing after a sweep) / (largest change of a leaf's
// radiosity in the sweep). LightToCome() is the largest entry of the vector M (I - M)^-1 1, where 1 is the
// vector of ones, and M is the matrix of reflectance times form factor of the links. In closed rooms of
// reflectance r, LightToCome() is r / (1 - r); in open rooms, LightToCome() is smaller than r / (1 - r).
// LightToCome() is computed from partial sums of the series M + M^2 + ... and a geometric bound of the rest
// (a Collatz-Wielandt bound of the norm of M). The bound LightToCome() holds even if the form factors of the
// links do not add up to 1. LightToCome() is infinite if the series M + M^2 + ... diverges. If cancelled,
// LightToCome() returns the bound computed so far.
Rgb LightToCome(const PushPull& push_pull, const RadiositySolution& solution,
                const ExecutionContext& context = ExecutionContext());

struct Settled {
  // A bound of the error of every radiosity, relative to the largest reflected radiosity.
  double residual = 1;
  std::size_t sweeps = 0;
  double to_come = 0;  // LightToCome() in the channel where it is largest
};

struct SettlingOptions {
  IterationScheme scheme;
  Acceleration acceleration;
  double cutoff;                // the residual below which no further sweeps are made
  std::size_t most_sweeps = 0;  // the largest number of sweeps; 0: no limit
};

// Makes sweeps until the residual is at most options.cutoff, or until the computation is cancelled
// (ExecutionContext).
Settled Settle(PushPull& push_pull, RadiositySolution& solution, std::span<const Rgb> correction,
               const SettlingOptions& options, const ExecutionContext& context);

}  // namespace penumbra
