#include "supervisor/ltl/program/train_texts.h"

#include <fmt/format.h>

#include <utility>

#include "ladder/graphic/identifier.h"
#include "supervisor/ltl/monitor/monitor_block.h"
#include "supervisor/vehicle/data_tables.h"
#include "supervisor/vehicle/literals.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::ltl {
namespace {

using graphic::Variable;
using vehicle::global_variable;
using vehicle::instance;
using vehicle::real_literal;
using vehicle::time_literal;

std::string initial_of(const TrainModel& train, const TrainDrive& drive) {
  return vehicle::vehicle_initial({.wheelbase_m = train.wheelbase_m,
                                   .front_m = 0.5 * train.length_m,
                                   .rear_m = 0.5 * train.length_m,
                                   .half_width_m = 0.5 * train.width_m,
                                   .top_speed_m_s = drive.top_speed_m_s,
                                   .speed_up_m_s2 = drive.speed_up_m_s2,
                                   .brake_m_s2 = drive.brake_m_s2,
                                   .hard_brake_m_s2 = drive.hard_brake_m_s2,
                                   .full_lock_rad = train.most_lock_rad,
                                   .lock_rate_rad_s = drive.lock_rate_rad_s,
                                   .speed_lag_s = drive.speed_lag_s,
                                   .lock_lag_s = drive.lock_lag_s});
}

constexpr const char* kSensing = R"(vehicle_train.MeasuredX := INT_TO_REAL(x) * 0.01;
vehicle_train.MeasuredY := INT_TO_REAL(y) * 0.01;
vehicle_train.MeasuredHeading := INT_TO_REAL(heading) * 1.745329E-04;
vehicle_train.MeasuredSpeed := INT_TO_REAL(speed) * 0.001;
vehicle_train.MeasuredLock := INT_TO_REAL(lock) * 1.745329E-04;
vehicle_train.Bumper := bumper;
vehicle_train.SafetyOk := estop_ok;
read_train(Vehicle := vehicle_train);
arc := vehicle_train.Arc;
standing := vehicle_train.Standing;
)";

constexpr const char* kDriving = R"(power_train(Enable := NOT at_rest, Vehicle := vehicle_train);
)";
// Something stands in the way: no further than here.
constexpr const char* kMoving = R"(allowed := permitted;
IF seen THEN
  allowed := MIN(permitted, arc);
END_IF;
move_train(Execute := vehicle_train.DriveOn, Permitted := allowed, Path := {}, Vehicle := vehicle_train);
)";
// Without a way no command would take the place of the one that an earlier program has given.
constexpr const char* kStaying = "stop_train(Execute := NOT at_rest, Vehicle := vehicle_train);\n";
constexpr const char* kOutputs = R"(run_train(Vehicle := vehicle_train);
enable := vehicle_train.DriveOn;
set_speed := REAL_TO_INT(vehicle_train.SetSpeed * 1000.0);
set_lock := REAL_TO_INT(vehicle_train.SetLock * 5729.578);
)";

std::string hitch(std::size_t k) {
  return fmt::format("hitch_{}", k + 1);
}

std::string reset_block(const TrainProgramOptions& options) {
  return fmt::format("reset_{}", options.reset);
}

}  // namespace

std::vector<std::string> place_names(const std::vector<std::string>& places) {
  graphic::NameSet taken;
  for (const std::string_view each : block_names()) taken.insert(each);
  std::vector<std::string> names;
  for (const std::string& place : places)
    names.push_back(taken.unique(graphic::make_identifier("at_" + place)));
  return names;
}

std::string watch_type(const TrainWatch& watch) {
  return "TASK_" + watch.key;
}
std::string watch_instance(const TrainWatch& watch) {
  return "watch_" + watch.key;
}

std::vector<Variable> train_globals(const TrainProgramInput& input, const TrainTerminals& terminals,
                                    const TrainProgramOptions& options) {
  std::vector<Variable> all = {
      global_variable("x", "INT", "place by navigation, cm", terminals.x),
      global_variable("y", "INT", "place by navigation, cm", terminals.y),
      global_variable("heading", "INT", "by navigation, 0.01 degrees", terminals.heading),
      global_variable("speed", "INT", "of the wheels, mm/s", terminals.speed),
      global_variable("lock", "INT", "of the steering, 0.01 degrees", terminals.lock)};
  for (std::size_t k = 0; k < terminals.hitches.size(); ++k)
    all.push_back(global_variable(hitch(k), "INT", "angle of the hitch, 0.01 degrees", terminals.hitches[k]));
  all.push_back(global_variable("trailers", "INT", "how many are coupled", terminals.trailers));
  all.push_back(global_variable("bumper", "BOOL", "the train has met something", terminals.bumper));
  all.push_back(
      global_variable("estop_ok", "BOOL", "off while the emergency stop is pressed", terminals.estop_ok));
  all.push_back(global_variable("way_free", "BOOL", "off while something stands ahead", terminals.way_free));
  const std::vector<std::string> names = place_names(input.places);
  for (std::size_t k = 0; k < names.size(); ++k)
    all.push_back(global_variable(names[k], "BOOL", "the car is in " + input.places[k], terminals.at[k]));
  all.push_back(global_variable("set_speed", "INT", "mm/s", terminals.set_speed));
  all.push_back(global_variable("set_lock", "INT", "0.01 degrees", terminals.set_lock));
  all.push_back(global_variable("enable", "BOOL", "brakes off", terminals.enable));
  all.push_back(global_variable("vehicle_train", "VEHICLE_REF", "the train", {},
                                initial_of(*input.train, options.drive)));
  all.push_back(global_variable(kTaskState, "UINT", "of the task's automaton: " + input.watch->text, {},
                                std::to_string(input.watch->automaton.initial)));
  all.push_back(
      global_variable(kTaskVerdict, "INT", "of the task: 0 undecided, 1 done, 2 cannot be done any more"));
  all.push_back(global_variable("permitted", "REAL", "up to where it may drive along its way, m"));
  all.push_back(global_variable("allowed", "REAL", "the same, with what stands ahead"));
  all.push_back(global_variable("arc", "REAL", "how far it has come along its way, m"));
  for (const auto& [name, comment] : {std::pair("standing", "it stands"),
                                      {"seen", "something stands ahead that the way does not go round"},
                                      {"way_blocked", "something has stood in the way for a while"},
                                      {"at_rest", "it rests, brakes on"}})
    all.push_back(global_variable(name, "BOOL", comment));
  return all;
}

std::string train_sensing(const TrainProgramInput& input, const TrainProgramOptions& options) {
  std::string text = kSensing;
  const double most = options.fold_rad / 1.745329e-4;
  for (std::size_t k = 0; k < input.train->trailers; ++k)
    text += fmt::format(
        "IF ABS({}) > {} THEN\n  failed := MC_VehicleFail(ErrorID := 31, Vehicle := "
        "vehicle_train);\nEND_IF;\n",
        hitch(k), static_cast<int>(most));
  text += fmt::format(
      "seen := NOT way_free AND arc >= {};\nwait_blocked(IN := standing AND seen, PT := {});\n"
      "way_blocked := wait_blocked.Q;\n",
      real_literal(options.known_m), time_literal(options.blocked_after));
  const std::vector<std::string> names = place_names(input.places);
  std::string inputs;
  for (const std::string& name : names) inputs += (inputs.empty() ? "" : ", ") + name + " := " + name;
  const std::string watch = watch_instance(*input.watch);
  return text + fmt::format("{0}({1});\n{2} := {0}.State;\n{3} := {0}.Verdict;\n", watch, inputs, kTaskState,
                            kTaskVerdict);
}

std::vector<Variable> train_sensing_blocks(const TrainProgramInput& input) {
  return {instance("read_train", "MC_ReadVehicle"), instance("wait_blocked", "TON"),
          instance("failed", "BOOL"), instance(watch_instance(*input.watch), watch_type(*input.watch))};
}

std::string train_driving(const TrainProgramOptions& options, const std::string& path) {
  std::string text;
  if (options.reset != 0)
    text = fmt::format("{}(Execute := TRUE, Vehicle := vehicle_train);\n", reset_block(options));
  text += kDriving;
  text += path.empty() ? kStaying : fmt::format(kMoving, path);
  return text + kOutputs;
}

std::vector<Variable> train_driving_blocks(const TrainProgramOptions& options, const std::string& path) {
  std::vector<Variable> blocks;
  if (options.reset != 0) blocks.push_back(instance(reset_block(options), "MC_VehicleReset"));
  blocks.push_back(instance("power_train", "MC_VehiclePower"));
  blocks.push_back(path.empty() ? instance("stop_train", "MC_VehicleStop")
                                : instance("move_train", "MC_DrivePath"));
  blocks.push_back(instance("run_train", "MC_RunVehicle"));
  return blocks;
}

}  // namespace stepwright::ltl
