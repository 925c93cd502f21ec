#pragma once

// The monitors of a cell as programs that the compiler takes with any program of the cell
// (supervisor/doc/monitors.md).
//
//   auto monitors = cell_monitors(config);
//   driver::compile({.texts = ..., .watchers = watchers_of(*monitors)});
//
// Each is PROGRAM monitor_NAME: its tags are monitor_NAME.Failed, .Satisfied, .Undecided, .State, .Since,
// .Left, .Reset and one BOOL for each proposition. Those that stop the scan run last.
//
// Thread rule: pure functions but for the files of formulas.

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/monitor_check/monitor_names.h"
#include "ladder/driver/watcher.h"
#include "runtime/ground/result/result.h"

namespace stepwright::cell_monitors {

struct CellMonitor {
  std::string name;
  std::string words;  // the formula as it was written, in one line
  std::size_t states = 0;
  std::vector<std::string> propositions;
  bool can_fail = true;
  bool can_be_satisfied = true;
  bool may_never_tell = false;  // some runs leave it undecided, whatever follows
  bool event = false;           // the supervisor hears of it
  bool safe_state = false;
  bool alarm = false;
  result::Location where;
  driver::Watcher program;
};

// What is wrong with formulas, at their places (L0001 to L0031; L0014: no run that ends decides it); C0556: a
// proposition that is no tag has no meaning; C0557: a meaning of no proposition. All problems are told.
[[nodiscard]] result::Result<std::vector<CellMonitor>> cell_monitors(const config::CellConfig& config);

std::vector<driver::Watcher> watchers_of(const std::vector<CellMonitor>& monitors);

// "never wash before press: 3 states over wash, press; when it fails: alarm, event".
std::string sentence_of(const CellMonitor& monitor);

}  // namespace stepwright::cell_monitors
