#include <fmt/format.h>

#include <utility>

#include "supervisor/tamp/program/arms_charts.h"
#include "supervisor/vehicle/chart_builder.h"

namespace stepwright::tamp::program {
namespace {

using graphic::all;
using graphic::compare;
using graphic::CompareOp;
using graphic::Condition;
using graphic::contact;
using graphic::StepId;
using schedule::ScheduledStep;
using schedule::StepKind;

ArmsStepKind kind_of_step(StepKind kind) {
  switch (kind) {
    case StepKind::Fingers:
      return ArmsStepKind::Fingers;
    case StepKind::Approach:
      return ArmsStepKind::Approach;
    case StepKind::Linear:
      return ArmsStepKind::Linear;
    case StepKind::Grip:
      return ArmsStepKind::Grip;
    case StepKind::Lift:
      return ArmsStepKind::Lift;
    case StepKind::Transfer:
      return ArmsStepKind::Transfer;
    case StepKind::Lower:
      return ArmsStepKind::Lower;
    case StepKind::Release:
      break;
  }
  return ArmsStepKind::Release;
}

const char* word_of(StepKind kind) {
  switch (kind) {
    case StepKind::Fingers:
      return "FINGERS";
    case StepKind::Approach:
      return "APPROACH";
    case StepKind::Linear:
      return "LINEAR";
    case StepKind::Grip:
      return "GRIP";
    case StepKind::Lift:
      return "LIFT";
    case StepKind::Transfer:
      return "TRANSFER";
    case StepKind::Lower:
      return "LOWER";
    case StepKind::Release:
      break;
  }
  return "RELEASE";
}

class ArmChartWriter {
 public:
  ArmChartWriter(const ProgramContext& context, std::size_t arm)
      : context_(context),
        arm_(arm),
        name_(context.names[arm]),
        chart_name_(std::string(kArmChart) + "_" + name_),
        steps_(context.arm(arm).steps) {}

  ArmsChart build() {
    StepId at = step({.name = "START", .kind = ArmsStepKind::Start}, "until the arms may work");
    Condition finished = contact("work");
    if (!steps_.empty()) {
      const StepId align =
          step({.name = "ALIGN", .kind = ArmsStepKind::Start}, "to where the schedule begins");
      chart_.drives("align_" + name_);
      chart_.transition(at, align, std::move(finished));
      at = align;
      finished = all({contact("work"), contact("aligned_" + name_)});
    }
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      at = waiting(k, at, finished);
      const StepId next = scheduled(k);
      chart_.transition(at, next, std::move(finished), comment_);
      at = next;
      finished = done_with(k);
    }
    const StepId done =
        step({.name = "DONE", .kind = ArmsStepKind::Done, .step = steps_.size()}, "all is done");
    chart_.action("DONE_HERE", text_of_place(steps_.size()));
    chart_.drives("done_" + name_);
    chart_.transition(at, done, std::move(finished));
    return {chart_.take(), std::move(made_)};
  }

 private:
  StepId step(ArmsStep info, std::string comment) {
    info.chart = chart_name_;
    info.arm = static_cast<int>(arm_);
    const StepId made = chart_.step(info.name, std::move(comment));
    made_.push_back(std::move(info));
    return made;
  }

  ArmsStep info_of(std::size_t k, std::string name) const {
    return {.chart = {},
            .name = std::move(name),
            .kind = kind_of_step(steps_[k].kind),
            .arm = 0,
            .action = steps_[k].action,
            .step = k};
  }

  std::string comment_of(std::size_t k) const {
    const ScheduledStep& what = steps_[k];
    std::string text = fmt::format("{} {}", context_.cell().arms[arm_].name, name_of(what.kind));
    if (what.thing >= 0) text += " " + context_.cell().things[static_cast<std::size_t>(what.thing)].name;
    return text;
  }

  // Where in the schedule the arm is, before it does anything of that step.
  std::string text_of_place(std::size_t k) const {
    return fmt::format("step_{0} := {1};\nbase_{0} := {2}.0;\npath_{0} := 0;\n", name_, k + 1, k);
  }

  bool holds_before(std::size_t k) const {
    return k == 0 ? context_.arm(arm_).holds >= 0
                  : schedule::carries(steps_[k - 1].kind) || steps_[k - 1].kind == StepKind::Grip;
  }

  // Where a step has to wait for the other arm before it begins, a step of its own: that the one before is
  // done has to be known meanwhile. `finished` is then what lets it go on.
  StepId waiting(std::size_t k, StepId at, Condition& finished) {
    comment_.clear();
    std::vector<Condition> conditions = {contact("work")};
    for (const schedule::Wait& each : steps_[k].waits) {
      if (!waits_at_start(steps_[k], each)) continue;
      const std::string& other = context_.names[each.other];
      conditions.push_back(
          compare("progress_" + other, CompareOp::GreaterEqual, progress_literal(each.progress)));
      comment_ = fmt::format("{} has come to {:.2f}", other, each.progress);
    }
    if (conditions.size() == 1) return at;
    const std::string name = fmt::format("W{:02}", k + 1);
    const StepId wait = step(info_of(k, name), "before: " + comment_of(k));
    chart_.action(name + "_HERE", text_of_place(k));
    if (holds_before(k)) chart_.drives("carrying_" + name_);
    chart_.transition(at, wait, std::move(finished));
    finished = all(std::move(conditions));
    return wait;
  }

  StepId scheduled(std::size_t k) {
    const ScheduledStep& what = steps_[k];
    const std::string name = fmt::format("S{:02}_{}", k + 1, word_of(what.kind));
    const StepId made = step(info_of(k, name), comment_of(k));
    std::string body = fmt::format("step_{0} := {1};\nbase_{0} := {2}.0;\n", name_, k + 1, k);
    body += fmt::format("path_{} := {};\n", name_, what.motion ? k + 1 : 0);
    if (what.kind == StepKind::Grip)
      body += fmt::format("wanted_{0} := {1};\nholds_{0} := {2};\n", name_, closing(context_, what.thing),
                          width_of(context_, what.thing)) +
              held_text(context_, arm_, what.held);
    if (what.kind == StepKind::Release) body += held_text(context_, arm_, std::nullopt);
    if (what.kind == StepKind::Fingers || what.kind == StepKind::Release)
      body += fmt::format("wanted_{0} := {1};\nholds_{0} := 0;\n", name_, tenths_mm(2.0 * what.half_open_m));
    chart_.action(name + "_DO", body);
    if (schedule::carries(what.kind)) chart_.drives("carrying_" + name_);
    if (what.kind == StepKind::Grip) chart_.drives("gripping_" + name_);
    if (what.kind == StepKind::Fingers || what.kind == StepKind::Release) chart_.drives("fingering_" + name_);
    return made;
  }

  Condition done_with(std::size_t k) const {
    const ScheduledStep& what = steps_[k];
    std::vector<Condition> conditions = {contact("work")};
    const auto here = std::to_string(k + 1);
    if (what.motion) {
      conditions.push_back(compare("arrived_" + name_, CompareOp::Equal, here));
      return all(std::move(conditions));
    }
    // The step's own action has run, and what the sensors say is of a scan behind it.
    conditions.push_back(compare("step_" + name_, CompareOp::Equal, here));
    conditions.push_back(contact((what.kind == StepKind::Grip ? "grasped_" : "open_") + name_));
    if (what.kind == StepKind::Release) conditions.push_back(contact("grasp_" + name_, true));
    return all(std::move(conditions));
  }

  const ProgramContext& context_;
  std::size_t arm_;
  const std::string& name_;
  std::string chart_name_;
  const std::vector<ScheduledStep>& steps_;
  vehicle::ChartBuilder chart_;
  std::vector<ArmsStep> made_;
  std::string comment_;  // of the transition into the next step
};

}  // namespace

ArmsChart arm_chart(const ProgramContext& context, std::size_t arm) {
  return ArmChartWriter(context, arm).build();
}

}  // namespace stepwright::tamp::program
