#pragma once

// Check of the operator parts of a drawing against the program that they write to: a part whose value is not
// of its variable's type, whose range the type does not have, or whose variable nobody can write, draws well
// and is refused at every press.
//
//   for (const result::Diagnostic& each : check_parts(drawing.parts, info)) tell(each);
//
// Pure; any thread.

#include <span>

#include "hmi_web/drawing/part.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::screens {

// C0645, each a warning at its part: people draw before the program has everything. A variable that the
// program does not have is told by whoever looks at all names of the drawing.
result::Diagnostics check_parts(std::span<const drawing::Part> parts, const reader::ProgramInfo& info);

}  // namespace stepwright::screens
