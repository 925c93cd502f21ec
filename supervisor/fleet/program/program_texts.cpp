#include "supervisor/fleet/program/program_texts.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>

#include "supervisor/fleet/program/mission_chart.h"

namespace stepwright::fleet {
namespace {

using graphic::Variable;
using graphic::VariableSection;

Variable global(std::string name, std::string type, std::string comment, std::string address = {},
                std::string initial = {}) {
  Variable made;
  made.name = std::move(name);
  made.type = std::move(type);
  made.section = VariableSection::Global;
  made.address = std::move(address);
  made.initial = std::move(initial);
  made.comment = std::move(comment);
  return made;
}

Variable block(std::string name, std::string type) {
  Variable made;
  made.name = std::move(name);
  made.type = std::move(type);
  return made;
}

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
  failed := MC_GroupFail(ErrorID := 29, Vehicle := vehicle_{0});
END_IF;
power_{0}(Enable := NOT done_{0}, Vehicle := vehicle_{0});
)";
constexpr const char* kMoving =
    "move_{0}(Execute := vehicle_{0}.DriveOn, Permitted := permitted_{0}, Path := {1}, Vehicle := "
    "vehicle_{0});\n";
constexpr const char* kOutputs =
    R"(forks_{0}(Execute := move_forks_{0} AND vehicle_{0}.DriveOn, Up := raise_{0}, Vehicle := vehicle_{0});
forks_done_{0} := forks_{0}.Done;
run_{0}(Vehicle := vehicle_{0});
enable_{0} := vehicle_{0}.DriveOn;
set_speed_{0} := REAL_TO_INT(vehicle_{0}.SetSpeed * 1000.0);
set_lock_{0} := REAL_TO_INT(vehicle_{0}.SetLock * 5729.578);
lift_{0} := vehicle_{0}.Lift;
)";

std::string filled(const char* text, const VehicleNames& names) {
  return fmt::format(fmt::runtime(text), names.name, names.path, names.areas, names.planes);
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string vehicle_initial(const VehicleMission& mission, const ProgramOptions& options, double phase) {
  const VehicleModel& model = mission.model;
  const DriveData& drive = options.drive;
  const double lock = model.max_steering_rad > 0.0
                          ? model.max_steering_rad
                          : std::atan(model.wheelbase_m / model.min_turning_radius_m);
  const std::pair<const char*, double> figures[] = {{"Wheelbase", model.wheelbase_m},
                                                    {"Front", model.front_m},
                                                    {"Rear", model.rear_m},
                                                    {"HalfWidth", 0.5 * model.width_m},
                                                    {"MaxSpeed", mission.speed.max_mps},
                                                    {"Acceleration", drive.speed_up_m_s2},
                                                    {"Deceleration", drive.brake_m_s2},
                                                    {"HardDeceleration", drive.hard_brake_m_s2},
                                                    {"MaxLock", lock},
                                                    {"LockRate", drive.lock_rate_rad_s},
                                                    {"SpeedLag", drive.speed_lag_s},
                                                    {"LockLag", drive.lock_lag_s},
                                                    {"Phase", phase}};
  std::string text;
  for (const auto& [name, value] : figures) {
    text += fmt::format("{}{} := {}", text.empty() ? "(" : ", ", name, real_literal(value));
  }
  return text + ")";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> named_terminals(const VehicleTerminals& t) {
  return {{"x", t.x},           {"y", t.y},           {"heading", t.heading},     {"speed", t.speed},
          {"lock", t.lock},     {"lifted", t.lifted}, {"lowered", t.lowered},     {"loaded", t.loaded},
          {"bumper", t.bumper}, {"enable", t.enable}, {"set_speed", t.set_speed}, {"set_lock", t.set_lock},
          {"lift", t.lift}};
}

std::vector<Variable> shared_globals(const FleetTerminals& terminals) {
  return {global("estop_ok", "BOOL", "off while the emergency stop is pressed", terminals.estop_ok),
          global("fleet_reset", "BOOL", "a rising edge lets vehicles go on that have stopped by themselves"),
          global("fleet_time", "TIME", "since the program began")};
}

std::vector<Variable> vehicle_globals(const VehicleMission& mission, const VehicleNames& names,
                                      const VehicleTerminals& terminals, const ProgramOptions& options) {
  const std::string& v = names.name;
  std::vector<Variable> globals;
  for (const auto& [name, address] : named_terminals(terminals)) {
    globals.push_back(
        global(name + "_" + v, is_word(name) ? "INT" : "BOOL", "terminal of " + mission.vehicle, address));
  }
  // Vehicles take turns, so that not all of them compute in the same scan.
  globals.push_back(global("vehicle_" + v, "VEHICLE_REF", mission.vehicle, {},
                           vehicle_initial(mission, options, static_cast<double>(names.turn % 4) / 4.0)));
  globals.push_back(global("slack_" + v, "REAL",
                           "by which the outline may be measured outside of its polygons", {},
                           real_literal(options.margins.outside_m)));
  globals.push_back(global("permitted_" + v, "REAL", "up to where it may drive along its path, m"));
  globals.push_back(global("arc_" + v, "REAL", "how far it has come along its path, m"));
  globals.push_back(global("areas_" + v, "INT", "how many of its polygons it has left"));
  for (const auto& [name, comment] : {std::pair("standing", "it stands"),
                                      {"move_forks", "forks are to move"},
                                      {"raise", "and up"},
                                      {"forks_done", "and have"},
                                      {"no_load", "it has lifted nothing"},
                                      {"done", "it has arrived for good"}}) {
    globals.push_back(global(std::string(name) + "_" + v, "BOOL", comment));
  }
  return globals;
}

std::string sensing_text(const std::vector<VehicleNames>& vehicles, std::uint32_t revision) {
  // An online change carries a block by its name.
  std::string text =
      fmt::format("clock_{0}(IN := TRUE, PT := T#100000s);\nfleet_time := clock_{0}.ET;\n", revision);
  for (const VehicleNames& names : vehicles) text += filled(kSensing, names);
  return text;
}

std::vector<Variable> sensing_blocks(const std::vector<VehicleNames>& vehicles, std::uint32_t revision) {
  std::vector<Variable> blocks = {block(fmt::format("clock_{}", revision), "TON")};
  for (const VehicleNames& names : vehicles) {
    blocks.push_back(block("read_" + names.name, "MC_ReadVehicle"));
    blocks.push_back(block("watch_" + names.name, "MC_WatchArea"));
  }
  return blocks;
}

std::string driving_text(const std::vector<VehicleNames>& vehicles) {
  std::string text;
  for (const VehicleNames& names : vehicles) {
    text += filled(kDriving, names);
    if (!names.path.empty()) text += filled(kMoving, names);
    text += filled(kOutputs, names);
  }
  return text;
}

std::vector<Variable> driving_blocks(const std::vector<VehicleNames>& vehicles) {
  std::vector<Variable> blocks = {block("failed", "BOOL")};
  for (const VehicleNames& names : vehicles) {
    blocks.push_back(block("reset_" + names.name, "MC_GroupReset"));
    blocks.push_back(block("power_" + names.name, "MC_GroupPower"));
    if (!names.path.empty()) blocks.push_back(block("move_" + names.name, "MC_MovePath"));
    blocks.push_back(block("forks_" + names.name, "MC_MoveForks"));
    blocks.push_back(block("run_" + names.name, "MC_RunVehicle"));
  }
  return blocks;
}

bool mentions(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool starts = at == 0 || !is_name_character(text[at - 1]);
    if (starts && (end == text.size() || !is_name_character(text[end]))) return true;
  }
  return false;
}

}  // namespace stepwright::fleet
