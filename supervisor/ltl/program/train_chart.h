#pragma once

// The chart of a train's program: a step for each state of the task's automaton that the plan goes through,
// left when the monitor has reached the next one. Pure. Detail of this folder.

#include <vector>

#include "ladder/graphic/sfc_chart.h"
#include "supervisor/ltl/program/train_program.h"

namespace stepwright::ltl {

struct TrainChart {
  graphic::SfcChart chart;
  std::vector<TrainStep> steps;
};

TrainChart train_chart(const TrainProgramInput& input, const TrainProgramOptions& options);

}  // namespace stepwright::ltl
