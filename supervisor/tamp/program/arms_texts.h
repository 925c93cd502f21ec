#pragma once

// The statements around the charts: terminals into the groups of axes and back, the blocks between, and the
// cause of a stop. Pure. Detail of this folder.

#include <string>
#include <vector>

#include "supervisor/tamp/program/program_context.h"

namespace stepwright::tamp::program {

// All but the tables of paths.
std::vector<graphic::Variable> arms_globals(const ProgramContext& context);

// PROGRAM sensing: before the charts. Blocks: the instances that the text calls.
std::string sensing_text(const ProgramContext& context);
std::vector<graphic::Variable> sensing_blocks(const ProgramContext& context);
// PROGRAM moving: behind them.
std::string moving_text(const ProgramContext& context);
std::vector<graphic::Variable> moving_blocks(const ProgramContext& context);

}  // namespace stepwright::tamp::program
