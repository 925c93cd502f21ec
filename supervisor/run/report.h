#pragma once

// Report of a run for people and scripts: the record, the runtime's last figures, and pictures of both.
//
// Pure functions over values.

#include <string>

#include "runtime/ground/result/result.h"
#include "runtime/host/messages.h"
#include "supervisor/run/run_record.h"

namespace stepwright::run {

struct Report {
  RunRecord record;
  host::RuntimeStatus runtime;  // after the last scan
};

// One JSON object: "record" as in to_json(RunRecord), "runtime" with the figures of the scan and the plant's
// truth.
std::string to_json(const Report& report);
[[nodiscard]] result::Result<Report> report_from_json(const std::string& text, const std::string& file);

// A table for the terminal: per action planned and actual start, duration, cost and level; replans; goal.
std::string report_table(const RunRecord& record);

// Gantt of all plans: planned above actual bars, a dashed line at each replan.
std::string gantt_svg(const RunRecord& record);
// Planned and actual cost summed up over the actions that were begun (the paper's Figures 15 and 16).
std::string cost_svg(const RunRecord& record);

}  // namespace stepwright::run
