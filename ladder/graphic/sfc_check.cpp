// The invariants of a chart; see sfc_chart.h.

#include <algorithm>
#include <numeric>
#include <optional>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_chart.h"
#include "ladder/graphic/sfc_codes.h"

namespace stepwright::graphic {
namespace {

using result::Diagnostics;

class Checker {
 public:
  explicit Checker(const SfcChart& chart) : chart_(chart) {}

  Diagnostics run() {
    steps();
    actions();
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) transition(i);
    if (found_.empty()) networks();
    return std::move(found_);
  }

 private:
  void add(const char* code, const result::Location& where, std::string message, std::string hint = {}) {
    found_.push_back({code, result::Severity::Error, where, std::move(message), std::move(hint)});
  }

  std::string step_name(std::size_t index) const {
    const std::string& name = chart_.steps[index].name;
    return "step " + (name.empty() ? "number " + std::to_string(index + 1) : "'" + name + "'");
  }

  std::string transition_name(std::size_t index) const {
    const std::string& name = chart_.transitions[index].name;
    return "transition " + (name.empty() ? "number " + std::to_string(index + 1) : "'" + name + "'");
  }

  void steps() {
    NameSet names;
    bool initial = false;
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const Step& step = chart_.steps[i];
      initial = initial || step.initial;
      if (!is_identifier(step.name) || is_keyword(step.name)) {
        add(code::kBadName, step.where, step_name(i) + " has no legal name",
            "a name is a letter, then letters, digits and single underscores, and no keyword");
      } else if (!names.insert(step.name)) {
        add(code::kNameTwice, step.where, "two steps have the name '" + step.name + "'",
            "names are case-insensitive");
      }
      for (const ActionBlock& block : step.actions) action_block(i, block);
    }
    if (!initial)
      add(code::kNoInitialStep, {}, "the chart has no initial step",
          "mark the step that is active at the start");
  }

  // 2.6.2: each network has exactly one initial step. Steps are of one network if transitions connect them.
  void networks() {
    std::vector<std::uint32_t> above(chart_.steps.size());
    std::iota(above.begin(), above.end(), 0U);
    const auto root = [&](std::uint32_t step) {
      while (above[step] != step) step = above[step] = above[above[step]];
      return step;
    };
    for (const Transition& each : chart_.transitions) {
      for (const std::vector<StepId>* ends : {&each.sources, &each.targets})
        for (const StepId id : *ends) above[root(id.value)] = root(each.sources.front().value);
    }
    std::vector<std::optional<std::size_t>> initial(chart_.steps.size());  // by network
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      if (!chart_.steps[i].initial) continue;
      std::optional<std::size_t>& first = initial[root(static_cast<std::uint32_t>(i))];
      if (first) initial_twice(*first, i);
      if (!first) first = i;
    }
  }

  void initial_twice(std::size_t first, std::size_t second) {
    add(code::kInitialTwice, chart_.steps[second].where,
        step_name(first) + " and " + step_name(second) + " are both initial, and transitions connect them",
        "a network has one initial step; where both branches start at once, let one initial step be left by "
        "a "
        "transition TO (" +
            chart_.steps[first].name + ", " + chart_.steps[second].name + ")");
  }

  void action_block(std::size_t step, const ActionBlock& block) {
    const std::string place = std::string("action block ") + to_string(block.qualifier) + " '" +
                              block.target + "' of " + step_name(step);
    if (block.target.empty())
      add(code::kNoTarget, block.where, place + " drives nothing", "name a BOOL variable or an action");
    if (needs_duration(block.qualifier) && block.duration.empty()) {
      add(code::kNoDuration, block.where, place + " has no duration",
          "L, D, SD, DS and SL take one, such as T#2s");
    }
    if (!needs_duration(block.qualifier) && !block.duration.empty()) {
      add(code::kDurationUnused, block.where,
          place + " has the duration '" + block.duration + "' that its qualifier does not take",
          "remove it, or use L, D, SD, DS or SL");
    }
  }

  void actions() {
    NameSet names;
    for (const Action& action : chart_.actions) {
      if (!is_identifier(action.name) || is_keyword(action.name)) {
        add(code::kBadName, action.where, "action '" + action.name + "' has no legal name");
      } else if (!names.insert(action.name)) {
        add(code::kNameTwice, action.where, "two actions have the name '" + action.name + "'",
            "names are case-insensitive");
      }
    }
  }

  void transition(std::size_t index) {
    const Transition& transition = chart_.transitions[index];
    const std::string place = transition_name(index);
    if (!transition.name.empty()) {
      if (!is_identifier(transition.name) || is_keyword(transition.name)) {
        add(code::kBadName, transition.where, place + " has no legal name");
      } else if (!transition_names_.insert(transition.name)) {
        add(code::kNameTwice, transition.where, "two transitions have the name '" + transition.name + "'",
            "names are case-insensitive");
      }
    }
    ends(transition, place, "source", transition.sources);
    ends(transition, place, "target", transition.targets);
    condition(transition, place, transition.condition);
  }

  void ends(const Transition& owner, const std::string& place, const char* what,
            const std::vector<StepId>& ids) {
    if (ids.empty()) add(code::kMissingEnd, owner.where, place + " has no " + what + " step");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i].value >= chart_.steps.size()) {
        add(code::kUnknownStep, owner.where,
            place + " has a " + what + " step number " + std::to_string(ids[i].value + 1) +
                ", but the chart has " + std::to_string(chart_.steps.size()) + " steps");
      } else if (std::find(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(i), ids[i]) !=
                 ids.begin() + static_cast<std::ptrdiff_t>(i)) {
        add(code::kStepTwice, owner.where,
            place + " names " + step_name(ids[i].value) + " twice as a " + what);
      }
    }
  }

  void condition(const Transition& owner, const std::string& place, const Condition& node) {
    const bool named = node.kind == ConditionKind::Contact || node.kind == ConditionKind::Comparison ||
                       node.kind == ConditionKind::Expression;
    if (named && node.name.empty())
      add(code::kBadCondition, owner.where, "the condition of " + place + " tests nothing");
    if (node.kind == ConditionKind::Comparison && node.operand.empty()) {
      add(code::kBadCondition, owner.where,
          "the condition of " + place + " compares '" + node.name + "' with nothing");
    }
    const bool group = node.kind == ConditionKind::All || node.kind == ConditionKind::Any;
    if (group && node.children.empty())
      add(code::kBadCondition, owner.where, "the condition of " + place + " has an empty group");
    for (const Condition& child : node.children) condition(owner, place, child);
  }

  const SfcChart& chart_;
  Diagnostics found_;
  NameSet transition_names_;
};

}  // namespace

Diagnostics check(const SfcChart& chart) {
  return Checker(chart).run();
}

}  // namespace stepwright::graphic
