// apps/report.h
//
// The report on a solve as JSON and as a table; the report contains the cost and the accuracy of the solve.

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mesh/pipeline/pipeline.h"

namespace penumbra {

struct RunReport {
  nlohmann::ordered_json options;
  double load_seconds = 0;
  PipelineReport pipeline;
};

// The report on a solve as JSON text. In the report, memory use, number of threads and version are those of
// the running program.
std::string ReportJson(const RunReport& report);

// The part of the report, as JSON, that is the same in every run with the same options. The result of
// LastingReportJson() contains no times, threads, memory use or options.
std::string LastingReportJson(const PipelineReport& report);
// Restores a report from the result of LastingReportJson(). Throws nlohmann::json::exception if the JSON
// `lasting` does not have the expected form.
PipelineReport PipelineReportFrom(const nlohmann::ordered_json& lasting);

// The statistics of the shapes of the mesh's triangles: TriangleQualityJson() returns the statistics as in
// the JSON report, TriangleQualityText() as a line of text.
nlohmann::ordered_json TriangleQualityJson(const TriangleQuality& quality);
std::string TriangleQualityText(const TriangleQuality& quality);

// The report on a solve as a table: the phases with their durations in seconds, counts, energy and error.
std::string ReportTable(const RunReport& report);

}  // namespace penumbra
