#include "tests/fuzz/fuzz_loop.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

// Of the address sanitizer, where there is one.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

// What asks for too much memory gets none, as without a sanitizer.
// NOLINTNEXTLINE: the name is the address sanitizer's.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }

// The HDF5 library itself loses a few bytes where it fails to open a damaged file.
// NOLINTNEXTLINE: the name is the leak sanitizer's.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

namespace penumbra::fuzz {
namespace {

std::atomic<std::uint64_t> running{0};

// Tells the run without calling anything that a signal may have interrupted.
void TellRun() {
  char digits[24] = {};
  std::size_t at = sizeof(digits);
  for (std::uint64_t rest = running; at > 1; rest /= 10) {
    digits[--at] = static_cast<char>('0' + rest % 10);
    if (rest < 10) break;
  }
  constexpr std::string_view kWords = "\nfailed in run ";
  [[maybe_unused]] ssize_t ignored = write(2, kWords.data(), kWords.size());
  ignored = write(2, digits + at, sizeof(digits) - at);
  ignored = write(2, "\n", 1);
}

void OnSignal(int signal) {
  TellRun();
  ::signal(signal, SIG_DFL);
  raise(signal);
}

std::uint64_t Argument(int argc, char** argv, int i, std::uint64_t otherwise) {
  return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
}

// Where a random line of the text begins and ends, its end included.
std::pair<std::size_t, std::size_t> RandomLine(const std::string& text, Random& random) {
  if (text.empty()) return {0, 0};
  const std::size_t at = random.Index(static_cast<std::uint32_t>(text.size()));
  const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == text.npos ? 0 : before + 1;
  return {begin, std::min(text.find('\n', at), text.size() - 1) + 1};
}

std::size_t RandomPlace(const std::string& text, Random& random) {
  return random.Index(static_cast<std::uint32_t>(text.size() + 1));
}

// The next word at or after a random place: [begin, end).
std::pair<std::size_t, std::size_t> RandomWord(const std::string& text, Random& random) {
  constexpr const char* kBetween = " \t\r\n/,";
  const std::size_t begin = text.find_first_not_of(kBetween, RandomPlace(text, random));
  if (begin == text.npos) return {text.size(), text.size()};
  return {begin, std::min(text.find_first_of(kBetween, begin), text.size())};
}

void ChangeOnce(std::string& text, std::span<const std::string_view> dictionary, Random& random) {
  const auto [line, line_end] = RandomLine(text, random);
  const auto [word, word_end] = RandomWord(text, random);
  const std::size_t place = RandomPlace(text, random);
  switch (random.Index(12)) {
    case 0:
      if (place < text.size()) text[place] = static_cast<char>(random.Index(256));
      break;
    case 1:
      text.insert(place, 1, static_cast<char>(random.Index(256)));
      break;
    case 2:
      text.erase(place, random.Index(20));
      break;
    case 3:
    case 4:
      text.insert(place, Pick(dictionary, random));
      break;
    case 5:
    case 6:
      text.replace(word, word_end - word, NumberText(random));
      break;
    case 7:
      text.replace(word, word_end - word, Pick(dictionary, random));
      break;
    case 8:
      text.erase(line, line_end - line);
      break;
    case 9:
      text.insert(line, text.substr(line, line_end - line));
      break;
    case 10: {
      const std::string moved = text.substr(line, line_end - line);
      text.erase(line, line_end - line);
      text.insert(RandomPlace(text, random), moved);
      break;
    }
    default:
      if (random.Index(4) == 0) text.resize(place);
      break;
  }
}

// Ends the program by SIGPROF when its threads have together worked for this time from now; 0: never. Seconds
// of a clock would end runs on a busy machine. A program that waits for ever does not work: SIGALRM ends it
// after a longer time.
void LimitTime(unsigned seconds) {
  constexpr unsigned kWaiting = 20;  // seconds of a clock to one of work
  itimerval limit{};
  limit.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &limit, nullptr);
  alarm(kWaiting * seconds);
}

}  // namespace

int Loop(int argc, char** argv, std::uint64_t runs, const std::function<void(Random&)>& run) {
  runs = Argument(argc, argv, 1, runs);
  const std::uint64_t seed = Argument(argc, argv, 2, 1), first = Argument(argc, argv, 3, 0);
  constexpr std::uint64_t kTold = 100'000;  // runs between two words
  for (const int fatal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGALRM, SIGPROF})
    signal(fatal, &OnSignal);
  if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(&TellRun);
  std::printf("seed %llu, %llu runs from %llu\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(runs), static_cast<unsigned long long>(first));
  for (std::uint64_t i = first; i < first + runs; ++i) {
    running = i;
    LimitTime(kLongestRun);
    if (i > first && i % kTold == 0) {
      std::printf("run %llu\n", static_cast<unsigned long long>(i));
      std::fflush(stdout);
    }
    Random random(seed, i);
    run(random);
  }
  LimitTime(0);
  std::printf("%llu runs: no crash, no hang, no NaN\n", static_cast<unsigned long long>(runs));
  return 0;
}

void Fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

namespace {

// Numbers on which readers stumble.
constexpr std::string_view kOdd[] = {"0",
                                     "-0",
                                     "1",
                                     "-1",
                                     "2",
                                     "3",
                                     "4",
                                     "1e36",
                                     "-1e36",
                                     "1e37",
                                     "1e-36",
                                     "1e-37",
                                     "1e-160",
                                     "1e-308",
                                     "4.9e-324",
                                     "1e308",
                                     "1e309",
                                     "1e-400",
                                     "nan",
                                     "-nan",
                                     "inf",
                                     "-inf",
                                     "0x1p3",
                                     "1.#QNAN",
                                     "1,5",
                                     "1.",
                                     ".5",
                                     "+1",
                                     "+-1",
                                     "--1",
                                     "1e",
                                     "1e+",
                                     "1e9999",
                                     "9999999",
                                     "0.1f",
                                     "1d0",
                                     "2147483647",
                                     "2147483648",
                                     "-2147483649",
                                     "4294967296",
                                     "9223372036854775807",
                                     "-9223372036854775808",
                                     "18446744073709551616",
                                     "0.99999999999999999"};

}  // namespace

std::string NumberText(Random& random) {
  switch (random.Index(4)) {
    case 0:
      return std::string(Pick(kOdd, random));
    case 1:
      return std::to_string(static_cast<int>(random.Index(12)) - 4);
    case 2: {
      // As the grids that people model on, where things coincide.
      const double steps[] = {0.5, 0.1, 1e-6, 1e-12};
      return std::to_string(static_cast<int>(random.Index(5)) - 1) + "." +
             std::to_string(static_cast<int>(Pick(steps, random) * 1e6) * static_cast<int>(random.Index(3)));
    }
    default: {
      char text[40];
      std::snprintf(text, sizeof(text), "%.*g", static_cast<int>(random.Index(18)), random.Uniform(-2, 2));
      return text;
    }
  }
}

std::string Mutated(std::string text, std::span<const std::string_view> dictionary, Random& random) {
  constexpr std::uint32_t kMostChanges = 8;
  for (std::uint32_t changes = 1 + random.Index(kMostChanges); changes > 0; --changes)
    ChangeOnce(text, dictionary, random);
  return text;
}

void CheckMessage(std::string_view message, std::string_view file) {
  constexpr std::size_t kLongest = 1000;  // [bytes]
  const bool plain = std::none_of(message.begin(), message.end(),
                                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7f'; });
  if (!plain || message.size() > kLongest || !message.starts_with(file))
    Fail("a message is not one plain line of " + std::string(file) + ": " + std::string(message));
}

}  // namespace penumbra::fuzz
