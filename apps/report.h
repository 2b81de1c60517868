// apps/report.h
//
// The report of a solve: its cost and its accuracy, as JSON and as a table.

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

// The report as JSON text. Memory, threads and version are those of the running program.
std::string ReportJson(const RunReport& report);

// The part of the report that is the same in every run: no times, threads or memory, and no options.
std::string LastingReportJson(const PipelineReport& report);
// Reads what LastingReportJson() wrote. Throws nlohmann::json::exception.
PipelineReport PipelineReportFrom(const nlohmann::ordered_json& lasting);

// The shapes of the triangles, as in the JSON report, and as a line of text.
nlohmann::ordered_json TriangleQualityJson(const TriangleQuality& quality);
std::string TriangleQualityText(const TriangleQuality& quality);

// The report as a table: phases with their seconds, counts, energy and error.
std::string ReportTable(const RunReport& report);

}  // namespace penumbra
