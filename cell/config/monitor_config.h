#pragma once

// [[monitors]] of a cell's configuration: formulas that the scan watches, whatever program runs
// (supervisor/doc/monitors.md).
//
//   [[monitors]]
//   name = "no_wash_before_press"
//   formula = "never wash before press"       # or formula_file = "rules.ltl"
//   let = { wash = "main.at_wash", press = "main.level >= 20" }
//   on_false = ["alarm", "event"]             # and "safe_state"; default: alarm
//
// A proposition that `let` does not name is the tag of its own name. Diagnostics with their place: C0551 a
// name that is no identifier, C0552 a name twice, C0553 no formula or two, C0554 what on_false does not know,
// C0555 a text that is no expression of one line. What is wrong with a formula and with tags is found where
// monitors are made (cell/monitors).
//
// Plain data; read by load_cell_config.

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

// What a proposition means: an expression in ST over tags.
struct PropositionMeaning {
  std::string name;
  std::string expression;
  result::Location where;
};

struct MonitorConfig {
  std::string name;
  std::string formula;
  std::filesystem::path formula_file;  // then `formula` is empty
  std::vector<PropositionMeaning> let;
  bool alarm = true;        // of the page
  bool safe_state = false;  // the scan ends with R0407, outputs take the column `trap`
  bool event = false;       // the supervisor opens an incident and plans anew
  result::Location where;   // of the formula
};

std::vector<MonitorConfig> read_monitors(const settings::TomlTable& root,
                                         const std::filesystem::path& folder);

}  // namespace stepwright::config
