// mesh/interpolants/current_irradiance.h
//
// Exact irradiance from a solution that changes: created on demand, and dropped when the solution changes.

#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "solver/base/progress.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class CurrentIrradiance {
 public:
  // Creates the irradiance from the present solution. Null if it was cancelled.
  using Make = std::function<std::unique_ptr<const PointIrradiance>(const ExecutionContext&)>;

  explicit CurrentIrradiance(Make make) : make_(std::move(make)) {}

  // Returns the same object until Reset(); null if its creation was cancelled. Safe from any thread, but not
  // concurrently with Reset().
  const PointIrradiance* Get(const ExecutionContext& context = ExecutionContext()) {
    const std::lock_guard<std::mutex> lock(making_);
    if (!irradiance_) irradiance_ = make_(context);
    return irradiance_.get();
  }
  void Reset() { irradiance_.reset(); }

 private:
  const Make make_;
  std::mutex making_;
  std::unique_ptr<const PointIrradiance> irradiance_;
};

}  // namespace penumbra
