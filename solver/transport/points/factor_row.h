// solver/transport/points/factor_row.h
//
// A FactorRow holds the form factors of one point to nodes of the sources' quadtrees: one row of the light
// transport operator. Irradiance is linear in the radiosities of the sources. For new radiosities of the same
// sources, a stored FactorRow therefore gives the irradiance as a sum of products, without new visibility
// tests.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {

// The irradiance that one source node brings to the point: factor * (mean radiosity of the node) + (slope of
// the node's radiosity) * moment.
struct FactorTerm {
  double factor = 0;       // form factor to the visible part of the node [1]
  std::int32_t node = -1;  // index of the node in the SourceSet
  // The weight of the slope of the node's radiosity: factor * (centroid of the node's visible part - centre
  // of the node), or a first-order estimate of this product [m].
  std::array<float, 3> moment = {0, 0, 0};
  // The relative error of a FactorTerm is about by_spread * Node::spread + by_residual * Node::residual,
  // where `spread` and `residual` describe the variation of radiosity over the source node (SourceSet::Node).
  float by_spread = 0, by_residual = 0;
};

struct FactorRow {
  // The range of a FactorRow's terms that belong to one source patch.
  struct Source {
    PatchId patch = kNoPatch;
    std::uint32_t first = 0, end = 0;  // range of the source's terms in `terms`
    float unhindered = 0;              // form factor to the whole patch without blockers [1]
  };
  std::vector<Source> sources;
  std::vector<FactorTerm> terms;
  // The largest fraction of the point's light that returns to the point after one reflection at a source
  // (SentBack) [1].
  double returned = 0;
};

// The irradiance from the terms [first, end) of a row [W/m^2]. The irradiance from a range of terms is linear
// in the radiosities of the SourceSet, and may be slightly negative because of errors of the estimated slopes
// of radiosity.
Rgb Irradiance(const FactorRow& row, std::uint32_t first, std::uint32_t end, const SourceSet& sources);
// The irradiance from all terms of the row, clamped to values >= 0 [W/m^2].
Rgb Irradiance(const FactorRow& row, const SourceSet& sources);

}  // namespace penumbra
