#pragma once

// Disturbance of one run of the campaign: the plant, the sensors, the customers and the runtime, drawn at
// random from a seed. The same seed always gives the same disturbance. Pure; any thread.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/executive/executive.h"
#include "tests/support/controller/simulated_controller.h"

namespace stepwright::campaign {

enum class DisturbanceClass : std::uint8_t {
  None,
  Leak,          // of a tank, for a while or for good
  WeakPump,      // down to nothing
  StuckSwitch,   // of a place, for a while or for good
  Drift,         // of a level sensor
  FrozenSensor,  // of a level
  Draw,          // a customer takes what nobody gave it
  Demand,        // a customer wants something else
  NewGoal,       // other levels are wanted at the end
  LostRuntime,   // killed, and back without its program
  Several,       // two or three of these
};
inline constexpr std::size_t kClasses = 11;
const char* to_string(DisturbanceClass disturbance);

struct Disturbance {
  std::uint64_t seed = 0;
  DisturbanceClass of = DisturbanceClass::None;
  std::vector<support::PlantFault> faults;  // in order of time
  std::vector<executive::GoalChange> changes;
  std::optional<double> kill_at_s;
  std::string story;  // for the list of failing seeds

  // A sensor or a switch shows what is not so.
  bool lies() const;
  // True if a level sensor drifts.
  bool drifts() const;
  // The plant cannot always be brought to the goal.
  bool breaks() const;
};

// Class by seed in turn, so that every class has its share of a campaign; the rest at random.
Disturbance disturbance_of(std::uint64_t seed);

}  // namespace stepwright::campaign
