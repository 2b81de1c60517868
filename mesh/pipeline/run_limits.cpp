#include "mesh/pipeline/run_limits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

namespace penumbra {
namespace {

// The interval between checks of the limits.
constexpr std::chrono::milliseconds kInterval{2};

}  // namespace

std::uint64_t ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  if (!(file >> total >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

RunLimits::RunLimits(const ExecutionContext& outer, std::optional<double> seconds,
                     std::optional<double> bytes, Clock::time_point begin, double kept)
    : outer_(outer),
      seconds_(seconds),
      bytes_(bytes),
      kept_(kept),
      begin_(begin),
      inner_([&outer](std::string_view phase, double fraction) { outer.Report(phase, fraction); }) {
  if (!watched()) return;
  Check();
  watcher_ = std::thread([this] {
    while (!done_) {
      Check();
      std::this_thread::sleep_for(kInterval);
    }
  });
}

RunLimits::~RunLimits() {
  done_ = true;
  if (watcher_.joinable()) watcher_.join();
}

void RunLimits::Check() {
  const std::chrono::duration<double> elapsed = Clock::now() - begin_;
  if (seconds_ && elapsed.count() > *seconds_) late_ = true;
  if (bytes_ && static_cast<double>(ResidentBytes()) > (1 - kept_) * *bytes_) large_ = true;
  if (late_ || large_ || outer_.Cancelled()) inner_.Cancel();
}

std::optional<std::string> RunLimits::Exceeded() const {
  if (late_) return fmt::format("the time limit of {:g} s", *seconds_);
  if (large_) return fmt::format("the memory limit of {:.0f} bytes", *bytes_);
  return std::nullopt;
}

}  // namespace penumbra
