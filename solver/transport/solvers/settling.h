// solver/transport/solvers/settling.h
//
// Sweeps until the light has settled: which scheme, which acceleration, and a bound of what is still missing.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "solver/base/progress.h"
#include "solver/transport/links/push_pull.h"

namespace penumbra {

enum class Acceleration : std::uint8_t {
  kNone,      // sweep after sweep, as in the thesis
  kAnderson,  // guess ahead from one sweep to the next (AndersonAcceleration)
};

// A bound, by channel, of the light that is still to come, for each unit by which the last sweep changed the
// radiosity of any leaf: the largest entry of M (I - M)^-1 1, M being reflectance times the links' transport.
// For closed rooms of reflectance r it is r / (1 - r); open ones have less. It holds for the links as they
// are, whose form factors need not add up to 1, by partial sums and a geometric bound of the rest (a
// Collatz-Wielandt bound of M's norm). Infinite if light grows on the links without end.
// Cancelled, it gives what it has come to.
Rgb LightToCome(const PushPull& push_pull, const RadiositySolution& solution,
                const ExecutionContext& context = ExecutionContext());

struct Settled {
  // What is missing from any radiosity is at most this much, relative to the largest reflected radiosity.
  double residual = 1;
  std::size_t sweeps = 0;
  double to_come = 0;  // LightToCome() of the channel where it is most
};

struct SettlingOptions {
  IterationScheme scheme;
  Acceleration acceleration;
  double cutoff;  // the residual at which the light has settled
};

// Sweeps until the light has settled, or until cancelled.
Settled Settle(PushPull& push_pull, RadiositySolution& solution, std::span<const Rgb> correction,
               const SettlingOptions& options, const ExecutionContext& context);

}  // namespace penumbra
