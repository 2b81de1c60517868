// mesh/interpolants/current_irradiance.h
//
// The exact irradiance from a radiosity solution that may change. The PointIrradiance is created on demand.
// Reset() deletes the PointIrradiance, and must be called when the solution changes.

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
  // A function that creates the PointIrradiance of the present solution, or returns null if the computation
  // is cancelled.
  using Make = std::function<std::unique_ptr<const PointIrradiance>(const ExecutionContext&)>;

  explicit CurrentIrradiance(Make make) : make_(std::move(make)) {}

  // Get() returns the same object until Reset() is called, or null if the creation of the object was
  // cancelled. Several threads may call Get() at once, but not concurrently with Reset().
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
