#include "apps/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "solver/base/check.h"
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
  std::vector<Phase> phases = {{"load", report.load_seconds}};
  // Those that had nothing to do are told, too.
  for (const char* name : {"link", "iterate", "discontinuities", "triangulate", "interpolate"})
    phases.push_back({name, 0});
  for (const Phase& phase : report.pipeline.phases) {
    const auto same =
        std::find_if(phases.begin(), phases.end(), [&](const Phase& p) { return p.name == phase.name; });
    PENUMBRA_CHECK(same != phases.end());
    same->seconds += phase.seconds;
  }
  Json json = Json::array();
  for (const Phase& phase : phases) json.push_back({{"name", phase.name}, {"seconds", phase.seconds}});
  return json;
}

using Counts = PipelineReport::Counts;

const std::vector<std::pair<const char*, std::size_t Counts::*>>& CountNames() {
  static const std::vector<std::pair<const char*, std::size_t Counts::*>> names = {
      {"patches", &Counts::patches},
      {"emitters", &Counts::emitters},
      {"elements", &Counts::elements},
      {"leaves", &Counts::leaves},
      {"links", &Counts::links},
      {"links_visible", &Counts::links_visible},
      {"links_partial", &Counts::links_partial},
      {"discontinuities", &Counts::discontinuities},
      {"dsets_active", &Counts::dsets_active},
      {"most_merged", &Counts::most_merged},
      {"triangles", &Counts::triangles},
      {"interpolants", &Counts::interpolants},
      {"point_evaluations", &Counts::point_evaluations},
      {"sources_renewed", &Counts::sources_renewed}};
  return names;
}

Json CountsJson(const Counts& counts) {
  Json json;
  for (const auto& [name, count] : CountNames()) json[name] = counts.*count;
  return json;
}

Json IterationsJson(const std::vector<IterationReport>& reports) {
  Json iterations = Json::array();
  for (const IterationReport& i : reports)
    iterations.push_back({{"residual", i.residual},
                          {"eps", i.eps},
                          {"elements", i.elements},
                          {"links", i.links},
                          {"sweeps", i.sweeps},
                          {"links_split", i.links_split},
                          {"seconds", i.seconds}});
  return iterations;
}

Json RgbJson(const Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

Json DiagnosticsJson(const PipelineReport& report) {
  const LinkDiagnostics& links = report.links;
  Json bounces = Json::array();
  for (const Rgb& bounce : report.bounces) bounces.push_back(RgbJson(bounce));
  Json json = {{"closure",
                {{"min", links.closure_min},
                 {"max", links.closure_max},
                 {"mean", links.closure_mean},
                 {"covered_area", links.covered_area}}},
               {"reciprocity",
                {{"link_pairs", links.link_pairs},
                 {"link_worst", links.link_reciprocity},
                 {"patch_pairs", links.patch_pairs},
                 {"patch_worst", links.patch_reciprocity}}},
               {"open", {{"rays", report.views.rays}, {"escaping", report.views.escaping}}},
               {"reversed_faces", report.views.reversed_faces},
               {"triangles", TriangleQualityJson(report.quality)}};
  if (!bounces.empty()) json["bounces"] = bounces;
  return json;
}

Json PartErrorsJson(const PipelineReport& report) {
  Json parts = Json::array();
  for (const PartError& part : report.part_errors)
    parts.push_back({{"name", part.name}, {"p99", part.whole.p99}, {"points", part.whole.points}});
  return parts;
}

// The largest error that was seen, and where: the position, and the face there.
Json LargestErrorJson(const RepresentationError& whole) {
  if (whole.worst_face < 0) return nullptr;
  const Vec3& at = whole.worst_point;
  return {{"value", whole.max}, {"position", {at.x(), at.y(), at.z()}}, {"patch", whole.worst_face}};
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
          {"whole",
           {{"points", report.whole_error.points},
            {"max", report.whole_error.max},
            {"p99", report.whole_error.p99},
            {"p95", report.whole_error.p95},
            {"rms", report.whole_error.rms}}},
          {"by_object", PartErrorsJson(report)},
          {"largest", LargestErrorJson(report.whole_error)},
          {"asked", report.error_asked},
          {"met", report.error_met}};
}

Json OutcomeJson(const PipelineReport& report) {
  const InteractionCounts& interactions = report.interactions;
  return {
      {"counts", CountsJson(report.counts)},
      {"interactions",
       {{"smooth", interactions.smooth}, {"sharp", interactions.sharp}, {"sampled", interactions.sampled}}},
      {"iterations", IterationsJson(report.iterations)},
      {"energy",
       {{"emitted", report.energy.emitted},
        {"absorbed", report.energy.absorbed},
        {"escaped", report.energy.escaped},
        {"relative_imbalance", report.energy.relative_imbalance}}},
      {"error", ErrorJson(report)},
      {"unmet", report.unmet}};
}

// The parts that err most, and the largest error; empty where nothing was measured.
std::string PartErrorTable(const PipelineReport& report) {
  constexpr std::size_t kListed = 5;
  std::string table;
  std::vector<PartError> parts = report.part_errors;
  std::stable_sort(parts.begin(), parts.end(),
                   [](const PartError& a, const PartError& b) { return a.whole.p99 > b.whole.p99; });
  for (std::size_t i = 0; i < std::min(kListed, parts.size()) && parts.size() > 1; ++i)
    table += fmt::format("   {}: p99 {:.3g} at {} points\n", parts[i].name, parts[i].whole.p99,
                         parts[i].whole.points);
  if (parts.size() > kListed) table += fmt::format("   and {} parts that err less\n", parts.size() - kListed);
  const RepresentationError& whole = report.whole_error;
  if (whole.worst_face >= 0)
    table +=
        fmt::format("   the largest: {:.3g} on face {} at ({:.4g}, {:.4g}, {:.4g})\n", whole.max,
                    whole.worst_face, whole.worst_point.x(), whole.worst_point.y(), whole.worst_point.z());
  return table;
}

std::string Dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

Json TriangleQualityJson(const TriangleQuality& quality) {
  return {{"smallest_angle", quality.smallest_angle},
          {"median_angle", quality.median_angle},
          {"below_5_degrees", quality.below_5_degrees},
          {"slim_area", quality.slim_area},
          {"angle_share", quality.angle_share},
          {"median_aspect", quality.median_aspect},
          {"aspect_p95", quality.aspect_p95}};
}

std::string TriangleQualityText(const TriangleQuality& quality) {
  return fmt::format(
      "{:.3g} % of the triangles have an angle below 5 degrees, on {:.2g} % of the area; median angle {:.3g} "
      "degrees, aspect {:.3g}",
      100 * quality.below_5_degrees, 100 * quality.slim_area, quality.median_angle, quality.median_aspect);
}

std::string ReportJson(const RunReport& report) {
  Json json = {{"version", PENUMBRA_VERSION},
               {"threads", ThreadCount()},
               {"options", report.options},
               {"phases", PhasesJson(report)}};
  json.update(OutcomeJson(report.pipeline));
  json["diagnostics"] = DiagnosticsJson(report.pipeline);
  if (const auto& dense = report.pipeline.dense)
    json["dense"] = {{"unknowns", dense->unknowns},
                     {"least_row_sum", dense->closure.least_row_sum},
                     {"largest_row_sum", dense->closure.largest_row_sum},
                     {"reciprocity_residual", dense->closure.reciprocity},
                     {"form_factor_error", dense->form_factor_error}};
  json["memory_peak_bytes"] = PeakMemoryBytes();
  return Dump(json);
}

std::string LastingReportJson(const PipelineReport& report) {
  Json json = OutcomeJson(report);
  for (Json& iteration : json["iterations"]) iteration.erase("seconds");
  return Dump(json);
}

PipelineReport PipelineReportFrom(const Json& lasting) {
  PipelineReport report;
  const Json& counts = lasting.at("counts");
  for (const auto& [name, count] : CountNames()) counts.at(name).get_to(report.counts.*count);
  if (const auto interactions = lasting.find("interactions"); interactions != lasting.end()) {
    interactions->at("smooth").get_to(report.interactions.smooth);
    interactions->at("sharp").get_to(report.interactions.sharp);
    interactions->at("sampled").get_to(report.interactions.sampled);
  } else {  // of an older file
    report.interactions = {report.counts.links_visible, report.counts.links_partial, 0};
  }
  for (const Json& from : lasting.at("iterations")) {
    IterationReport& iteration = report.iterations.emplace_back();
    from.at("residual").get_to(iteration.residual);
    from.at("elements").get_to(iteration.elements);
    from.at("links").get_to(iteration.links);
    from.at("sweeps").get_to(iteration.sweeps);
    from.at("links_split").get_to(iteration.links_split);
    iteration.eps = from.value("eps", 0.0);
  }
  const Json& energy = lasting.at("energy");
  energy.at("emitted").get_to(report.energy.emitted);
  energy.at("absorbed").get_to(report.energy.absorbed);
  energy.at("escaped").get_to(report.energy.escaped);
  energy.at("relative_imbalance").get_to(report.energy.relative_imbalance);
  const Json &error = lasting.at("error"), &interpolant = error.at("interpolant");
  interpolant.at("points").get_to(report.interpolant_error.points);
  interpolant.at("max").get_to(report.interpolant_error.max);
  interpolant.at("p99").get_to(report.interpolant_error.p99);
  interpolant.at("p95").get_to(report.interpolant_error.p95);
  interpolant.at("rms").get_to(report.interpolant_error.rms);
  error.at("solution").at("estimate").get_to(report.solution_error_estimate);
  const Json& whole = error.at("whole");
  whole.at("points").get_to(report.whole_error.points);
  whole.at("max").get_to(report.whole_error.max);
  whole.at("p99").get_to(report.whole_error.p99);
  whole.at("p95").get_to(report.whole_error.p95);
  whole.at("rms").get_to(report.whole_error.rms);
  for (const Json& from : error.at("by_object")) {
    PartError& part = report.part_errors.emplace_back();
    from.at("name").get_to(part.name);
    from.at("p99").get_to(part.whole.p99);
    from.at("points").get_to(part.whole.points);
  }
  if (const Json& largest = error.at("largest"); !largest.is_null()) {
    for (int axis = 0; axis < 3; ++axis)
      largest.at("position").at(static_cast<std::size_t>(axis)).get_to(report.whole_error.worst_point[axis]);
    largest.at("patch").get_to(report.whole_error.worst_face);
  }
  error.at("asked").get_to(report.error_asked);
  error.at("met").get_to(report.error_met);
  lasting.at("unmet").get_to(report.unmet);
  return report;
}

namespace {

std::string PhaseTable(const RunReport& report) {
  std::string table = "Phase                seconds\n";
  double total = report.load_seconds;
  const auto add_phase = [&](const std::string& name, double seconds) {
    table += fmt::format("   {:<15} {:>9.3f}\n", name, seconds);
  };
  add_phase("load", report.load_seconds);
  for (const Phase& phase : report.pipeline.phases) {
    add_phase(phase.name, phase.seconds);
    total += phase.seconds;
  }
  add_phase("total", total);
  return table;
}

std::string CountTable(const PipelineReport& pipeline) {
  const PipelineReport::Counts& counts = pipeline.counts;
  std::string table = fmt::format(
      "Counts\n   {} patches, {} emitters; {} elements, {} leaves; {} links, {} of them partly blocked\n"
      "   {} discontinuities, {} DSets active; {} triangles, {} point evaluations\n",
      counts.patches, counts.emitters, counts.elements, counts.leaves, counts.links, counts.links_partial,
      counts.discontinuities, counts.dsets_active, counts.triangles, counts.point_evaluations);
  if (pipeline.quality.median_aspect > 0)  // measured
    table += fmt::format("   {}\n", TriangleQualityText(pipeline.quality));
  if (const auto& dense = pipeline.dense)
    table += fmt::format(
        "Dense system\n   {} unknowns; rows add up to {:.12g} ... {:.12g}, form factors within {:.2g}, "
        "reciprocity within {:.2g}\n",
        dense->unknowns, dense->closure.least_row_sum, dense->closure.largest_row_sum,
        dense->form_factor_error, dense->closure.reciprocity);
  return table;
}

// Where the light goes: energy, form factors, iterations, bounces.
std::string LightTable(const PipelineReport& pipeline) {
  const EnergyBalance& energy = pipeline.energy;
  std::string table =
      fmt::format("Energy [W]\n   emitted {:.6g}, absorbed {:.6g}, escaped {:.6g}; imbalance {:.2g}\n",
                  energy.emitted, energy.absorbed, energy.escaped, energy.relative_imbalance);

  const LinkDiagnostics& links = pipeline.links;
  table += fmt::format(
      "Form factors\n   sums of patches per free area {:.6g} to {:.6g}, mean {:.6g}; {:.6g} m^2 are covered\n"
      "   reciprocity of {} patch pairs: worst {:.2g}\n"
      "   {:.3g} % of what surfaces send out evenly leaves the scene; {} faces see nothing but backs\n",
      links.closure_min, links.closure_max, links.closure_mean, links.covered_area, links.patch_pairs,
      links.patch_reciprocity, 100 * pipeline.views.escaping, pipeline.views.reversed_faces.size());
  if (!pipeline.iterations.empty()) {
    table += "Iterations\n";
    for (const IterationReport& i : pipeline.iterations)
      table +=
          fmt::format("   eps {:<9.3g} {:>9} elements {:>9} links {:>4} sweeps  residual {:<9.2g} {:.3f} s\n",
                      i.eps, i.elements, i.links, i.sweeps, i.residual, i.seconds);
  }
  if (!pipeline.bounces.empty()) {
    table += "Mean irradiance by bounce [W/m^2]\n";
    for (std::size_t k = 0; k < pipeline.bounces.size(); ++k)
      table += fmt::format("   {:>4} {:>12.6g} {:>12.6g} {:>12.6g}\n", k + 1, pipeline.bounces[k][0],
                           pipeline.bounces[k][1], pipeline.bounces[k][2]);
  }
  return table;
}

std::string ErrorTable(const PipelineReport& pipeline) {
  const RepresentationError& error = pipeline.interpolant_error;
  std::string table = "Relative error\n";
  if (error.points > 0)
    table += fmt::format("   interpolants, at {} points: p99 {:.3g}, p95 {:.3g}, rms {:.3g}, max {:.3g}\n",
                         error.points, error.p99, error.p95, error.rms, error.max);
  const bool measured = pipeline.whole_error.points > 0;
  if (measured)
    table +=
        fmt::format("   solution, estimated: {:.3g}; both together: p99 {:.3g}, p95 {:.3g}\n",
                    pipeline.solution_error_estimate, pipeline.whole_error.p99, pipeline.whole_error.p95);
  table += PartErrorTable(pipeline);
  const char* outcome = pipeline.error_met ? "met" : measured ? "not met" : "not measured";
  table += fmt::format("   asked for {:.3g}: {}\n", pipeline.error_asked, outcome);
  for (const std::string& line : pipeline.unmet) table += fmt::format("   {}\n", line);
  return table;
}

}  // namespace

std::string ReportTable(const RunReport& report) {
  return PhaseTable(report) + CountTable(report.pipeline) + LightTable(report.pipeline) +
         ErrorTable(report.pipeline);
}

}  // namespace penumbra
