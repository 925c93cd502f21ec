#include "runtime/host/change_problems.h"

#include <utility>

#include "runtime/host/change_codes.h"
#include "runtime/host/chart_carry.h"
#include "runtime/host/chart_situations.h"

namespace stepwright::host {
namespace {

constexpr const char* kPlace = "download";

bool is_output(const record::StateLayout& layout, const record::StateVariable& variable) {
  const record::StateAreas& areas = layout.areas();
  return (variable.flags & record::kStateLocated) != 0 && variable.address >= areas.inputs &&
         variable.address < areas.inputs + areas.outputs;
}

}  // namespace

result::Diagnostic lost_step_problem(const std::string& step) {
  return {kStepLost,
          result::Severity::Error,
          {kPlace, 0, 0},
          "the step " + step + " is active, and the new program has no such step",
          "wait until the chart has left it, or restart the charts (variables keep their values)"};
}

result::Diagnostic impossible_chart_problem(const std::string& chart) {
  return {kStepsUnfit,
          result::Severity::Error,
          {kPlace, 0, 0},
          "the steps of " + chart + " that are active now can never be active together in the new chart",
          "wait until the chart is elsewhere, or restart the charts (variables keep their values)"};
}

result::Diagnostics moved_outputs(const record::StateLayout& from, const record::StateLayout& to) {
  result::Diagnostics problems;
  for (const record::StateVariable& old : from.variables()) {
    const record::StateVariable* now = to.find(old.path);
    if (now == nullptr || !is_output(from, old) || !is_output(to, *now)) continue;
    const bool stays = old.address - from.areas().inputs == now->address - to.areas().inputs &&
                       old.bit == now->bit && from.type_of(old).size == to.type_of(*now).size;
    if (stays) continue;
    problems.push_back(
        {kOutputMoves,
         result::Severity::Error,
         {kPlace, 0, 0},
         "the output " + old.path + " would move to another address or size while it is driven",
         "give it another name, or replace the program (its outputs are safe then)"});
  }
  return problems;
}

result::Result<ChangeOutlook> outlook_of(const bytecode::Program& running, const bytecode::Program& next,
                                         std::span<const std::byte> image) {
  auto from = record::StateLayout::of(running);
  if (!from) return result::forward(from);
  auto to = record::StateLayout::of(next);
  if (!to) return result::forward(to);
  ChangeOutlook outlook;
  outlook.transfer = record::VariableTransfer::between(*from, *to).report();
  outlook.restart_charts = moved_outputs(*from, *to);
  outlook.keep = outlook.restart_charts;
  if (image.size() >= running.image_size()) {
    const ChartCarry charts(running, next, {*from, *to}, DownloadMode::Change);
    if (const auto step = charts.lost_step(image))
      outlook.keep.push_back(lost_step_problem(charts.lost_step_name(*step)));
    const ChartSituations situations(running, next);
    if (const auto chart = situations.impossible(image))
      outlook.keep.push_back(impossible_chart_problem(situations.chart_name(*chart)));
  }
  outlook.from = std::move(*from);
  outlook.to = std::move(*to);
  return outlook;
}

}  // namespace stepwright::host
