#include "experiments/studies/study.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>

#include <fmt/format.h>

#include "solver/base/check.h"
#include "solver/base/stopwatch.h"

namespace penumbra {

void StudyLog::Add(StudyRow row) {
  const std::string seconds = std::isnan(row.seconds) ? "" : fmt::format("{:.3g} s", row.seconds);
  fmt::print(stderr, "  {:<16} {:<22} {:<20} {:>12}  p99 {:<9.3g} max {:.3g}\n", row.scene, row.method,
             row.setting, seconds, row.error_p99, row.error_max);
  rows_.push_back(std::move(row));
}

void StudyLog::Find(std::string sentence) {
  fmt::print(stderr, "  => {}\n", sentence);
  findings_.push_back(std::move(sentence));
}

std::vector<ReferencePoint> ReadReference(const std::string& name) {
  const std::string path = "experiments/" + name;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("x,y,z,nx,ny,nz,Er,Eg,Eb,sr,sg,sb"))
    throw InputError(path + ":0: error: no reference is there; run from the root of the checkout");
  std::vector<ReferencePoint> points;
  while (std::getline(file, line)) {
    std::array<double, 12> value{};
    const char* at = line.data();
    for (double& v : value) {
      const auto [stop, error] = std::from_chars(at, line.data() + line.size(), v);
      if (error != std::errc()) throw InputError(path + ":0: error: not a number: " + line);
      at = stop + 1;
    }
    points.push_back({{value[0], value[1], value[2]},
                      {value[3], value[4], value[5]},
                      {value[6], value[7], value[8]},
                      {value[9], value[10], value[11]}});
  }
  return points;
}

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

namespace {

double MedianOf(int repeats, double (*clock)(), const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const double begin = clock();
    work();
    seconds.push_back(clock() - begin);
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

double WallSeconds() {
  static const Stopwatch since;
  return since.Seconds();
}

}  // namespace

double MedianSeconds(int repeats, const std::function<void()>& work) {
  return MedianOf(repeats, &WallSeconds, work);
}

double MedianProcessorSeconds(int repeats, const std::function<void()>& work) {
  return MedianOf(repeats, &ProcessorSeconds, work);
}

double SecondsPerCall(double at_least, const std::function<void()>& work) {
  const Stopwatch stopwatch;
  std::size_t calls = 0;
  do {
    work();
    ++calls;
  } while (stopwatch.Seconds() < at_least);
  return stopwatch.Seconds() / static_cast<double>(calls);
}

void SetErrors(std::vector<double> errors, StudyRow* row) {
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  const auto quantile = [&](double q) {
    return errors[static_cast<std::size_t>(std::ceil(q * static_cast<double>(errors.size()))) - 1];
  };
  double squares = 0;
  for (const double e : errors) squares += e * e;
  row->error_rms = std::sqrt(squares / static_cast<double>(errors.size()));
  row->error_p95 = quantile(0.95);
  row->error_p99 = quantile(0.99);
  row->error_max = errors.back();
}

void CopyErrors(const RepresentationError& errors, StudyRow* row) {
  row->error_rms = errors.rms;
  row->error_p95 = errors.p95;
  row->error_p99 = errors.p99;
  row->error_max = errors.max;
}

double LogSlope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0 && y[i] > 0)) continue;
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1;
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace penumbra
