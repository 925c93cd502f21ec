#pragma once

// The chart that tells of alarms: its step changes in the scan in which their number does, so that whoever
// follows the program hears of it as of any step. Private to supervisor/translate.
//
// Pure function.

#include <string>

#include "ladder/graphic/project.h"

namespace stepwright::translate::internal {

// The number that it has told of.
inline constexpr const char* kAlarmsTold = "MON_TOLD";

// `count` is the global of type UDINT that counts the alarms.
graphic::Pou watch_program(const std::string& count);

}  // namespace stepwright::translate::internal
