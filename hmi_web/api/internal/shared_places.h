#pragma once

// Variables that lie where something forced lies: forces can name a place by its address, and variables can
// lie over each other in an I/O area. Private to hmi_web/api.
//
//   shared_places(program, "%QB0")   // {"MAIN.valve", "MAIN.pump"}, which are %QX0.0 and %QX0.1
//
// Pure; any thread.

#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::api {

// The variable itself and what it consists of are not among them. None where the program has no such name.
std::vector<std::string> shared_places(const reader::ProgramInfo& program, std::string_view forced);

}  // namespace stepwright::api
