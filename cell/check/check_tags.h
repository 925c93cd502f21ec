#pragma once

// The tags of a Modbus client against the variables of a program. C0528: the program declares another type
// than the one that the tag puts there, so that it would read another number: an error between floating point
// and integers, a warning between signs. C0529 (a warning): no variable of the program is there.
//
// Pure; any thread.

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::check {

// At the place of the tag's address.
result::Diagnostics check_tags(const modbus::client::ClientSettings& client, const reader::ProgramInfo& info);

}  // namespace stepwright::check
