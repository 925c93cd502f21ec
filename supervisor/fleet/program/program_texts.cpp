#include "supervisor/fleet/program/program_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "supervisor/fleet/program/mission_chart.h"
#include "supervisor/vehicle/data_tables.h"
#include "supervisor/vehicle/literals.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::fleet {
namespace {

using graphic::Variable;
using vehicle::global_variable;
using vehicle::instance;
using vehicle::real_literal;
using vehicle::time_literal;

bool is_word(const std::string& terminal) {
  constexpr std::array<std::string_view, 7> kWords = {"x",    "y",         "heading", "speed",
                                                      "lock", "set_speed", "set_lock"};
  for (const std::string_view word : kWords) {
    if (terminal == word) return true;
  }
  return false;
}

// `{0}` is the vehicle, {1} its path, {2} its areas, {3} their sides.
constexpr const char* kSensing = R"(
vehicle_{0}.MeasuredX := INT_TO_REAL(x_{0}) * 0.01;
vehicle_{0}.MeasuredY := INT_TO_REAL(y_{0}) * 0.01;
vehicle_{0}.MeasuredHeading := INT_TO_REAL(heading_{0}) * 1.745329E-04;
vehicle_{0}.MeasuredSpeed := INT_TO_REAL(speed_{0}) * 0.001;
vehicle_{0}.MeasuredLock := INT_TO_REAL(lock_{0}) * 1.745329E-04;
vehicle_{0}.Lifted := lifted_{0};
vehicle_{0}.Lowered := lowered_{0};
vehicle_{0}.Loaded := loaded_{0};
vehicle_{0}.Bumper := bumper_{0};
vehicle_{0}.SafetyOk := estop_ok;
read_{0}(Vehicle := vehicle_{0});
watch_{0}(Permitted := permitted_{0}, Slack := slack_{0}, Areas := {2}, Planes := {3}, Vehicle := vehicle_{0});
arc_{0} := vehicle_{0}.Arc;
areas_{0} := vehicle_{0}.Areas;
standing_{0} := vehicle_{0}.Standing;
)";

constexpr const char* kDriving = R"(
reset_{0}(Execute := fleet_reset, Vehicle := vehicle_{0});
IF no_load_{0} THEN
  failed := MC_VehicleFail(ErrorID := 29, Vehicle := vehicle_{0});
END_IF;
power_{0}(Enable := NOT done_{0}, Vehicle := vehicle_{0});
)";
constexpr const char* kMoving =
    "move_{0}(Execute := vehicle_{0}.DriveOn, Permitted := permitted_{0}, Path := {1}, Vehicle := "
    "vehicle_{0});\n";
// Without a way no command would take the place of the one that an earlier program has given: the vehicle
// would drive on by it.
constexpr const char* kStaying = "stop_{0}(Execute := NOT done_{0}, Vehicle := vehicle_{0});\n";
constexpr const char* kOutputs =
    R"(forks_{0}(Execute := move_forks_{0} AND vehicle_{0}.DriveOn, Up := raise_{0}, Vehicle := vehicle_{0});
forks_done_{0} := forks_{0}.Done;
run_{0}(Vehicle := vehicle_{0});
enable_{0} := vehicle_{0}.DriveOn;
set_speed_{0} := REAL_TO_INT(vehicle_{0}.SetSpeed * 1000.0);
set_lock_{0} := REAL_TO_INT(vehicle_{0}.SetLock * 5729.578);
lift_{0} := vehicle_{0}.Lift;
)";

bool needs_timer(const TimeWait& wait) {
  return wait.event && wait.delay.count() > 0;
}

std::string words(const MissionEvent& event) {
  switch (event.kind) {
    case EventKind::Begun:
      return "has begun its mission";
    case EventKind::Entered:
      return fmt::format("has entered polygon {}", event.index);
    case EventKind::StopDone:
      return fmt::format("has done its stop {}", event.index + 1);
    case EventKind::Left:
      return fmt::format("has left polygon {}", event.index);
    case EventKind::Arrived:
      break;
  }
  return "has arrived for good";
}

// An event that no chart knows of.
std::string sensed(const FleetPlan& plan, const std::vector<VehicleNames>& vehicles, const TimeRules& rules,
                   std::size_t number) {
  const MissionEvent& event = rules.events[number];
  const std::string& vehicle = vehicles[event.vehicle].name;
  std::string seen = "done_" + vehicle;
  if (event.kind == EventKind::Left) seen = fmt::format("areas_{} >= {}", vehicle, event.index + 1);
  if (event.kind == EventKind::Entered) {
    const auto begun = std::ranges::find(rules.events, MissionEvent{EventKind::Begun, event.vehicle, 0});
    const auto index = static_cast<std::size_t>(begun - rules.events.begin());
    const double entry_m = plan.missions[event.vehicle].grown.visits[event.index].entry_m;
    seen = fmt::format("{} AND arc_{} >= {}", event_name(index), vehicle, real_literal(entry_m));
  }
  return fmt::format("{} := {};\n", event_name(number), seen);
}

// Late is who has not done in time what a constraint asks for, until a reset or its next mission.
std::string limits_text(const std::vector<VehicleNames>& vehicles, const TimeRules& rules) {
  if (rules.limits.empty()) return {};
  std::string text = "IF fleet_reset THEN\n";
  for (const VehicleNames& names : vehicles)
    text += fmt::format("  late_{0} := FALSE;\n  late_for_{0} := 0;\n", names.name);
  text += "END_IF;\n";
  for (std::size_t k = 0; k < rules.limits.size(); ++k) {
    const TimeLimit& limit = rules.limits[k];
    const std::string& vehicle = vehicles[rules.events[limit.event].vehicle].name;
    const std::string event = event_name(limit.event);
    std::string over = fmt::format("fleet_time > {} AND NOT {}", time_literal(limit.within), event);
    if (limit.since) {
      text += fmt::format("limit_{}(IN := {} AND NOT {}, PT := {});\n", k + 1, event_name(*limit.since),
                          event, time_literal(limit.within));
      over = fmt::format("limit_{}.Q", k + 1);
    }
    text += fmt::format(
        "IF {0} THEN\n  IF NOT late_{1} THEN\n    late_for_{1} := {2};\n  END_IF;\n  late_{1} := "
        "TRUE;\nEND_IF;\n",
        over, vehicle, limit.constraint + 1);
  }
  return text;
}

bool resets(const ProgramOptions& options, std::size_t vehicle) {
  return vehicle < options.reset.vehicles.size() && options.reset.vehicles[vehicle];
}

std::string reset_block(const VehicleNames& names, const ProgramOptions& options) {
  return fmt::format("reset_{}_{}", options.reset.number, names.name);
}

std::string filled(const char* text, const VehicleNames& names) {
  return fmt::format(fmt::runtime(text), names.name, names.path, names.areas, names.planes);
}

std::string initial_of(const VehicleMission& mission, const ProgramOptions& options, double phase) {
  const VehicleModel& model = mission.model;
  const DriveData& drive = options.drive;
  const double lock = model.max_steering_rad > 0.0
                          ? model.max_steering_rad
                          : std::atan(model.wheelbase_m / model.min_turning_radius_m);
  return vehicle::vehicle_initial({.wheelbase_m = model.wheelbase_m,
                                   .front_m = model.front_m,
                                   .rear_m = model.rear_m,
                                   .half_width_m = 0.5 * model.width_m,
                                   .top_speed_m_s = mission.speed.max_mps,
                                   .speed_up_m_s2 = drive.speed_up_m_s2,
                                   .brake_m_s2 = drive.brake_m_s2,
                                   .hard_brake_m_s2 = drive.hard_brake_m_s2,
                                   .full_lock_rad = lock,
                                   .lock_rate_rad_s = drive.lock_rate_rad_s,
                                   .speed_lag_s = drive.speed_lag_s,
                                   .lock_lag_s = drive.lock_lag_s,
                                   .phase = phase});
}

}  // namespace

std::vector<std::pair<std::string, std::string>> named_terminals(const VehicleTerminals& t) {
  return {{"x", t.x},           {"y", t.y},           {"heading", t.heading},     {"speed", t.speed},
          {"lock", t.lock},     {"lifted", t.lifted}, {"lowered", t.lowered},     {"loaded", t.loaded},
          {"bumper", t.bumper}, {"enable", t.enable}, {"set_speed", t.set_speed}, {"set_lock", t.set_lock},
          {"lift", t.lift}};
}

std::vector<Variable> shared_globals(const FleetTerminals& terminals) {
  return {global_variable("estop_ok", "BOOL", "off while the emergency stop is pressed", terminals.estop_ok),
          global_variable("fleet_reset", "BOOL",
                          "a rising edge lets vehicles go on that have stopped by themselves"),
          global_variable("fleet_clock", "TIME", "since the program began"),
          global_variable("fleet_epoch", "TIME", "of that clock: when the missions began"),
          global_variable("fleet_time", "TIME", "since the missions began: the schedule's clock")};
}

std::vector<Variable> time_globals(const FleetPlan& plan, const TimeRules& rules) {
  std::vector<Variable> globals;
  for (std::size_t k = 0; k < rules.events.size(); ++k) {
    const MissionEvent& event = rules.events[k];
    globals.push_back(
        global_variable(event_name(k), "BOOL", plan.missions[event.vehicle].vehicle + " " + words(event)));
  }
  for (std::size_t k = 0; k < rules.waits.size(); ++k) {
    const TimeWait& wait = rules.waits[k];
    if (!needs_timer(wait)) continue;
    globals.push_back(
        global_variable(waited_name(k), "BOOL",
                        fmt::format("{} since {}", time_literal(wait.delay), event_name(*wait.event))));
  }
  return globals;
}

std::vector<Variable> vehicle_globals(const VehicleMission& mission, const VehicleNames& names,
                                      const VehicleTerminals& terminals, const ProgramOptions& options) {
  const std::string& v = names.name;
  std::vector<Variable> globals;
  for (const auto& [name, address] : named_terminals(terminals)) {
    globals.push_back(global_variable(name + "_" + v, is_word(name) ? "INT" : "BOOL",
                                      "terminal of " + mission.vehicle, address));
  }
  // Vehicles take turns, so that not all of them compute in the same scan.
  globals.push_back(global_variable("vehicle_" + v, "VEHICLE_REF", mission.vehicle, {},
                                    initial_of(mission, options, static_cast<double>(names.turn % 4) / 4.0)));
  globals.push_back(global_variable("slack_" + v, "REAL",
                                    "by which the outline may be measured outside of its polygons", {},
                                    real_literal(options.margins.outside_m)));
  globals.push_back(global_variable("permitted_" + v, "REAL", "up to where it may drive along its path, m"));
  globals.push_back(global_variable("arc_" + v, "REAL", "how far it has come along its path, m"));
  globals.push_back(global_variable("areas_" + v, "INT", "how many of its polygons it has left"));
  globals.push_back(global_variable("late_for_" + v, "INT",
                                    "number of the first temporal constraint that it has missed, from 1"));
  for (const auto& [name, comment] : {std::pair("standing", "it stands"),
                                      {"late", "its mission is late"},
                                      {"move_forks", "forks are to move"},
                                      {"raise", "and up"},
                                      {"forks_done", "and have"},
                                      {"no_load", "it has lifted nothing"},
                                      {"done", "it has arrived for good"}}) {
    globals.push_back(global_variable(std::string(name) + "_" + v, "BOOL", comment));
  }
  return globals;
}

std::string sensing_text(const FleetPlan& plan, const std::vector<VehicleNames>& vehicles,
                         const TimeRules& rules, std::uint32_t revision) {
  // An online change carries a block by its name.
  std::string text = fmt::format(
      "clock_{0}(IN := TRUE, PT := T#100000s);\nfleet_clock := clock_{0}.ET;\n"
      "fleet_time := fleet_clock - fleet_epoch;\n",
      revision);
  for (const VehicleNames& names : vehicles) text += filled(kSensing, names);
  for (std::size_t k = 0; k < rules.events.size(); ++k) {
    if (!set_by_chart(rules.events[k])) text += sensed(plan, vehicles, rules, k);
  }
  for (std::size_t k = 0; k < rules.waits.size(); ++k) {
    const TimeWait& wait = rules.waits[k];
    if (!needs_timer(wait)) continue;
    text += fmt::format("wait_{0}(IN := {1}, PT := {2});\n{3} := wait_{0}.Q;\n", k + 1,
                        event_name(*wait.event), time_literal(wait.delay), waited_name(k));
  }
  return text + limits_text(vehicles, rules);
}

std::vector<Variable> sensing_blocks(const std::vector<VehicleNames>& vehicles, const TimeRules& rules,
                                     std::uint32_t revision) {
  std::vector<Variable> blocks = {instance(fmt::format("clock_{}", revision), "TON")};
  for (const VehicleNames& names : vehicles) {
    blocks.push_back(instance("read_" + names.name, "MC_ReadVehicle"));
    blocks.push_back(instance("watch_" + names.name, "MC_WatchArea"));
  }
  for (std::size_t k = 0; k < rules.waits.size(); ++k) {
    if (needs_timer(rules.waits[k])) blocks.push_back(instance(fmt::format("wait_{}", k + 1), "TON"));
  }
  for (std::size_t k = 0; k < rules.limits.size(); ++k) {
    if (rules.limits[k].since) blocks.push_back(instance(fmt::format("limit_{}", k + 1), "TON"));
  }
  return blocks;
}

std::string driving_text(const std::vector<VehicleNames>& vehicles, const ProgramOptions& options) {
  std::string text;
  for (std::size_t v = 0; v < vehicles.size(); ++v) {
    const VehicleNames& names = vehicles[v];
    if (resets(options, v))
      text += fmt::format("{}(Execute := TRUE, Vehicle := vehicle_{});\n", reset_block(names, options),
                          names.name);
    text += filled(kDriving, names);
    text += filled(names.path.empty() ? kStaying : kMoving, names);
    text += filled(kOutputs, names);
  }
  return text;
}

std::vector<Variable> driving_blocks(const std::vector<VehicleNames>& vehicles,
                                     const ProgramOptions& options) {
  std::vector<Variable> blocks = {instance("failed", "BOOL")};
  for (std::size_t v = 0; v < vehicles.size(); ++v) {
    const VehicleNames& names = vehicles[v];
    if (resets(options, v)) blocks.push_back(instance(reset_block(names, options), "MC_VehicleReset"));
    blocks.push_back(instance("reset_" + names.name, "MC_VehicleReset"));
    blocks.push_back(instance("power_" + names.name, "MC_VehiclePower"));
    blocks.push_back(names.path.empty() ? instance("stop_" + names.name, "MC_VehicleStop")
                                        : instance("move_" + names.name, "MC_DrivePath"));
    blocks.push_back(instance("forks_" + names.name, "MC_MoveForks"));
    blocks.push_back(instance("run_" + names.name, "MC_RunVehicle"));
  }
  return blocks;
}

}  // namespace stepwright::fleet
