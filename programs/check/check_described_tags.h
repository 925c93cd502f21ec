#pragma once

// [tags] of a cell against the variables of a program. C0632 (a warning): the program has no variable of that
// name, so that nobody will see what is said of it.
//
// Pure; any thread.

#include <span>

#include "cell/config/tag_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

result::Diagnostics check_described_tags(std::span<const config::TagConfig> tags,
                                         const reader::ProgramInfo& info);

}  // namespace stepwright::check
