#pragma once

// Reading the configuration of a running process again: what may change while it runs changes, the rest is
// named with its place and waits for a restart, and a wrong file changes nothing.
//
//   auto again = reload_cell(running, {"log.", "safe_state.supervisor_lost_after_ms"});
//   if (!again) return report(again.error());         // `running` stays in force
//   running = std::move(again->config);
//
// Notes: C0464 (note) a value that is in force now, C0465 (warning) one that needs a restart.

#include <string_view>
#include <vector>

#include "cell/config/cell_config.h"

namespace stepwright::config {

struct ReloadedCell {
  CellConfig config;  // as `running`, with what may change taken from the file
  CellConfig wanted;  // the whole file, as a restart would take it
  result::Diagnostics notes;
};

// `reloadable` are dotted keys, or beginnings of such that end in '.'. Copies of their values are the
// caller's business: of the typed fields, `config` takes over `log` and `supervisor_lost_after`.
[[nodiscard]] result::Result<ReloadedCell> reload_cell(const CellConfig& running,
                                                       const std::vector<std::string_view>& reloadable);

}  // namespace stepwright::config
