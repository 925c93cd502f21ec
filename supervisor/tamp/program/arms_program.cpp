#include "supervisor/tamp/program/arms_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "supervisor/tamp/program/arm_data.h"
#include "supervisor/tamp/program/arms_charts.h"
#include "supervisor/tamp/program/arms_texts.h"
#include "supervisor/vehicle/news_chart.h"
#include "supervisor/vehicle/project_parts.h"

namespace stepwright::tamp::program {
namespace {

constexpr const char* kTask = "arms";
constexpr double kMostAngle_rad = 3.2;       // terminals count 0.0001 rad in 16 bits
constexpr double kRoom_m = 0.01;             // between what the plan comes to and what the interlock goes by
constexpr std::size_t kMostData = 8u << 20;  // bytes

class ArmsProjectWriter {
 public:
  explicit ArmsProjectWriter(ProgramContext context) : context_(std::move(context)) {}

  result::Result<ArmsProgram> write() {
    graphic::Project& project = made_.project;
    project.name = kTask;
    if (!context_.observes()) add_paths();
    if (made_.size.data_bytes > kMostData)
      return result::fail("G0305", {}, fmt::format("paths of {} bytes", made_.size.data_bytes),
                          "shorter plans, or fewer rows for each motion");
    std::vector<graphic::Variable> globals = arms_globals(context_);
    globals.insert(globals.end(), std::make_move_iterator(project.globals.begin()),
                   std::make_move_iterator(project.globals.end()));
    project.globals = std::move(globals);
    // Charts see what the sensors say in their own scan; what they command is done in it.
    vehicle::add_text(project, kTask, "sensing", sensing_text(context_), sensing_blocks(context_));
    add_chart(kCellChart, cell_chart(context_));
    if (context_.follows())
      for (std::size_t arm = 0; arm < context_.arms(); ++arm)
        add_chart(std::string(kArmChart) + "_" + context_.names[arm], arm_chart(context_, arm));
    if (context_.takes_pictures()) add_chart(kCameraChart, camera_chart(context_));
    vehicle::add_text(project, kTask, "moving", moving_text(context_), moving_blocks(context_));
    vehicle::add_chart(project, kTask, "news", vehicle::news_chart(context_.options.news_every));
    project.tasks = {{kTask, context_.options.interval_us, 0}};
    made_.min_distance_m = context_.min_distance_m;
    made_.variables = variables();
    return std::move(made_);
  }

 private:
  void add_chart(const std::string& name, ArmsChart chart) {
    for (ArmsStep& each : chart.steps) made_.steps.push_back(std::move(each));
    vehicle::add_chart(made_.project, kTask, name, std::move(chart.chart));
  }

  void add_paths() {
    for (std::size_t arm = 0; arm < context_.arms(); ++arm) {
      const auto& steps = context_.arm(arm).steps;
      context_.paths.emplace_back(steps.size());
      for (std::size_t k = 0; k < steps.size(); ++k) {
        if (!steps[k].motion) continue;
        const motion::MotionTable& table = steps[k].motion->table;
        PathData data = path_data(fmt::format("{}_{}", context_.names[arm], k + 1), table,
                                  fmt::format("{} {}", context_.names[arm], name_of(steps[k].kind)));
        context_.paths[arm][k] = {data.path.name, data.points.name, data.rows.name};
        ++made_.size.paths;
        made_.size.points += table.places.size();
        made_.size.rows += table.rows();
        made_.size.most_rows = std::max(made_.size.most_rows, table.rows());
        for (graphic::Variable* each : {&data.path, &data.points, &data.rows})
          made_.project.globals.push_back(std::move(*each));
      }
    }
    made_.size.data_bytes = kWayPointBytes * made_.size.points + kTimeRowBytes * made_.size.rows;
  }

  ArmsVariables variables() const {
    ArmsVariables all;
    for (const std::string& name : context_.names) {
      ArmVariables one;
      for (int k = 1; k <= 7; ++k) one.joints.push_back(fmt::format("joint_{}_{}", name, k));
      for (int k = 1; k <= 7; ++k) one.angles.push_back(fmt::format("pos_{}_{}", name, k));
      one.width = "opening_" + name;
      one.opening = "width_" + name;
      one.progress = "progress_" + name;
      one.state = "state_" + name;
      one.error = "error_" + name;
      one.failed_joint = "group_" + name + ".FailedJoint";
      one.failed_at = "group_" + name + ".FailedAt";
      one.failed_by = "group_" + name + ".FailedBy";
      one.standing = "standing_" + name;
      one.waiting = "waiting_" + name;
      one.grasped = "grasped_" + name;
      one.grip_seen = "grasp_" + name;
      all.arms.push_back(std::move(one));
    }
    CameraVariables& camera = all.camera;
    camera.seen = "camera_seen";
    for (std::size_t s = 1; s <= context_.terminals.slots.size(); ++s) {
      camera.kind.push_back(fmt::format("slot_{}_kind", s));
      camera.x.push_back(fmt::format("slot_{}_x", s));
      camera.y.push_back(fmt::format("slot_{}_y", s));
      camera.z.push_back(fmt::format("slot_{}_z", s));
      camera.yaw.push_back(fmt::format("slot_{}_yaw", s));
    }
    if (!context_.takes_pictures()) return all;
    camera.reports = "camera_reports";
    camera.kept = context_.options.reports;
    camera.all_kind = "seen_kind";
    camera.all_x = "seen_x";
    camera.all_y = "seen_y";
    camera.all_z = "seen_z";
    camera.all_yaw = "seen_yaw";
    return all;
  }

  ProgramContext context_;
  ArmsProgram made_;
};

result::Result<void> check_terminals(const scene::RobotCell& cell, const CellTerminals& terminals) {
  const auto missing = [](const std::string& name) {
    return result::fail("G0301", {}, "there is no terminal for " + name,
                        "each terminal of a robot cell needs an address");
  };
  if (terminals.arms.size() != cell.arms.size()) return missing("each arm");
  for (std::size_t arm = 0; arm < cell.arms.size(); ++arm) {
    const ArmTerminals& each = terminals.arms[arm];
    const std::string of = " of " + cell.arms[arm].name;
    for (std::size_t j = 0; j < each.pos.size(); ++j)
      if (each.pos[j].empty() || each.set[j].empty()) return missing("joint " + std::to_string(j + 1) + of);
    const std::pair<const char*, const std::string*> named[] = {
        {"width", &each.width}, {"ready", &each.ready}, {"trip", &each.trip},
        {"grasp", &each.grasp}, {"grip", &each.grip},   {"enable", &each.enable}};
    for (const auto& [name, address] : named)
      if (address->empty()) return missing(name + of);
  }
  for (const auto& [name, address] : {std::pair("estop_ok", &terminals.estop_ok),
                                      {"camera_trigger", &terminals.camera_trigger},
                                      {"camera_pictures", &terminals.camera_pictures},
                                      {"camera_seen", &terminals.camera_seen}})
    if (address->empty()) return missing(name);
  if (terminals.slots.empty()) return missing("a slot of the camera");
  return {};
}

result::Result<void> check_figures(const ArmsProgramOptions& options) {
  const std::pair<const char*, double> figures[] = {{"interval_us", static_cast<double>(options.interval_us)},
                                                    {"min_distance_m", options.min_distance_m},
                                                    {"following_rad", options.following_rad},
                                                    {"start_rad", options.start_rad},
                                                    {"squeeze_m", options.squeeze_m},
                                                    {"width_m", options.width_m},
                                                    {"reports", static_cast<double>(options.reports)}};
  for (const auto& [name, value] : figures)
    if (!(std::isfinite(value) && value > 0.0))
      return result::fail("G0302", {}, fmt::format("{} is {}, not above zero", name, value));
  if (!(options.lead_s >= 0.0 && options.lead_s <= 1.0))
    return result::fail("G0302", {}, "lead_s is 0 to 1 s");
  for (const double each : options.brake_rad_s2)
    if (!(std::isfinite(each) && each > 0.0))
      return result::fail("G0302", {}, fmt::format("a brake_rad_s2 is {}, not above zero", each));
  if (options.reports > 100) return result::fail("G0302", {}, "more than 100 reports of the camera");
  return {};
}

result::Result<void> check_schedule(const scene::RobotCell& cell, const schedule::CellSchedule& made) {
  if (made.arms.size() != cell.arms.size())
    return result::fail("G0302", {}, "the schedule is of another cell: it has another number of arms");
  for (std::size_t arm = 0; arm < made.arms.size(); ++arm)
    for (const schedule::ScheduledStep& step : made.arms[arm].steps) {
      if (!step.motion) continue;
      for (const motion::Configuration& each : step.motion->path.points()) {
        const bool counts =
            std::ranges::all_of(each, [](double value) { return std::abs(value) <= kMostAngle_rad; });
        if (!counts || !cell.arms[arm].chain.within_limits(each, 1e-6))
          return result::fail("G0304", {},
                              cell.arms[arm].name + ", " + name_of(step.kind) +
                                  ": an angle beyond the joint's limits or what terminals can say");
      }
    }
  return {};
}

}  // namespace

const char* name_of(StopCause cause) {
  switch (cause) {
    case StopCause::None:
      return "none";
    case StopCause::MissedGrasp:
      return "missed grasp";
    case StopCause::LostGrasp:
      return "lost grasp";
    case StopCause::DriveFault:
      return "drive fault";
    case StopCause::Interlock:
      return "arms too near to each other";
    case StopCause::EmergencyStop:
      return "emergency stop";
    case StopCause::NotAtStart:
      return "an arm is not where its schedule begins";
    case StopCause::Refused:
      return "a command was refused";
    case StopCause::Fingers:
      break;
  }
  return "fingers do not come to their opening";
}

int width_of(const ProgramContext& context, int thing) {
  return tenths_mm(2.0 * context.cell().grip_m(thing));
}
int closing(const ProgramContext& context, int thing) {
  return std::max(0, width_of(context, thing) - tenths_mm(context.options.squeeze_m));
}

std::string held_text(const ProgramContext& context, std::size_t arm,
                      const std::optional<schedule::Capsule>& held) {
  if (context.bodies.empty()) return {};
  const std::string model = "model_" + context.names[arm];
  const std::size_t own = context.bodies[arm].capsules.size();
  return held ? with_held_text(model, own, *held) : without_held_text(model, own);
}

std::string progress_literal(double progress) {
  return lreal_literal(std::round(1e6 * progress) / 1e6);
}

bool waits_at_start(const schedule::ScheduledStep& step, const schedule::Wait& wait) {
  if (!step.motion || wait.at <= 0.0) return true;
  constexpr double kReaction_s = 0.1;
  return wait.at * step.duration_s <=
         0.55 * step.motion->table.override_rates.stopping_time_s() + kReaction_s;
}

result::Result<ArmsProgram> arms_program(const ArmsProgramInput& input, const CellTerminals& terminals,
                                         const ArmsProgramOptions& options) {
  if (auto good = check_figures(options); !good) return result::forward(good);
  if (auto good = check_terminals(*input.cell, terminals); !good) return result::forward(good);
  ProgramContext context{.input = input, .terminals = terminals, .options = options};
  context.min_distance_m = options.min_distance_m;
  if (input.kind != ArmsProgramKind::Observe) {
    if (auto good = check_schedule(*input.cell, *input.schedule); !good) return result::forward(good);
    context.min_distance_m = std::min(options.min_distance_m, input.schedule->nearest_m - kRoom_m);
    if (context.min_distance_m < kLeastDistance_m)
      return result::fail(
          "G0303", {},
          fmt::format("the plan brings the arms to {:.0f} mm of each other", 1e3 * input.schedule->nearest_m),
          "another plan, or an arm that moves away first");
  }
  for (std::size_t arm = 0; context.arms() == 2 && arm < 2; ++arm) {
    context.bodies.push_back(schedule::arm_capsules(*input.cell, arm));
    if (context.bodies.back().capsules.size() >= kMostCapsules)
      return result::fail(
          "G0302", {},
          fmt::format("the interlock has {} capsules for an arm and what it holds: the {} arm alone has {}",
                      kMostCapsules, input.cell->arms[arm].name, context.bodies.back().capsules.size()));
  }
  graphic::NameSet taken;
  for (const scene::ArmModel& arm : input.cell->arms)
    context.names.push_back(taken.unique(graphic::make_identifier(arm.name)));
  return ArmsProjectWriter(std::move(context)).write();
}

}  // namespace stepwright::tamp::program
