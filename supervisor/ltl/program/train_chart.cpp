#include "supervisor/ltl/program/train_chart.h"

#include <fmt/format.h>

#include <utility>

#include "supervisor/vehicle/chart_builder.h"
#include "supervisor/vehicle/literals.h"

namespace stepwright::ltl {
namespace {

using graphic::all;
using graphic::compare;
using graphic::CompareOp;
using graphic::Condition;
using graphic::contact;
using graphic::Qualifier;
using graphic::StepId;
using vehicle::real_literal;

constexpr double kArrived_m = 0.06;
constexpr const char* kSettled = "T#500ms";

// "press and rack_1"; "no place" where there is none.
std::string names_of(Label label, const std::vector<std::string>& places) {
  std::string text;
  for (std::size_t k = 0; k < places.size(); ++k)
    if ((label >> k & 1) != 0) text += (text.empty() ? "" : " and ") + places[k];
  return text.empty() ? "no place" : text;
}

class Writer {
 public:
  Writer(const TrainProgramInput& input, const TrainProgramOptions& options)
      : input_(input), options_(options) {}

  TrainChart build() {
    if (input_.kind == TrainProgramKind::Drive) {
      drive();
    } else {
      come_to_rest();
    }
    return {chart_.take(), std::move(steps_)};
  }

 private:
  StepId step(TrainStep info, std::string comment) {
    const StepId made = chart_.step(info.name, std::move(comment));
    steps_.push_back(std::move(info));
    return made;
  }

  static Condition in_state(std::uint32_t state) {
    return compare(kTaskState, CompareOp::Equal, std::to_string(state));
  }
  static Condition not_in_state(std::uint32_t state) {
    return compare(kTaskState, CompareOp::NotEqual, std::to_string(state));
  }
  static Condition at_least(const std::string& name, double value) {
    return compare(name, CompareOp::GreaterEqual, real_literal(value));
  }

  // The states that the plan goes through, and the labels that lead to them.
  std::vector<TrainStep> progress() const {
    const Automaton& automaton = input_.watch->automaton;
    std::vector<TrainStep> states = {{.name = {}, .kind = TrainStepKind::Drive, .state = automaton.initial}};
    for (const WayLabel& read : input_.way->labels) {
      const std::uint32_t next = automaton.next(states.back().state, read.label);
      if (next == states.back().state) continue;
      states.back().label = read.label;
      states.back().arc_m = read.arc_m;
      states.push_back({.name = {}, .kind = TrainStepKind::Drive, .state = next});
    }
    return states;
  }

  void drive() {
    std::vector<TrainStep> states = progress();
    const StepId start = step({.name = "START"}, "the way begins");
    chart_.action("BEGIN",
                  "vehicle_train.Arc := 0.0;\nvehicle_train.Point := 0;\nvehicle_train.Area := 0;\n"
                  "vehicle_train.Areas := 0;\npermitted := 0.0;\n",
                  Qualifier::P1);
    std::vector<StepId> steps;
    for (std::size_t k = 0; k < states.size(); ++k) {
      TrainStep info = states[k];
      const bool last = k + 1 == states.size();
      info.kind = last ? TrainStepKind::Arrive : TrainStepKind::Drive;
      info.name = last ? "ARRIVE" : fmt::format("S{:02}_STATE_{}", k + 1, info.state);
      if (last) info.arc_m = input_.way->end_m;
      const std::string comment =
          last ? "the task is done; to the end of the way" : "to " + names_of(info.label, input_.places);
      const std::string name = info.name;
      steps.push_back(step(std::move(info), comment));
      chart_.action(name + "_GO", fmt::format("permitted := {};\n", real_literal(input_.way->end_m)));
    }
    const StepId done =
        step({.name = "DONE", .kind = TrainStepKind::Done, .state = states.back().state}, "the train stands");
    chart_.drives("at_rest");
    const StepId blocked =
        step({.name = "BLOCKED", .kind = TrainStepKind::Blocked}, "something stands in the way");
    chart_.action("BLOCKED_STOP", "permitted := 0.0;\n");
    const StepId deviated =
        step({.name = "DEVIATED", .kind = TrainStepKind::Deviated}, "the task is elsewhere than planned");
    chart_.action("DEVIATED_STOP", "permitted := 0.0;\n");
    chart_.transition(start, steps.front(), graphic::always());
    for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
      chart_.transition(steps[k], steps[k + 1], in_state(states[k + 1].state),
                        "at " + names_of(states[k].label, input_.places));
      chart_.transition(steps[k], deviated, not_in_state(states[k].state));
      chart_.transition(steps[k], blocked, contact("way_blocked"));
    }
    chart_.transition(steps.back(), done,
                      all({at_least("arc", input_.way->end_m - kArrived_m), contact("standing")}));
    chart_.transition(steps.back(), done, contact("way_blocked"), "near enough: the task is done");
  }

  // As far as it takes to brake along the way, or nowhere.
  void come_to_rest() {
    const bool moves = input_.kind == TrainProgramKind::Halt;
    const StepId start = step({.name = "START", .kind = TrainStepKind::Halt}, "to rest");
    if (moves) {
      chart_.action(
          "BEGIN",
          fmt::format("permitted := MIN({}, arc + vehicle_train.Speed * vehicle_train.Speed / {} + 0.4 * "
                      "ABS(vehicle_train.Speed));\n",
                      real_literal(input_.way->end_m), real_literal(2.0 * options_.drive.brake_m_s2)),
          Qualifier::P1);
    } else {
      chart_.drives("at_rest");
    }
    const StepId done = step({.name = "DONE", .kind = TrainStepKind::Done}, "the train stands");
    chart_.drives("at_rest");
    chart_.transition(start, done,
                      all({compare("START.T", CompareOp::GreaterEqual, kSettled), contact("standing")}));
  }

  const TrainProgramInput& input_;
  const TrainProgramOptions& options_;
  vehicle::ChartBuilder chart_;
  std::vector<TrainStep> steps_;
};

}  // namespace

TrainChart train_chart(const TrainProgramInput& input, const TrainProgramOptions& options) {
  return Writer(input, options).build();
}

}  // namespace stepwright::ltl
