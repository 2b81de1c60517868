#include "solver/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

namespace penumbra {
namespace {

// The first byte that the child sends.
constexpr char kReturnedMark = 'r', kThrewMark = 't';

void WriteAll(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(EXIT_FAILURE);
    done += static_cast<std::size_t>(written);
  }
}

[[noreturn]] void WorkInChild(const std::function<std::string()>& work, pid_t parent, int out) {
  // The child dies with its parent, and by the signals that the parent may handle otherwise.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  for (const int number : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE})
    signal(number, SIG_DFL);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (nowhere >= 0) dup2(nowhere, stream);
  std::string bytes;
  try {
    bytes = kReturnedMark + work();
  } catch (const std::exception& error) {
    bytes = kThrewMark + std::string(error.what());
  }
  WriteAll(out, bytes);
  _exit(EXIT_SUCCESS);
}

// Appends what arrives until the end; false if the time is over before.
bool ReadAll(int file, double most_seconds, std::string& bytes) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(most_seconds);
  std::array<char, 1 << 16> part{};
  while (true) {
    const std::chrono::duration<double, std::milli> left = end - Clock::now();
    if (left.count() <= 0) return false;
    pollfd waiting = {file, POLLIN, 0};
    constexpr double kLongestWait = 1000;  // [ms]: far below what an int holds
    const int ready = poll(&waiting, 1, static_cast<int>(std::min(left.count(), kLongestWait)) + 1);
    if (ready <= 0) continue;
    const ssize_t size = read(file, part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return true;
    bytes.append(part.data(), static_cast<std::size_t>(size));
  }
}

}  // namespace

ChildResult RunInChild(const std::function<std::string()>& work, double most_seconds) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("the system gives no pipe");
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw std::runtime_error("the system gives no process");
  }
  if (child == 0) WorkInChild(work, parent, ends[1]);
  close(ends[1]);
  ChildResult result;
  const bool in_time = ReadAll(ends[0], most_seconds, result.bytes);
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const bool ended = in_time && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
  if (ended && !result.bytes.empty()) {
    result.end = result.bytes[0] == kReturnedMark ? ChildResult::End::kReturned : ChildResult::End::kThrew;
    result.bytes.erase(0, 1);
    return result;
  }
  result.end = in_time ? ChildResult::End::kDied : ChildResult::End::kTookTooLong;
  result.bytes.clear();
  return result;
}

}  // namespace penumbra
