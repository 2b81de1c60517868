// mesh/interpolants/current_irradiance.h
//
// Exact irradiance from a solution that changes: made when someone asks for it, forgotten after a change.

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
  // From the solution as it is; null if it was cancelled.
  using Make = std::function<std::unique_ptr<const PointIrradiance>(const ExecutionContext&)>;

  explicit CurrentIrradiance(Make make) : make_(std::move(make)) {}

  // The same until Reset(); null if it was cancelled. Safe from any thread, but not beside Reset().
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
