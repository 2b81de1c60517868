#include "apps/interruptible.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <string_view>

#include "apps/commands.h"
#include "apps/messages.h"

namespace penumbra {
namespace {

class ProgressLine {
 public:
  ProgressLine() : shown_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() {
    if (!last_.empty()) Put("");
  }

  void Show(std::string_view phase, double fraction) {
    if (!shown_) return;
    const std::string line = fmt::format("{} {:3.0f} %", phase, 100 * fraction);
    const auto now = std::chrono::steady_clock::now();
    if (line == last_ || (phase == phase_ && now - drawn_ < kInterval)) return;
    drawn_ = now;
    phase_ = phase;
    last_ = line;
    Put(line);
  }

 private:
  static constexpr std::chrono::milliseconds kInterval{100};

  static void Put(const std::string& line) { PrintText(fmt::format("\r\x1b[K{}", line)); }

  bool shown_;
  std::string phase_, last_;
  std::chrono::steady_clock::time_point drawn_;
};

std::atomic<ExecutionContext*> interrupted_context{nullptr};
static_assert(std::atomic<ExecutionContext*>::is_always_lock_free, "a signal handler may use it");

void CancelContext(int) {
  if (ExecutionContext* context = interrupted_context) context->Cancel();
}

// While it lives, the first interrupt cancels the context.
class InterruptGuard {
 public:
  explicit InterruptGuard(ExecutionContext* context) {
    interrupted_context = context;
    struct sigaction action = {};
    action.sa_handler = &CancelContext;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &before_);
  }
  ~InterruptGuard() {
    sigaction(SIGINT, &before_, nullptr);
    interrupted_context = nullptr;
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction before_ = {};
};

}  // namespace

void RunInterruptible(const std::function<void(const ExecutionContext&)>& work) {
  ProgressLine line;
  ExecutionContext context([&](std::string_view phase, double fraction) { line.Show(phase, fraction); });
  const InterruptGuard guard(&context);
  work(context);
  if (context.Cancelled()) throw Interrupted();
}

}  // namespace penumbra
