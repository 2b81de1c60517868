// solver/transport/points/factor_row.h
//
// The form factors of one point to nodes of the source trees: one row of the transport operator. Irradiance
// is linear in the radiosities, so a row that is kept gives the irradiance for any later radiosities of the
// same sources as a product, without a look at the scene.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {

// The light of a node at the point: factor * (mean radiosity of the node) + (slope of the node) * moment.
struct FactorTerm {
  double factor = 0;       // form factor to the visible part of the node [1]
  std::int32_t node = -1;  // index in the source set
  // What weighs the slope of the node's radiosity: factor * (centroid of the visible part - centre of the
  // node), or a first-order estimate of it [m].
  std::array<float, 3> moment = {0, 0, 0};
  // The error of the term, relative to factor * radiosity, is about `by_spread` times the spread of the node
  // plus `by_residual` times its residual (SourceSet::Node).
  float by_spread = 0, by_residual = 0;
};

struct FactorRow {
  // The terms of one source.
  struct Source {
    PatchId patch = kNoPatch;
    std::uint32_t first = 0, end = 0;  // range in `terms`
    float unhindered = 0;              // form factor to the whole patch without blockers [1]
  };
  std::vector<Source> sources;
  std::vector<FactorTerm> terms;
  double returned = 0;  // the largest SentBack() of the sources [1]
};

// The irradiance from the terms [first, end) of a row [W/m^2]. Linear in the radiosities of the set; it may
// be negative by the error of the slopes.
Rgb Irradiance(const FactorRow& row, std::uint32_t first, std::uint32_t end, const SourceSet& sources);
// The irradiance of the whole row, at least 0 [W/m^2].
Rgb Irradiance(const FactorRow& row, const SourceSet& sources);

}  // namespace penumbra
