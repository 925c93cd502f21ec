#include "cell/monitor_check/missing_monitors.h"

#include "cell/monitor_check/monitor_names.h"

namespace stepwright::cell_monitors {

result::Diagnostics missing_monitors(const config::CellConfig& config, const reader::ProgramInfo& program) {
  result::Diagnostics problems;
  for (const config::MonitorConfig& each : config.monitors) {
    if (program.find(failed_tag(each.name))) continue;
    problems.push_back({"C0558", result::Severity::Error, each.where,
                        "the program does not have the monitor '" + each.name + "'",
                        "compile it for this cell: stepwright compile ... --config CELL.toml"});
  }
  return problems;
}

result::Diagnostics missing_monitors(const config::CellConfig& config, std::span<const std::byte> container) {
  if (config.monitors.empty()) return {};
  const auto info = reader::ProgramInfo::read(container);
  return info ? missing_monitors(config, *info) : result::Diagnostics{};
}

}  // namespace stepwright::cell_monitors
