// Hierarchical radiosity by every oracle, with and without multigridding, and the dense solver: links and
// seconds against the error of the light that exact probes find.

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"

namespace penumbra {
namespace {

constexpr double kCompareAt = 0.03;  // the root mean square error at which methods are compared

// Dense systems stop growing where the next, with sixteen times the pairs, would take longer than this.
constexpr double kMostSeconds = 60;
constexpr double kGrowth = 16;

struct Curve {
  std::vector<double> error, seconds, size;  // size: links, or the elements of dense systems
};

struct OracleMethod {
  const char* name;
  const char* oracle;
  bool multigrid;
};
constexpr OracleMethod kOracleMethods[] = {
    {"transport", "transport", false},   {"transport, multigrid", "transport", true},
    {"visibility", "visibility", false}, {"gradient", "gradient", false},
    {"thesis", "thesis", false},         {"thesis, multigrid", "thesis", true},
};

StudyRow SolveLinks(const ReferenceCase& test, const PipelineOptions& options, int repeats) {
  StudyRow row;
  row.scene = test.name;
  std::unique_ptr<Pipeline> pipeline;
  row.seconds = MedianSeconds(repeats, [&] {
    pipeline = std::make_unique<Pipeline>(test.scene, options);
    pipeline->Solve({});
  });
  row.elements = pipeline->solution().forest.size();
  row.links = pipeline->solution().links.links.size();
  SetErrors(
      ReferenceErrors(
          test, [&](const ReceiverPoint& at) { return pipeline->irradiance().Anywhere(at).irradiance; }),
      &row);
  return row;
}

// y at the error that methods are compared at, on the line between the two settings about it; nothing if they
// all stay above.
std::optional<double> At(const std::vector<double>& error, const std::vector<double>& y) {
  for (std::size_t i = 1; i < error.size(); ++i) {
    if (error[i] > kCompareAt || error[i - 1] <= kCompareAt) continue;
    const double t = std::log(error[i - 1] / kCompareAt) / std::log(error[i - 1] / error[i]);
    return y[i - 1] * std::pow(y[i] / y[i - 1], t);
  }
  return std::nullopt;
}

Curve RunOracle(StudyLog& log, const ReferenceCase& test, const OracleMethod& method) {
  Curve curve;
  for (const double error :
       log.quick() ? std::vector<double>{0.2, 0.1} : std::vector<double>{0.4, 0.2, 0.1, 0.05, 0.02, 0.01}) {
    PipelineOptions options;
    options.error = error;
    options.refine = RefineBy::kTransport;
    options.max_corrections = 0;
    options.oracle = method.oracle;
    options.multigrid = method.multigrid;
    StudyRow row = SolveLinks(test, options, log.quick() ? 1 : 3);
    row.method = method.name;
    row.setting = fmt::format("error {:g}", error);
    row.parameter = error;
    curve.error.push_back(row.error_rms);
    curve.size.push_back(static_cast<double>(*row.links));
    curve.seconds.push_back(row.seconds);
    log.Add(std::move(row));
  }
  return curve;
}

Curve RunDense(StudyLog& log, const ReferenceCase& test, BasisDegree degree, const char* name) {
  Curve curve;
  for (const int divisions : log.quick() ? std::vector<int>{1, 2} : std::vector<int>{1, 2, 4, 8}) {
    PipelineOptions options;
    options.solver = "dense";
    options.dense = {.degree = degree, .divisions = divisions};
    options.refine = RefineBy::kTransport;
    StudyRow row = SolveLinks(test, options, 1);
    row.links.reset();
    row.method = name;
    row.setting = fmt::format("divisions {}", divisions);
    row.parameter = divisions;
    curve.error.push_back(row.error_rms);
    curve.size.push_back(static_cast<double>(*row.elements));
    curve.seconds.push_back(row.seconds);
    log.Add(std::move(row));
    if (curve.seconds.back() * kGrowth > kMostSeconds) break;
  }
  return curve;
}

std::string Compared(const std::string& scene, const char* method, const Curve& curve, const Curve& first) {
  std::string sentence =
      fmt::format("{}, {}: the rms error falls from {:.2g} to {:.2g} as size^{:.2f}", scene, method,
                  curve.error.front(), curve.error.back(), LogSlope(curve.size, curve.error));
  const std::optional<double> size = At(curve.error, curve.size), seconds = At(curve.error, curve.seconds);
  const std::optional<double> others = At(first.error, first.seconds);
  if (!size)
    sentence += fmt::format("; it does not pass {:g}.", kCompareAt);
  else
    sentence +=
        fmt::format("; {:g} takes {:.0f} and {:.2g} s", kCompareAt, *size, *seconds) +
        (others ? fmt::format(", {:.2f} times that of {}.", *seconds / *others, kOracleMethods[0].name)
                : ".");
  return sentence;
}

void StudyHierarchical(StudyLog& log) {
  std::vector<std::string> names = {"floating-cube", "cornell", "box_grey"};
  if (log.quick()) names.resize(1);
  for (const std::string& name : names) {
    const ReferenceCase test = LoadReferenceCase(name);
    Curve first;
    for (const OracleMethod& method : kOracleMethods) {
      const Curve curve = RunOracle(log, test, method);
      if (first.error.empty()) first = curve;
      if (!log.quick()) log.Find(Compared(name, method.name, curve, first));
    }
    const Curve dense = RunDense(log, test, BasisDegree::kConstant, "dense, constant");
    if (!log.quick()) log.Find(Compared(name, "dense, constant", dense, first));
  }
}

}  // namespace

extern const Study kHierarchicalStudy;
const Study kHierarchicalStudy = {
    "hierarchical",
    "Hierarchical radiosity by oracle, and the dense solver, without corrections: the error of exact probes "
    "at "
    "the points of path-traced references, beyond two of their standard errors",
    "Transport error weighted by brightness and area reaches an error with fewer links than the thesis's "
    "oracle "
    "as printed (4.4.1), and with far less work than all pairs (Hanrahan, Salzman and Aupperle 1991); "
    "multigridding saves iterations.",
    "links",
    "error_rms",
    StudyHierarchical};

}  // namespace penumbra
