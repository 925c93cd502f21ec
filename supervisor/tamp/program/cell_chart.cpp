#include <fmt/format.h>

#include <utility>

#include "supervisor/tamp/program/arm_data.h"
#include "supervisor/tamp/program/arms_charts.h"
#include "supervisor/vehicle/chart_builder.h"
#include "supervisor/vehicle/literals.h"

namespace stepwright::tamp::program {
namespace {

using graphic::all;
using graphic::any;
using graphic::compare;
using graphic::CompareOp;
using graphic::Condition;
using graphic::contact;
using graphic::Qualifier;
using graphic::StepId;

constexpr const char* kSettled = "T#50ms";    // blocks have seen that nothing is commanded
constexpr const char* kAtRest = "T#200ms";    // of a halt
constexpr const char* kPowerWithin = "T#3s";  // drives are ready

constexpr std::pair<StopCause, const char*> kStops[] = {{StopCause::MissedGrasp, "MISSED_GRASP"},
                                                        {StopCause::LostGrasp, "LOST_GRASP"},
                                                        {StopCause::DriveFault, "DRIVE_FAULT"},
                                                        {StopCause::Interlock, "INTERLOCK"},
                                                        {StopCause::EmergencyStop, "EMERGENCY_STOP"},
                                                        {StopCause::NotAtStart, "NOT_AT_START"},
                                                        {StopCause::Refused, "REFUSED"},
                                                        {StopCause::Fingers, "FINGERS_STUCK"}};

class CellChartWriter {
 public:
  explicit CellChartWriter(const ProgramContext& context) : context_(context) {}

  ArmsChart build() {
    const StepId start = step({.name = "START", .kind = ArmsStepKind::Start}, "the program begins");
    chart_.action("BEGIN", beginning(), Qualifier::P1);
    switch (context_.input.kind) {
      case ArmsProgramKind::Follow:
        follow(start);
        break;
      case ArmsProgramKind::Halt:
        halt(start);
        break;
      case ArmsProgramKind::Observe:
        observe(start);
        break;
    }
    return {chart_.take(), std::move(made_)};
  }

 private:
  StepId step(ArmsStep info, std::string comment) {
    info.chart = kCellChart;
    const StepId made = chart_.step(info.name, std::move(comment));
    made_.push_back(std::move(info));
    return made;
  }
  static Condition after(const char* step, const char* time) {
    return compare(std::string(step) + ".T", CompareOp::GreaterEqual, time);
  }

  // What earlier programs have left in variables that this one reads.
  std::string beginning() const {
    std::string text;
    if (context_.takes_pictures()) text += "camera_reports := 0;\ncamera_row := 0;\n";
    if (!context_.follows()) text += "running := FALSE;\nwatched := FALSE;\n";
    if (context_.halts()) return text;
    text += "cause := 0;\ncause_arm := 0;\n";
    for (std::size_t arm = 0; arm < context_.arms(); ++arm) text += beginning_of(arm);
    return text;
  }

  // Whatever is held stays held, whether somebody knows of it or not.
  std::string keeping(const std::string& name) const {
    return fmt::format("wanted_{0} := SEL(grasp_{0}, width_{0}, MAX(0, width_{0} - {1}));\n", name,
                       tenths_mm(context_.options.squeeze_m));
  }

  std::string beginning_of(std::size_t arm) const {
    const std::string& name = context_.names[arm];
    std::string text = fmt::format(
        "path_{0} := 0;\nlast_{0} := 0;\narrived_{0} := 0;\nstep_{0} := 0;\nbase_{0} := 0.0;\nprogress_{0} "
        ":= "
        "0.0;\nwaiting_{0} := FALSE;\n",
        name);
    // What charts of an earlier program drove, and those of this one may not drive.
    for (const char* what : {"carrying", "gripping", "fingering", "align"})
      text += fmt::format("{}_{} := FALSE;\n", what, name);
    if (context_.observes()) {
      return text + keeping(name) + fmt::format("holds_{0} := SEL(grasp_{0}, 0, width_{0});\n", name) +
             held_text(context_, arm, std::nullopt);
    }
    const schedule::ArmSchedule& plan = context_.arm(arm);
    text += held_text(context_, arm, plan.held);
    if (plan.holds >= 0) {
      text += fmt::format("wanted_{0} := {1};\nholds_{0} := {2};\n", name, closing(context_, plan.holds),
                          width_of(context_, plan.holds));
    } else {
      text += fmt::format("{1}holds_{0} := 0;\n", name, keeping(name));
    }
    for (std::size_t j = 0; j < plan.start.size(); ++j)
      text += fmt::format("begin_{}[{}] := {};\n", name, j + 1, lreal_literal(plan.start[j]));
    return text;
  }

  void follow(StepId start) {
    const StepId power = step({.name = "POWER", .kind = ArmsStepKind::Start}, "the drives get ready");
    for (const char* what : {"power_on", "watched"}) chart_.drives(what);
    const StepId run = step({.name = "RUN", .kind = ArmsStepKind::Run}, "the arms are at work");
    for (const char* what : {"power_on", "watched", "running"}) chart_.drives(what);
    const StepId done = step({.name = "DONE", .kind = ArmsStepKind::Done}, "all arms are done");
    chart_.drives("power_on");
    chart_.transition(start, power, after("START", kSettled));
    std::vector<Condition> finished = {compare("cause", CompareOp::Equal, "0")};
    for (const std::string& name : context_.names) finished.push_back(contact("done_" + name));
    for (const auto& [cause, name] : kStops) {
      const StepId stopped =
          step({.name = name, .kind = ArmsStepKind::Stopped, .cause = cause}, name_of(cause));
      chart_.drives("power_on");
      const Condition seen = compare("cause", CompareOp::Equal, std::to_string(static_cast<int>(cause)));
      if (cause == StopCause::Refused) {
        chart_.action("REFUSED_POWER",
                      fmt::format("IF cause = 0 THEN\n  cause := {};\nEND_IF;\n", static_cast<int>(cause)),
                      Qualifier::P1);
        chart_.transition(power, stopped,
                          any({seen, all({after("POWER", kPowerWithin), contact("powered", true)})}));
      } else {
        chart_.transition(power, stopped, seen);
      }
      chart_.transition(run, stopped, seen);
    }
    chart_.transition(power, run, all({contact("powered"), after("POWER", kSettled), contact("at_rest")}));
    chart_.transition(run, done, all(std::move(finished)));
  }

  void halt(StepId start) {
    const StepId halt = step({.name = "HALT", .kind = ArmsStepKind::Halt}, "to rest on their paths");
    chart_.drives("halting");
    const StepId done = step({.name = "DONE", .kind = ArmsStepKind::Done}, "the arms stand");
    chart_.transition(start, halt, graphic::always());
    chart_.transition(halt, done, all({after("HALT", kAtRest), contact("at_rest")}));
  }

  void observe(StepId start) {
    const StepId look = step({.name = "OBSERVE", .kind = ArmsStepKind::Observe}, "the camera looks");
    chart_.drives("power_on");
    const StepId done = step({.name = "DONE", .kind = ArmsStepKind::Done}, "there are enough reports");
    chart_.drives("power_on");
    chart_.transition(start, look, after("START", kSettled));
    chart_.transition(
        look, done,
        compare("camera_reports", CompareOp::GreaterEqual, std::to_string(context_.options.reports)));
  }

  const ProgramContext& context_;
  vehicle::ChartBuilder chart_;
  std::vector<ArmsStep> made_;
};

// A report into the tables.
std::string reading(const ProgramContext& context) {
  std::string text;
  const std::size_t slots = context.terminals.slots.size();
  for (std::size_t s = 0; s < slots; ++s)
    for (const char* what : {"kind", "x", "y", "z", "yaw"})
      text += fmt::format("seen_{0}[camera_row * {1} + {2}] := slot_{3}_{0};\n", what, slots, s, s + 1);
  return text + fmt::format("camera_reports := camera_reports + 1;\ncamera_row := (camera_row + 1) MOD {};\n",
                            context.options.reports);
}

}  // namespace

ArmsChart cell_chart(const ProgramContext& context) {
  return CellChartWriter(context).build();
}

ArmsChart camera_chart(const ProgramContext& context) {
  vehicle::ChartBuilder chart;
  const auto after = [](const char* step, const std::string& time) {
    return compare(std::string(step) + ".T", CompareOp::GreaterEqual, time);
  };
  const std::string every =
      context.observes() ? std::string("T#30ms") : vehicle::time_literal(context.options.camera_every);
  const StepId idle = chart.step("IDLE", "until the next picture");
  const StepId picture = chart.step("PICTURE", "until it is reported");
  chart.drives("camera_trigger");
  chart.action("BEFORE", "camera_before := camera_pictures;\n", Qualifier::P1);
  const StepId read = chart.step("REPORT", "into the tables");
  chart.action("REPORTING", reading(context), Qualifier::P1);
  std::vector<Condition> next = {after("IDLE", every)};
  if (context.observes())
    next.push_back(compare("camera_reports", CompareOp::Less, std::to_string(context.options.reports)));
  chart.transition(idle, picture, all(std::move(next)));
  // The count of before is that of the scan in which the step began.
  chart.transition(
      picture, read,
      all({compare("camera_pictures", CompareOp::NotEqual, "camera_before"), after("PICTURE", "T#1ms")}));
  chart.transition(picture, idle, after("PICTURE", vehicle::time_literal(context.options.picture_within)));
  chart.transition(read, idle, graphic::always());
  return {chart.take(),
          {{.chart = kCameraChart, .name = "IDLE"},
           {.chart = kCameraChart, .name = "PICTURE"},
           {.chart = kCameraChart, .name = "REPORT"}}};
}

}  // namespace stepwright::tamp::program
