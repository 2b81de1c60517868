// apps/report.h
//
// The report on a solve, which contains its cost and its accuracy, as JSON and as a table.

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

// The report as JSON text. Memory, number of threads and version are taken from the running program.
std::string ReportJson(const RunReport& report);

// The part of the report that is the same in every run with the same options. This part contains no times,
// threads, memory or options.
std::string LastingReportJson(const PipelineReport& report);
// Restores a report from the result of LastingReportJson(). Throws nlohmann::json::exception if the JSON does
// not have the expected form.
PipelineReport PipelineReportFrom(const nlohmann::ordered_json& lasting);

// The statistics of the triangles' shapes: TriangleQualityJson() gives them as in the JSON report,
// TriangleQualityText() as a line of text.
nlohmann::ordered_json TriangleQualityJson(const TriangleQuality& quality);
std::string TriangleQualityText(const TriangleQuality& quality);

// The report as a table: phases with their seconds, counts, energy and error.
std::string ReportTable(const RunReport& report);

}  // namespace penumbra
