#include "supervisor/tamp/program/arms_texts.h"

#include <fmt/format.h>

#include <utility>

#include "supervisor/tamp/program/arm_data.h"
#include "supervisor/tamp/schedule/schedule_plan.h"
#include "supervisor/vehicle/literals.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::tamp::program {
namespace {

using graphic::Variable;
using vehicle::global_variable;
using vehicle::instance;
using vehicle::time_literal;

constexpr int kJoints = 7;
constexpr int kOpenNear = 10;  // 0.1 mm: fingers are where they shall be

// `{0}` is the arm.
constexpr const char* kSensing = R"(group_{0}.DriveFault := trip_{0};
group_{0}.SafetyOk := estop_ok;
opening_{0} := INT_TO_LREAL(width_{0}) * 0.0001;
held_{0} := grasp_{0} AND (ABS(width_{0} - holds_{0}) <= {1});
hold_time_{0}(IN := (holds_{0} > 0) AND held_{0}, PT := {2});
grasped_{0} := hold_time_{0}.Q;
open_{0} := ABS(width_{0} - wanted_{0}) <= {3};
)";
constexpr const char* kWatching =
    R"(miss_time_{0}(IN := gripping_{0} AND NOT grasped_{0}, PT := {1});
lose_time_{0}(IN := carrying_{0} AND NOT held_{0}, PT := {2});
finger_time_{0}(IN := fingering_{0} AND NOT open_{0}, PT := {3});
)";

// Stops on the way before a lock that is not open: a stop takes half of its time on the path, or all of it
// where the rate still rises.
constexpr const char* kWaiting =
    R"(reach_{0} := group_{0}.Time + {1} + group_{0}.StopTime * SEL(group_{0}.Slope > 0.0, 0.55 * group_{0}.Rate, 1.0);
waiting_{0} := (limit_{0} < 1.0E8) AND (waiting_{0} OR ((group_{0}.Motion = mcAlongPath) AND (reach_{0} >= limit_{0})));
speed_block_{0}(Enable := TRUE, VelFactor := SEL(waiting_{0}, LIMIT(0.0, operator_speed, 1.0), 0.0), AxesGroup := group_{0});
align_block_{0}(Execute := align_{0}, Position := begin_{0}, VelFactor := 0.1, AccFactor := 0.2, JerkFactor := 0.2,
                AxesGroup := group_{0});
aligned_{0} := align_block_{0}.Done;
)";
constexpr const char* kBegins =
    R"(moving_{0} := (path_{0} > 0) AND (path_{0} = last_{0}) AND (move_{0}.Busy OR move_{0}.Done OR NOT pausing);
)";
constexpr const char* kArrives = R"(IF (path_{0} > 0) AND (path_{0} = last_{0}) THEN
  IF move_{0}.Done THEN
    arrived_{0} := path_{0};
    progress_{0} := MAX(progress_{0}, base_{0} + 1.0);
  ELSIF group_{0}.Motion = mcAlongPath THEN
    progress_{0} := MAX(progress_{0}, base_{0} + MIN(0.999999, group_{0}.Time / group_{0}.End));
  END_IF;
END_IF;
progress_{0} := MAX(progress_{0}, base_{0});
last_{0} := path_{0};
)";
constexpr const char* kPausing = R"(pause_{0}(Execute := pausing, AxesGroup := group_{0});
resume_{0}(Execute := NOT pausing AND group_{0}.Interrupted, AxesGroup := group_{0});
)";
constexpr const char* kOutputs = R"(enable_{0} := group_{0}.DriveOn;
grip_{0} := wanted_{0};
state_{0} := group_{0}.State;
standing_{0} := group_{0}.Standing;
)";

std::string filled(const char* text, const std::string& name) {
  return fmt::format(fmt::runtime(text), name);
}

// "a AND b"
std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& each : parts) text += (text.empty() ? "" : between) + each;
  return text;
}

std::string group_figures(const ProgramContext& context, std::size_t arm) {
  GroupFigures figures;
  figures.following_rad = context.options.following_rad;
  const scene::ArmModel& model = context.cell().arms[arm];
  const schedule::ScheduleOptions standard;
  const bool known = context.input.schedule != nullptr;
  for (std::size_t j = 0; j < static_cast<std::size_t>(kJoints); ++j) {
    const auto& joint = model.chain.joints()[j];
    figures.lower.push_back(joint.lower);
    figures.upper.push_back(joint.upper);
    if (known) {
      figures.velocity.push_back(context.input.schedule->limits.velocity[j]);
      figures.acceleration.push_back(context.input.schedule->stop.acceleration[j]);
      figures.jerk.push_back(context.input.schedule->stop.jerk[j]);
    } else {
      figures.velocity.push_back(
          standard.velocity_share *
          context.cell().robot.coordinates[static_cast<std::size_t>(joint.coordinate)].velocity_per_s);
      figures.acceleration.push_back(standard.stop_acceleration * standard.limits.acceleration[j]);
      figures.jerk.push_back(standard.stop_jerk * standard.limits.jerk[j]);
    }
  }
  return group_literal(figures);
}

void add_arm_globals(const ProgramContext& context, std::size_t arm, std::vector<Variable>& all) {
  const std::string& name = context.names[arm];
  const ArmTerminals& terminals = context.terminals.arms[arm];
  const auto add = [&](const std::string& what, const char* type, const char* comment,
                       const std::string& address = {}, const std::string& initial = {}) {
    all.push_back(global_variable(what + "_" + name, type, comment, address, initial));
  };
  for (int k = 0; k < kJoints; ++k) {
    const auto j = static_cast<std::size_t>(k);
    all.push_back(
        global_variable(fmt::format("pos_{}_{}", name, k + 1), "INT", "angle, 0.0001 rad", terminals.pos[j]));
    all.push_back(global_variable(fmt::format("set_{}_{}", name, k + 1), "INT", "wanted angle, 0.0001 rad",
                                  terminals.set[j]));
    all.push_back(
        global_variable(fmt::format("joint_{}_{}", name, k + 1), "LREAL", "angle as measured, rad"));
  }
  add("width", "INT", "opening of the hand, 0.1 mm", terminals.width);
  add("ready", "BOOL", "enabled and not tripped", terminals.ready);
  add("trip", "BOOL", "a drive has tripped", terminals.trip);
  add("grasp", "BOOL", "the fingers press on something", terminals.grasp);
  add("grip", "INT", "wanted opening, 0.1 mm", terminals.grip);
  add("enable", "BOOL", "brakes off", terminals.enable);
  add("group", "AXES_GROUP", "the joints", {}, group_figures(context, arm));
  if (!context.bodies.empty())
    add("model", "ARM_MODEL", "bodies, for the interlock", {}, arm_model_literal(context.bodies[arm]));
  add("begin", "MC_JOINTS", "where the schedule begins");
  add("opening", "LREAL", "of the hand as measured, m");
  add("progress", "LREAL", "steps that are finished, and the share of the one that is not");
  add("base", "LREAL", "steps that are finished");
  add("state", "MC_GROUP_STATE", "of the joints' group");
  add("error", "UINT", "of the joints' group, or of the block that refused a command");
  for (const auto& [what, comment] : {std::pair("standing", "set points do not change"),
                                      {"waiting", "it waits for the other arm on its path"},
                                      {"held", "something of the right width is held"},
                                      {"grasped", "it has been held for a while"},
                                      {"open", "the fingers are where they shall be"},
                                      {"gripping", "the fingers close"},
                                      {"carrying", "something has to be held"},
                                      {"fingering", "the fingers go to another opening"},
                                      {"align", "to where the schedule begins"},
                                      {"aligned", "it is there"},
                                      {"done", "all steps are done"},
                                      {"off", "it is not where the schedule begins"},
                                      {"moving", "its motion is commanded"}})
    add(what, "BOOL", comment);
  for (const auto& [what, comment] : {std::pair("path", "number of the path that it shall go along; 0: none"),
                                      {"last", "the same, a scan before"},
                                      {"arrived", "number of the path that it has come to the end of"},
                                      {"step", "number of its step"},
                                      {"wanted", "opening of the fingers, 0.1 mm"},
                                      {"holds", "width of what is held, 0.1 mm; 0: nothing"}})
    add(what, "INT", comment);
  add("limit", "LREAL", "time on the path up to which it may go, s");
  add("reach", "LREAL", "time on the path before which it cannot stop, s");
}

void add_camera_globals(const ProgramContext& context, std::vector<Variable>& all) {
  const CellTerminals& terminals = context.terminals;
  all.push_back(global_variable("camera_pictures", "INT", "reports so far", terminals.camera_pictures));
  all.push_back(global_variable("camera_seen", "INT", "objects in the last one", terminals.camera_seen));
  all.push_back(global_variable("camera_trigger", "BOOL", "takes a picture when it comes on",
                                terminals.camera_trigger));
  for (std::size_t s = 0; s < terminals.slots.size(); ++s) {
    const SlotTerminals& slot = terminals.slots[s];
    for (const auto& [what, address] :
         {std::pair("kind", &slot.kind), {"x", &slot.x}, {"y", &slot.y}, {"z", &slot.z}, {"yaw", &slot.yaw}})
      all.push_back(
          global_variable(fmt::format("slot_{}_{}", s + 1, what), "INT", "of the last report", *address));
  }
  if (!context.takes_pictures()) return;
  all.push_back(global_variable("camera_reports", "INT", "since this program began"));
  all.push_back(global_variable("camera_before", "INT", "reports before the picture"));
  all.push_back(global_variable("camera_row", "INT", "where the next report goes"));
  const std::size_t count = context.options.reports * terminals.slots.size();
  for (const char* what : {"kind", "x", "y", "z", "yaw"})
    all.push_back(global_variable(fmt::format("seen_{}", what), fmt::format("ARRAY[0..{}] OF INT", count - 1),
                                  "of the latest reports, slot by slot"));
}

// What keeps an arm from going on, or has to end all: conditions and their causes, the first one counts.
std::string cause_text(const ProgramContext& context) {
  std::string text =
      fmt::format("IF watched AND (cause = 0) THEN\n  IF NOT estop_ok THEN\n    cause := {};\n",
                  static_cast<int>(StopCause::EmergencyStop));
  const auto add = [&](const char* condition, StopCause cause) {
    for (std::size_t arm = 0; arm < context.arms(); ++arm)
      text += fmt::format("  ELSIF {} THEN\n    cause := {};\n    cause_arm := {};\n",
                          filled(condition, context.names[arm]), static_cast<int>(cause),
                          cause == StopCause::Interlock ? 0 : arm + 1);
  };
  const std::string failed = "(group_{0}.State = mcGroupErrorStop) AND ";
  add((failed + "(group_{0}.ErrorID = 33)").c_str(), StopCause::Interlock);
  add(("trip_{0} OR (" + failed + "((group_{0}.ErrorID = 7) OR (group_{0}.ErrorID = 8)))").c_str(),
      StopCause::DriveFault);
  if (context.follows()) {
    add("lose_time_{0}.Q", StopCause::LostGrasp);
    add("miss_time_{0}.Q", StopCause::MissedGrasp);
    add("finger_time_{0}.Q", StopCause::Fingers);
    add("off_{0} AND NOT running", StopCause::NotAtStart);
    add("(error_{0} <> 0)", StopCause::Refused);
  }
  return text + "  END_IF;\nEND_IF;\n";
}

std::string limit_text(const ProgramContext& context, std::size_t arm) {
  const std::string& name = context.names[arm];
  std::string cases;
  const std::vector<schedule::ScheduledStep>& steps = context.arm(arm).steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    std::string rules;
    for (const schedule::Wait& each : steps[k].waits) {
      if (waits_at_start(steps[k], each)) continue;
      rules +=
          fmt::format("    {} progress_{} < {} THEN\n      limit_{} := {};\n", rules.empty() ? "IF" : "ELSIF",
                      context.names[each.other], progress_literal(each.progress), name,
                      lreal_literal(each.at * steps[k].duration_s));
    }
    if (!rules.empty()) cases += fmt::format("  {}:\n{}    END_IF;\n", k + 1, rules);
  }
  const std::string begin = fmt::format("limit_{} := 1.0E9;\n", name);
  return cases.empty() ? begin : begin + fmt::format("CASE path_{} OF\n{}END_CASE;\n", name, cases);
}

std::string move_text(const ProgramContext& context, std::size_t arm) {
  const std::string& name = context.names[arm];
  std::string cases;
  for (std::size_t k = 0; k < context.paths[arm].size(); ++k) {
    const PathNames& path = context.paths[arm][k];
    if (path.empty()) continue;
    cases += fmt::format(
        "  {}: move_{}(Execute := moving_{}, Path := {}, Points := {}, Rows := {}, AxesGroup := group_{});\n",
        k + 1, name, name, path.path, path.points, path.rows, name);
  }
  return cases.empty() ? std::string() : fmt::format("CASE last_{} OF\n{}END_CASE;\n", name, cases);
}

bool has_paths(const ProgramContext& context, std::size_t arm) {
  if (context.observes()) return false;
  for (const PathNames& each : context.paths[arm])
    if (!each.empty()) return true;
  return false;
}

std::string command_text(const ProgramContext& context, std::size_t arm) {
  const std::string& name = context.names[arm];
  std::string text;
  if (context.options.reset != 0)
    text +=
        fmt::format("reset_{0}_{1}(Execute := TRUE, AxesGroup := group_{1});\n", context.options.reset, name);
  if (context.observes() && !context.options.standing_enabled)
    return text + filled("disable_{0}(Execute := TRUE, AxesGroup := group_{0});\n", name);
  if (!context.halts())
    text += filled("enable_block_{0}(Execute := power_on, AxesGroup := group_{0});\n", name);
  text += filled("stop_{0}(Execute := halting, AxesGroup := group_{0});\n", name);
  if (context.observes()) return text;
  text += limit_text(context, arm);
  text += fmt::format(fmt::runtime(kWaiting), name,
                      lreal_literal(3e-6 * static_cast<double>(context.options.interval_us)));
  if (has_paths(context, arm))
    text += filled(kBegins, name) + move_text(context, arm) + filled(kArrives, name);
  if (context.follows()) text += filled(kPausing, name);
  return text;
}

// A drive whose position loop has a gain of 1 / lead follows an even motion late by that time, as long as it
// is so slow that it could brake within it; a faster one by what it needs to brake.
std::string set_point_text(const ArmsProgramOptions& options, const std::string& name, int joint) {
  const double brake = options.brake_rad_s2[static_cast<std::size_t>(joint - 1)];
  const double lead_s = options.lead_s;
  if (lead_s == 0.0)
    return fmt::format("set_{0}_{1} := LREAL_TO_INT(group_{0}.SetPosition[{1}] * 10000.0);\n", name, joint);
  return fmt::format(
      "speed := group_{0}.SetVelocity[{1}];\nahead := SEL(ABS(speed) > {2}, {3} * speed, speed * ABS(speed) "
      "* {4} + "
      "SEL(speed < 0.0, {5}, -{5}));\nset_{0}_{1} := LREAL_TO_INT((group_{0}.SetPosition[{1}] + ahead) * "
      "10000.0);\n",
      name, joint, lreal_literal(brake * lead_s), lreal_literal(lead_s), lreal_literal(0.5 / brake),
      lreal_literal(0.5 * brake * lead_s * lead_s));
}

std::string output_text(const ProgramContext& context, std::size_t arm) {
  const std::string& name = context.names[arm];
  std::string text = filled("run_{0}(AxesGroup := group_{0});\n", name);
  for (int k = 1; k <= kJoints; ++k) text += set_point_text(context.options, name, k);
  text += filled(kOutputs, name);
  // What a block has refused stays to be read until the next program begins.
  text += filled("IF group_{0}.ErrorID <> 0 THEN\n  error_{0} := group_{0}.ErrorID;\n", name);
  if (has_paths(context, arm))
    text += filled("ELSIF moving_{0} AND move_{0}.Error THEN\n  error_{0} := move_{0}.ErrorID;\n", name);
  if (context.follows())
    text += filled(
        "ELSIF align_{0} AND align_block_{0}.Error THEN\n  error_{0} := align_block_{0}.ErrorID;\n", name);
  text += filled("ELSIF cause = 0 THEN\n  error_{0} := 0;\nEND_IF;\n", name);
  return text;
}

}  // namespace

std::vector<Variable> arms_globals(const ProgramContext& context) {
  std::vector<Variable> all;
  for (std::size_t arm = 0; arm < context.arms(); ++arm) add_arm_globals(context, arm, all);
  all.push_back(global_variable("estop_ok", "BOOL", "off while the emergency stop is pressed",
                                context.terminals.estop_ok));
  add_camera_globals(context, all);
  all.push_back(global_variable("operator_hold", "BOOL", "people: both arms stand on their paths"));
  all.push_back(
      global_variable("operator_speed", "LREAL", "people: 0 to 1 of the planned velocities", {}, "1.0"));
  all.push_back(global_variable("operator_release", "BOOL", "people: arms that are too near may move apart"));
  all.push_back(global_variable("cause", "INT", "why it was stopped; 0: it was not"));
  all.push_back(global_variable("cause_arm", "INT", "which arm it was, from 1"));
  all.push_back(global_variable("arms_distance", "LREAL", "of the arms as measured, m"));
  all.push_back(global_variable("arms_room", "LREAL", "the least of it if both braked now, m"));
  for (const auto& [name, comment] : {std::pair("at_rest", "no arm moves"),
                                      {"power_on", "the drives are wanted"},
                                      {"powered", "all arms have power and stand by"},
                                      {"running", "the arms are at work"},
                                      {"watched", "what goes wrong ends the program"},
                                      {"work", "steps may be taken"},
                                      {"pausing", "the arms stand on their paths"},
                                      {"halting", "to rest"}})
    all.push_back(global_variable(name, "BOOL", comment));
  return all;
}

std::string sensing_text(const ProgramContext& context) {
  const ArmsProgramOptions& options = context.options;
  std::string text;
  for (std::size_t arm = 0; arm < context.arms(); ++arm) {
    const std::string& name = context.names[arm];
    std::vector<std::string> off;
    for (int k = 1; k <= kJoints; ++k) {
      text += fmt::format(
          "joint_{0}_{1} := INT_TO_LREAL(pos_{0}_{1}) * 0.0001;\ngroup_{0}.ActualPosition[{1}] := "
          "joint_{0}_{1};\n",
          name, k);
      off.push_back(fmt::format("(ABS(joint_{0}_{1} - begin_{0}[{1}]) > {2})", name, k,
                                lreal_literal(options.start_rad)));
    }
    text += fmt::format(fmt::runtime(kSensing), name, tenths_mm(options.width_m),
                        time_literal(options.grip_after), kOpenNear);
    if (!context.follows()) continue;
    text += fmt::format(fmt::runtime(kWatching), name, time_literal(options.grip_within),
                        time_literal(options.lost_after), time_literal(options.fingers_within));
    // An arm that has nothing to do has to be where the other one's paths count on it, too; and what an
    // earlier program has left here says nothing of this one.
    text += fmt::format("off_{} := {};\n", name, joined(off, "\n  OR "));
  }
  return text + cause_text(context) + "work := running AND NOT operator_hold AND (cause = 0);\n";
}

std::vector<Variable> sensing_blocks(const ProgramContext& context) {
  std::vector<Variable> blocks;
  for (const std::string& name : context.names) {
    blocks.push_back(instance("hold_time_" + name, "TON"));
    if (!context.follows()) continue;
    for (const char* what : {"miss_time_", "lose_time_", "finger_time_"})
      blocks.push_back(instance(what + name, "TON"));
  }
  return blocks;
}

std::string moving_text(const ProgramContext& context) {
  std::string text = context.follows() ? "pausing := operator_hold OR (cause <> 0);\n" : "pausing := TRUE;\n";
  for (std::size_t arm = 0; arm < context.arms(); ++arm) text += command_text(context, arm);
  if (context.arms() == 2)
    text += fmt::format(
        "watch_arms(MinDistance := {0}, Release := operator_release, FirstArm := model_{1}, SecondArm := "
        "model_{2}, FirstGroup := group_{1}, SecondGroup := group_{2});\narms_distance := "
        "watch_arms.Distance;\narms_room := watch_arms.Room;\n",
        lreal_literal(context.min_distance_m), context.names[0], context.names[1]);
  std::vector<std::string> rest, powered;
  for (std::size_t arm = 0; arm < context.arms(); ++arm) {
    text += output_text(context, arm);
    rest.push_back("standing_" + context.names[arm]);
    powered.push_back(filled("ready_{0} AND ((state_{0} = mcGroupStandby) OR (state_{0} = mcGroupMoving))",
                             context.names[arm]));
  }
  return text + "at_rest := " + joined(rest, " AND ") + ";\npowered := " + joined(powered, "\n  AND ") +
         ";\n";
}

std::vector<Variable> moving_blocks(const ProgramContext& context) {
  std::vector<Variable> blocks;
  const auto add = [&](const std::string& name, const char* type) { blocks.push_back(instance(name, type)); };
  for (std::size_t arm = 0; arm < context.arms(); ++arm) {
    const std::string& name = context.names[arm];
    if (context.options.reset != 0)
      add(fmt::format("reset_{}_{}", context.options.reset, name), "MC_GroupReset");
    add("run_" + name, "MC_RunAxesGroup");
    if (context.observes() && !context.options.standing_enabled) {
      add("disable_" + name, "MC_GroupDisable");
      continue;
    }
    if (!context.halts()) add("enable_block_" + name, "MC_GroupEnable");
    add("stop_" + name, "MC_GroupStop");
    if (context.observes()) continue;
    add("speed_block_" + name, "MC_GroupSetOverride");
    add("align_block_" + name, "MC_MoveDirectAbsolute");
    if (has_paths(context, arm)) add("move_" + name, "MC_MovePath");
    if (!context.follows()) continue;
    add("pause_" + name, "MC_GroupInterrupt");
    add("resume_" + name, "MC_GroupContinue");
  }
  if (context.arms() == 2) add("watch_arms", "MC_WatchDistance");
  if (context.options.lead_s != 0.0)
    for (const char* what : {"speed", "ahead"}) add(what, "LREAL");
  return blocks;
}

}  // namespace stepwright::tamp::program
