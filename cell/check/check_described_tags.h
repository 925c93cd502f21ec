#pragma once

// [tags] of a cell, and its table, against the variables of a program and the points of the plant's picture.
// C0632 (a warning): there is nothing of that name, so that nobody will see what is said of it.
//
// Pure; any thread.

#include <span>
#include <string>
#include <vector>

#include "cell/config/tag_config.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::check {

result::Diagnostics check_described_tags(std::span<const config::TagConfig> tags,
                                         const reader::ProgramInfo& info,
                                         const std::vector<std::string>& points);

}  // namespace stepwright::check
