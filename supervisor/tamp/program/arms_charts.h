#pragma once

// The charts of a program: one for each arm, with a step for each of its schedule; one for the cell, which
// says whether arms may work and ends in a step for each cause; one for the camera. Pure. Detail of this
// folder.

#include <vector>

#include "ladder/graphic/sfc_chart.h"
#include "supervisor/tamp/program/program_context.h"

namespace stepwright::tamp::program {

struct ArmsChart {
  graphic::SfcChart chart;
  std::vector<ArmsStep> steps;
};

ArmsChart arm_chart(const ProgramContext& context, std::size_t arm);
ArmsChart cell_chart(const ProgramContext& context);
ArmsChart camera_chart(const ProgramContext& context);

}  // namespace stepwright::tamp::program
