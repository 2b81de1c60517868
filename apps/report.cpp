#include "apps/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdint>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t PeakMemoryBytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t{1024} * static_cast<std::uint64_t>(usage.ru_maxrss);  // Linux counts kilobytes
}

Json PhasesJson(const RunReport& report) {
  Json phases = Json::array({{{"name", "load"}, {"seconds", report.load_seconds}}});
  for (const Phase& phase : report.pipeline.phases)
    phases.push_back({{"name", phase.name}, {"seconds", phase.seconds}});
  return phases;
}

Json CountsJson(const PipelineReport::Counts& counts) {
  return {{"patches", counts.patches},
          {"emitters", counts.emitters},
          {"elements", counts.elements},
          {"leaves", counts.leaves},
          {"links", counts.links},
          {"links_visible", counts.links_visible},
          {"links_partial", counts.links_partial},
          {"discontinuities", counts.discontinuities},
          {"dsets_active", counts.dsets_active},
          {"most_merged", counts.most_merged},
          {"triangles", counts.triangles},
          {"interpolants", counts.interpolants},
          {"point_evaluations", counts.point_evaluations}};
}

Json IterationsJson(const std::vector<IterationReport>& reports) {
  Json iterations = Json::array();
  for (const IterationReport& i : reports)
    iterations.push_back({{"residual", i.residual},
                          {"elements", i.elements},
                          {"links", i.links},
                          {"sweeps", i.sweeps},
                          {"links_split", i.links_split},
                          {"seconds", i.seconds}});
  return iterations;
}

Json ErrorJson(const PipelineReport& report) {
  const RepresentationError& error = report.interpolant_error;
  return {{"interpolant",
           {{"points", error.points},
            {"max", error.max},
            {"p99", error.p99},
            {"p95", error.p95},
            {"rms", error.rms}}},
          {"solution", {{"estimate", report.solution_error_estimate}}},
          {"asked", report.error_asked},
          {"met", report.error_met}};
}

}  // namespace

std::string ReportJson(const RunReport& report) {
  const PipelineReport& pipeline = report.pipeline;
  const Json json = {{"version", PENUMBRA_VERSION},
                     {"threads", ThreadCount()},
                     {"options", report.options},
                     {"phases", PhasesJson(report)},
                     {"counts", CountsJson(pipeline.counts)},
                     {"iterations", IterationsJson(pipeline.iterations)},
                     {"energy",
                      {{"emitted", pipeline.energy.emitted},
                       {"absorbed", pipeline.energy.absorbed},
                       {"escaped", pipeline.energy.escaped},
                       {"relative_imbalance", pipeline.energy.relative_imbalance}}},
                     {"error", ErrorJson(pipeline)},
                     {"memory_peak_bytes", PeakMemoryBytes()},
                     {"unmet", pipeline.unmet}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ReportTable(const RunReport& report) {
  const PipelineReport& pipeline = report.pipeline;
  std::string table = "Phase                seconds\n";
  double total = report.load_seconds;
  const auto add_phase = [&](const std::string& name, double seconds) {
    table += fmt::format("   {:<15} {:>9.3f}\n", name, seconds);
  };
  add_phase("load", report.load_seconds);
  for (const Phase& phase : pipeline.phases) {
    add_phase(phase.name, phase.seconds);
    total += phase.seconds;
  }
  add_phase("total", total);

  const PipelineReport::Counts& counts = pipeline.counts;
  table += fmt::format(
      "Counts\n   {} patches, {} emitters; {} elements, {} leaves; {} links, {} of them partly blocked\n"
      "   {} discontinuities, {} DSets active; {} triangles, {} point evaluations\n",
      counts.patches, counts.emitters, counts.elements, counts.leaves, counts.links, counts.links_partial,
      counts.discontinuities, counts.dsets_active, counts.triangles, counts.point_evaluations);

  const EnergyBalance& energy = pipeline.energy;
  table += fmt::format("Energy [W]\n   emitted {:.6g}, absorbed {:.6g}, escaped {:.6g}; imbalance {:.2g}\n",
                       energy.emitted, energy.absorbed, energy.escaped, energy.relative_imbalance);

  const RepresentationError& error = pipeline.interpolant_error;
  table += "Relative error\n";
  if (error.points > 0)
    table += fmt::format("   interpolants, at {} points: p99 {:.3g}, p95 {:.3g}, rms {:.3g}, max {:.3g}\n",
                         error.points, error.p99, error.p95, error.rms, error.max);
  table += fmt::format("   solution, estimated: {:.3g}\n", pipeline.solution_error_estimate);
  table +=
      fmt::format("   asked for {:.3g}: {}\n", pipeline.error_asked, pipeline.error_met ? "met" : "not met");
  for (const std::string& line : pipeline.unmet) table += fmt::format("   {}\n", line);
  return table;
}

}  // namespace penumbra
