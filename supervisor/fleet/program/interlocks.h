#pragma once

// The precedences of a schedule as conditions for entering polygons, and the proof that they are enough:
// every two polygons of different vehicles that overlap are ordered, and nobody waits for ever, neither for
// them nor for what temporal constraints ask for. Pure
// functions.
//
//   auto interlocks = find_interlocks(plan, options);
//   for (const Interlock& wait : interlocks->before[v][k]) ...   // what vehicle v waits for before polygon k

#include <cstdint>
#include <vector>

#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/fleet/program/time_rules.h"
#include "supervisor/fleet/program/wait_places.h"

namespace stepwright::fleet {

// The vehicle has left its polygon.
struct Interlock {
  std::uint32_t vehicle = 0;
  std::uint32_t polygon = 0;

  friend auto operator<=>(const Interlock&, const Interlock&) = default;
};

struct Interlocks {
  // By vehicle and polygon: what it takes to enter it.
  std::vector<std::vector<std::vector<Interlock>>> before;
  std::vector<WaitPlaces> places;  // by vehicle
  // Rules of the constraints. None of their waits is for an event that comes only after it.
  TimeRules times;
};

// Fails with F1101, F1102 or F1103.
[[nodiscard]] result::Result<Interlocks> find_interlocks(const FleetPlan& plan,
                                                         const ProgramOptions& options);

}  // namespace stepwright::fleet
