#pragma once

// The chart of one vehicle's mission: polygons and stops in the order of the way. Pure.
//
//   MissionChart made = mission_chart(plan, names, interlocks, vehicle, options);

#include <string>
#include <vector>

#include "ladder/graphic/sfc_chart.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/fleet/program/interlocks.h"

namespace stepwright::fleet {

struct MissionChart {
  graphic::SfcChart chart;
  std::vector<MissionStep> steps;
};

// `names`: of the vehicles, as variables have them.
MissionChart mission_chart(const FleetPlan& plan, const std::vector<std::string>& names,
                           const Interlocks& interlocks, std::uint32_t vehicle,
                           const ProgramOptions& options);

// Variables: that an event has happened, and that the delay of a wait has passed since.
std::string event_name(std::size_t event);
std::string waited_name(std::size_t wait);
// By an action of its vehicle's chart; the others are seen from measurements.
bool set_by_chart(const MissionEvent& event);

}  // namespace stepwright::fleet
