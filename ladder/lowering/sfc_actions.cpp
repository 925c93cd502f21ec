#include "ladder/lowering/sfc_actions.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace stepwright::lowering {
namespace {

using graphic::ActionBlock;
using graphic::CoilKind;
using graphic::Condition;
using graphic::Qualifier;
using graphic::StepId;

struct Association {
  StepId step;
  const ActionBlock* block;
};

// All action blocks with one target.
struct Target {
  std::string name;
  const graphic::Action* action = nullptr;  // nullptr: a BOOL variable
  std::size_t action_index = 0;             // of `action` in the chart
  std::vector<Association> associations;
};

std::vector<Target> targets_of(const graphic::SfcChart& chart) {
  std::vector<Target> bodies;
  for (std::size_t i = 0; i < chart.actions.size(); ++i) {
    bodies.push_back({chart.actions[i].name, &chart.actions[i], i, {}});
  }
  std::vector<Target> all;
  using Index = std::unordered_map<std::string, std::size_t>;  // in upper case -> place in its list
  Index of_bodies;
  Index of_variables;
  for (std::size_t i = 0; i < bodies.size(); ++i) of_bodies.try_emplace(graphic::upper(bodies[i].name), i);
  for (std::size_t i = 0; i < chart.steps.size(); ++i) {
    for (const ActionBlock& block : chart.steps[i].actions) {
      const std::string name = graphic::upper(block.target);
      const auto body = of_bodies.find(name);
      Target* found = body != of_bodies.end() ? &bodies[body->second] : nullptr;
      if (found == nullptr) {
        const auto [variable, is_new] = of_variables.try_emplace(name, all.size());
        if (is_new) all.push_back({block.target, nullptr, 0, {}});
        found = &all[variable->second];
      }
      found->associations.push_back({StepId(static_cast<std::uint32_t>(i)), &block});
    }
  }
  std::move(bodies.begin(), bodies.end(), std::back_inserter(all));
  return all;
}

// The rungs of one target.
class ActionControl {
 public:
  ActionControl(SfcLoweringContext& context, const Target& target) : context_(context), target_(target) {}

  // The rungs that decide whether the target is active.
  void control() {
    if (target_.associations.empty()) return;
    for (const Association& a : target_.associations) {
      if (a.block->qualifier == Qualifier::R) resets_.push_back(context_.active(a.step));
    }
    if (target_.action == nullptr && only_set_and_reset()) {
      set_and_reset(target_.name, set_condition());
      return;
    }
    if (const Condition set = set_condition(); set.kind != graphic::ConditionKind::True) {
      const std::string stored =
          context_.declare(target_.name + "_STORED", "BOOL", target_.name + " is set (qualifier S)");
      set_and_reset(stored, set);
      terms_.push_back(graphic::contact(stored));
    }
    for (const Association& a : target_.associations) associate(a);
    drive();
  }

  // The rung that runs the body.
  void execute() {
    if (!runs_) return;
    graphic::Rung rung;
    rung.comment = "Action " + target_.name;
    rung.condition = *runs_;
    graphic::Block block;
    block.st_body = context_.rewrite(target_.action->st_body);
    rung.blocks.push_back(std::move(block));
    context_.add(std::move(rung));
  }

 private:
  bool only_set_and_reset() const {
    return std::all_of(target_.associations.begin(), target_.associations.end(), [](const Association& a) {
      return a.block->qualifier == Qualifier::S || a.block->qualifier == Qualifier::R;
    });
  }

  // True (a closed wire) stands for "no step sets it".
  Condition set_condition() const {
    std::vector<Condition> sets;
    for (const Association& a : target_.associations) {
      if (a.block->qualifier == Qualifier::S) sets.push_back(context_.active(a.step));
    }
    return graphic::any(std::move(sets));
  }

  void associate(const Association& a) {
    const StepVariables& step = context_.steps()[a.step.value];
    switch (a.block->qualifier) {
      case Qualifier::N:
        terms_.push_back(context_.active(a.step));
        break;
      case Qualifier::P:
      case Qualifier::P1:
        pulses(a).push_back(graphic::all({context_.active(a.step), graphic::contact(step.was_active, true)}));
        break;
      case Qualifier::P0:
        pulses(a).push_back(graphic::all({context_.active(a.step, true), graphic::contact(step.was_active)}));
        break;
      case Qualifier::L:
        terms_.push_back(graphic::all(
            {context_.active(a.step), graphic::contact(timer(a, context_.active(a.step)), true)}));
        break;
      case Qualifier::D:
        terms_.push_back(graphic::contact(timer(a, context_.active(a.step))));
        break;
      case Qualifier::SD:
        terms_.push_back(graphic::contact(timer(a, latch(a, context_.active(a.step)))));
        break;
      case Qualifier::DS:
        terms_.push_back(latch(a, graphic::contact(timer(a, context_.active(a.step)))));
        break;
      case Qualifier::SL: {
        const Condition stored = latch(a, context_.active(a.step));
        terms_.push_back(graphic::all({stored, graphic::contact(timer(a, stored), true)}));
        break;
      }
      case Qualifier::S:
      case Qualifier::R:
        break;  // set_condition() and resets_
    }
  }

  std::string place(const Association& a) const {
    return context_.chart().steps[a.step.value].name + "_" + target_.name;
  }

  // An on-delay timer of this action block; returns its output, "NAME.Q".
  std::string timer(const Association& a, Condition input) {
    const std::string name = context_.declare(
        place(a) + "_TMR", "TON",
        std::string("time of ") + graphic::to_string(a.block->qualifier) + " action " + target_.name);
    graphic::Block block;
    block.type = "TON";
    block.instance = name;
    block.power_input = "IN";
    block.inputs.emplace_back("PT", context_.rewrite(a.block->duration));
    graphic::Rung rung;
    rung.comment = "Time of action block " + std::string(graphic::to_string(a.block->qualifier)) + " " +
                   target_.name + " of step " + context_.chart().steps[a.step.value].name;
    rung.condition = std::move(input);
    rung.blocks.push_back(std::move(block));
    context_.add(std::move(rung));
    return name + ".Q";
  }

  // A stored bit of this action block, which the R blocks of the target reset.
  Condition latch(const Association& a, Condition set) {
    const std::string name =
        context_.declare(place(a) + "_STORED", "BOOL",
                         std::string(graphic::to_string(a.block->qualifier)) + " action " + target_.name);
    set_and_reset(name, std::move(set));
    return graphic::contact(name);
  }

  // Reset last: it wins, as in the RS block of ACTION_CONTROL.
  void set_and_reset(const std::string& variable, Condition set) {
    if (set.kind != graphic::ConditionKind::True) {
      coil("Set " + variable, std::move(set), CoilKind::Set, variable);
    }
    if (!resets_.empty()) coil("Reset " + variable, graphic::any(resets_), CoilKind::Reset, variable);
  }

  void coil(std::string comment, Condition condition, CoilKind kind, const std::string& variable) {
    graphic::Rung rung;
    rung.comment = std::move(comment);
    rung.condition = std::move(condition);
    rung.coils.push_back({kind, variable});
    context_.add(std::move(rung));
  }

  // Where the pulse of P, P1 or P0 goes. With final scan P1 and P0 activate a body but not its flag Q
  // (2.6.4.5, notes 2 and 3); a BOOL variable has Q only.
  std::vector<Condition>& pulses(const Association& a) {
    const bool of_flag = a.block->qualifier == Qualifier::P || target_.action == nullptr;
    return of_flag || !context_.chart().final_scan ? terms_ : activations_;
  }

  // Any of these and no R block.
  Condition unless_reset(std::vector<Condition> any) const {
    std::vector<Condition> series{graphic::any(std::move(any))};
    for (Condition reset : resets_) {
      reset.negated = true;
      series.push_back(std::move(reset));
    }
    return graphic::all(std::move(series));
  }

  void drive() {
    if (terms_.empty() && activations_.empty()) return;
    if (target_.action == nullptr) {
      coil("Output " + target_.name, unless_reset(terms_), CoilKind::Normal, target_.name);
      return;
    }
    const ActionVariables& variables = context_.actions()[target_.action_index];
    if (variables.flag.empty()) {
      runs_ = unless_reset(terms_);
      return;
    }
    if (!terms_.empty()) {
      coil("Flag of action " + target_.name, unless_reset(terms_), CoilKind::Normal, variables.flag);
    }
    if (context_.chart().final_scan) activate(variables);
    runs_ = graphic::contact(variables.activation);
  }

  // A := Q or the falling edge of Q or a pulse: the body runs once more after the action has ended.
  void activate(const ActionVariables& variables) {
    std::vector<Condition> any{graphic::contact(variables.flag), graphic::contact(variables.was_active)};
    if (!activations_.empty()) any.push_back(unless_reset(activations_));
    coil("Activation of action " + target_.name, graphic::any(std::move(any)), CoilKind::Normal,
         variables.activation);
    coil("Remember " + variables.flag, graphic::contact(variables.flag), CoilKind::Normal,
         variables.was_active);
  }

  SfcLoweringContext& context_;
  const Target& target_;
  std::vector<Condition> terms_;        // any of them makes the action active
  std::vector<Condition> activations_;  // any of them runs the body without being its flag
  std::vector<Condition> resets_;       // contacts of the steps with an R block
  std::optional<Condition> runs_;       // when the body runs; empty if there is none or nothing runs it
};

}  // namespace

void lower_actions(SfcLoweringContext& context) {
  const std::vector<Target> targets = targets_of(context.chart());
  std::vector<ActionControl> controls;
  for (const Target& target : targets) controls.emplace_back(context, target);
  for (ActionControl& each : controls) each.control();
  for (ActionControl& each : controls) each.execute();
}

}  // namespace stepwright::lowering
