// apps/report.h
//
// What a solve took and reached, for programs and for people.

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

// The text of REPORT.json; memory, threads and version are those of this process.
std::string ReportJson(const RunReport& report);

// What of it is the same on every run: no times, threads or memory, and not the options.
std::string LastingReportJson(const PipelineReport& report);
// The same read back. Throws nlohmann::json::exception.
PipelineReport PipelineReportFrom(const nlohmann::ordered_json& lasting);

// How well shaped the triangles are, as in REPORT.json, and in a line.
nlohmann::ordered_json TriangleQualityJson(const TriangleQuality& quality);
std::string TriangleQualityText(const TriangleQuality& quality);

// Phases with their seconds, counts, energy and error, a line each.
std::string ReportTable(const RunReport& report);

}  // namespace penumbra
