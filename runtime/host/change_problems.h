#pragma once

// Diagnostics of a refused online change (runtime/doc/online_change.md), and the outlook on a change: a check
// of two programs and an image beforehand, without performing anything.
//
// Pure; service thread or any other.
//
//   const ChangeOutlook outlook = outlook_of(running, next, image);
//   if (outlook && !outlook->keep.empty()) ...      // R0033, R0034, R0036 as things are now

#include <cstddef>
#include <span>
#include <string>

#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"
#include "runtime/record/state_layout.h"
#include "runtime/record/variable_transfer.h"

namespace stepwright::host {

// R0033, R0036.
result::Diagnostic lost_step_problem(const std::string& step);
result::Diagnostic impossible_chart_problem(const std::string& chart);
// R0034 for every output that keeps its name and neither its terminal nor its size: both actuators would
// switch at once, in the middle of whatever they do.
result::Diagnostics moved_outputs(const record::StateLayout& from, const record::StateLayout& to);

struct ChangeOutlook {
  record::StateLayout from;
  record::StateLayout to;
  record::TransferReport transfer;
  // Problems that refuse the change, by its mode. The runtime decides by the image of that scan.
  result::Diagnostics keep;            // DownloadMode::Change
  result::Diagnostics restart_charts;  // DownloadMode::ChangeRestartCharts
};

// `image` of the running program; empty if there is none: then nothing is said of active steps. Fails with
// R0021 (record::StateLayout).
[[nodiscard]] result::Result<ChangeOutlook> outlook_of(const bytecode::Program& running,
                                                       const bytecode::Program& next,
                                                       std::span<const std::byte> image);

}  // namespace stepwright::host
