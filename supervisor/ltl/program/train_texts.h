#pragma once

// The statements around the chart: terminals into the vehicle and back, the function blocks between, and the
// task's monitor. Pure. Detail of this folder.

#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "supervisor/ltl/program/train_program.h"

namespace stepwright::ltl {

std::vector<graphic::Variable> train_globals(const TrainProgramInput& input, const TrainTerminals& terminals,
                                             const TrainProgramOptions& options);

// PROGRAM sensing: before the chart. Blocks: the instances that the text calls.
std::string train_sensing(const TrainProgramInput& input, const TrainProgramOptions& options);
std::vector<graphic::Variable> train_sensing_blocks(const TrainProgramInput& input);
// PROGRAM driving: behind it. `path`: the name of its table, empty if there is none.
std::string train_driving(const TrainProgramOptions& options, const std::string& path);
std::vector<graphic::Variable> train_driving_blocks(const TrainProgramOptions& options,
                                                    const std::string& path);

// The type of the task's block, and its instance.
std::string watch_type(const TrainWatch& watch);
std::string watch_instance(const TrainWatch& watch);

}  // namespace stepwright::ltl
