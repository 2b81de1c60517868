// solver/transport/solvers/settling.h
//
// Sweeps until the light has settled, with a choice of scheme and acceleration, and a bound of the missing
// light.

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
// closed rooms of reflectance r the bound is r / (1 - r); in open rooms it is less. The bound holds for the
// existing links, whose form factors need not add up to 1: partial sums, plus a geometric bound of the rest
// (a Collatz-Wielandt bound of the norm of M). Infinite if light grows on the links without limit. If
// cancelled, returns the bound computed so far.
Rgb LightToCome(const PushPull& push_pull, const RadiositySolution& solution,
                const ExecutionContext& context = ExecutionContext());

struct Settled {
  // Bound of the light missing from any radiosity, relative to the largest reflected radiosity.
  double residual = 1;
  std::size_t sweeps = 0;
  double to_come = 0;  // the largest channel of LightToCome()
};

struct SettlingOptions {
  IterationScheme scheme;
  Acceleration acceleration;
  double cutoff;  // the residual at which the light has settled
};

// Sweeps until the light has settled or the context is cancelled.
Settled Settle(PushPull& push_pull, RadiositySolution& solution, std::span<const Rgb> correction,
               const SettlingOptions& options, const ExecutionContext& context);

}  // namespace penumbra
