#pragma once

// Names of a cell's monitors in programs and among tags. Pure; any thread.
//
//   const std::string tag = failed_tag("no_wash_before_press");   // "monitor_no_wash_before_press.Failed"

#include <string>

namespace stepwright::cell_monitors {

// Of the PROGRAM, and of its tag that is TRUE once the formula is FALSE.
std::string program_name(const std::string& monitor);
std::string failed_tag(const std::string& monitor);

}  // namespace stepwright::cell_monitors
