#pragma once

// Rules that a program makes of the temporal constraints of a plan: a lower bound becomes a wait in a chart,
// an upper bound a limit that is monitored. Pure functions; any thread.
//
//   least <= t(to) - t(from) <= most
//
//  - least of 0 and more: `to` waits until `from` has happened and so much time has passed since.
//  - most below 0: the other way round, `from` waits for `to`.
//  - most of 0 and more, least below 0: nothing can wait for a later event. Lateness is reported.
//
// Times count from the begin of the missions, which is the schedule's time zero.
//
//   TimeRules rules = time_rules(plan);
//   for (const TimeWait& wait : rules.waits) ...

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// Where in a vehicle's chart something can wait.
enum class ChartPlace : std::uint8_t {
  Start,      // before its mission begins
  Polygon,    // before it may enter the polygon `index`
  StopBegin,  // before the stop `index`
  StopEnd,    // at the stop, before it goes on
  End,        // before it is done
};

// Events of a vehicle that the scan can observe.
enum class EventKind : std::uint8_t {
  Begun,     // its mission
  Entered,   // the polygon `index`
  StopDone,  // the stop `index`
  Left,      // the polygon `index`
  Arrived,   // it is done
};

struct MissionEvent {
  EventKind kind = EventKind::Begun;
  std::uint32_t vehicle = 0;
  std::uint32_t index = 0;

  friend bool operator==(const MissionEvent&, const MissionEvent&) = default;
};

struct TimeWait {
  ChartPlace place = ChartPlace::Start;
  std::uint32_t vehicle = 0;
  std::uint32_t index = 0;
  std::optional<std::uint32_t> event = {};  // index into TimeRules::events; nothing: time zero
  std::chrono::milliseconds delay{0};       // since then
  std::uint32_t constraint = 0;             // index into the plan's
};

struct TimeLimit {
  std::optional<std::uint32_t> since = {};  // likewise
  std::uint32_t event = 0;                  // has to happen ...
  std::chrono::milliseconds within{0};
  std::uint32_t constraint = 0;
};

struct TimeRules {
  std::vector<MissionEvent> events;
  std::vector<TimeWait> waits;
  std::vector<TimeLimit> limits;
  std::vector<std::uint32_t> open;  // constraints that are not seen to in full
};

// Requires constraints that name polygons of the plan.
TimeRules time_rules(const FleetPlan& plan);

// The stop whose service ends with the exit of this polygon.
std::optional<std::uint32_t> stop_of(const VehicleMission& mission, std::uint32_t polygon);

}  // namespace stepwright::fleet
