// solver/transport/points/sample_bytes.h
//
// Writes samples of irradiance as bytes and reads them back, to pass samples from one process to another.

#pragma once

#include <memory>

#include "solver/geometry/vec_bytes.h"
#include "solver/transport/points/factor_row.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

template <class Archive>
void Transfer(Archive& archive, PointIrradianceResult& result) {
  Transfer(archive, result.irradiance);
  Transfer(archive, result.one_sided);
  Transfer(archive, result.deviation);
  bool has_row = result.row != nullptr;
  Transfer(archive, has_row);
  if (!has_row) return;
  if (!result.row) result.row = std::make_shared<FactorRow>();
  TransferPlain(archive, result.row->sources);
  TransferPlain(archive, result.row->terms);
  Transfer(archive, result.row->returned);
}

}  // namespace penumbra
