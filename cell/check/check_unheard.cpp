#include "cell/check/check_unheard.h"

#include <string>

#include "cell/check/listening_servers.h"

namespace stepwright::check {

result::Diagnostics check_unheard(const config::CellConfig& config) {
  result::Diagnostics problems;
  if (!config.history.folder.empty()) return problems;
  const auto tell = [&](result::Severity severity, const result::Location& where, const std::string& what) {
    problems.push_back({"C0475", severity, where, what + ": the cell keeps no history, and so has no alarms",
                        "[history] folder = \"history\""});
  };
  if (!config.history.alarms.empty())
    tell(result::Severity::Error, where_of(config, "history", "alarms"), "none of these alarms ever comes");
  if (!config.notify.empty())
    tell(result::Severity::Error, {config.file.string(), 0, 0}, "[[notify]] never tells of anything");
  for (const config::MonitorConfig& each : config.monitors)
    if (each.alarm)
      tell(result::Severity::Warning, each.where,
           "the monitor '" + each.name + "' is to raise an alarm (on_false), and raises none");
  return problems;
}

}  // namespace stepwright::check
