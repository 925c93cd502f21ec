#pragma once

// A program that is compiled with others in order to watch them. It reads their variables under the names of
// viewers (INSTANCE.block.variable), also those that are internal, and runs behind the programs of the task
// that it reads (semantics/internal/watcher.h); __STOP() in it ends the scan with R0407.
//
// Plain values. Example:
//   Watcher{.name = "limit", .text = "PROGRAM limit\nVAR High : BOOL; END_VAR\nHigh := main.level > 90;\n"
//                                    "END_PROGRAM\n"}

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::driver {

// A BOOL of the watcher that viewers see as a step of a chart: whoever follows the program hears of its
// change.
struct WatcherState {
  std::string variable;
  std::string shown;  // the step's name
  std::string comment{};
};

struct Watcher {
  std::string name;  // of the PROGRAM, of its instance and of the file that places in it name
  std::string text;  // ST: this PROGRAM and nothing else
  // So many statements at its beginning assign to its variables what they read outside: names in their values
  // are never its own.
  std::uint32_t outside_reads = 0;
  // Where line k + 1 of the text comes from: diagnostics are moved there. The last one counts for all lines
  // behind it, none: they stay where they are.
  std::vector<result::Location> origins{};
  std::vector<WatcherState> states{};  // the first one is the initial step
};

}  // namespace stepwright::driver
