// What can be said of a binding by the domain alone.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cell/binding/check_binding.h"
#include "cell/binding/ground_actions.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::cell_binding {
namespace {

using pddl::ChangeKind;
using pddl::GroundActionInfo;
using result::Diagnostics;
using result::Severity;
using translate::ActionBinding;
using translate::Binding;

constexpr std::size_t kMostCombinations = 20'000;

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

// The innermost "(name argument ...)" of a condition.
std::set<std::string> atoms_in(const std::string& text) {
  std::set<std::string> atoms;
  std::size_t open = std::string::npos;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') open = i;
    if (text[i] != ')' || open == std::string::npos) continue;
    atoms.insert(text.substr(open, i - open + 1));
    open = std::string::npos;
  }
  return atoms;
}

bool matches(const translate::Pattern& pattern, const translate::Pattern& atom) {
  return translate::match(pattern, {atom.name, atom.arguments}).has_value();
}

// The lowest and highest value that its counts, or its own range, let a sensor show.
std::pair<double, double> shown_by(const Binding& binding, const translate::Sensor& sensor) {
  const bool is_unsigned = binding.tag(sensor.tag)->type == "UINT";
  double a = sensor.calibration.value_at(is_unsigned ? 0.0 : -32768.0);
  double b = sensor.calibration.value_at(is_unsigned ? 65535.0 : 32767.0);
  if (a > b) std::swap(a, b);
  if (sensor.range) {
    a = std::max(a, sensor.range->first);
    b = std::min(b, sensor.range->second);
  }
  return {a, b};
}

class ActionCheck {
 public:
  ActionCheck(const pddl::Task& task, const Binding& binding)
      : task_(task), binding_(binding), ground_(ground_actions(task, kMostCombinations)) {}

  Diagnostics run() {
    for (const ActionBinding& entry : binding_.actions) check_outputs(entry);
    for (const GroundActionInfo& info : ground_.actions) {
      translate::Assignment assignment;
      const ActionBinding* const entry = binding_.action_for(info.action, assignment);
      if (entry == nullptr) continue;
      check_completion(info, *entry, assignment);
      check_hold(info, *entry, assignment);
      check_timeout(info, *entry, assignment);
    }
    check_believed();
    return std::move(problems_);
  }

 private:
  // One of a kind for each entry: its actions differ in their objects only.
  void add(const char* code, const ActionBinding& entry, std::string message, std::string hint,
           Severity severity = Severity::Error) {
    if (!told_.emplace(code, entry.where.line).second) return;
    problems_.push_back({code, severity, entry.where, std::move(message), std::move(hint)});
  }

  void check_outputs(const ActionBinding& entry) {
    if (!entry.outputs.empty() || entry.names_outputs) return;
    add("B0010", entry, translate::to_string(entry.pattern) + " drives no output: nothing makes it happen",
        "outputs = [\"...\"]; outputs = [] says that it waits for what happens by itself", Severity::Warning);
  }

  static const pddl::Change* change_of(const GroundActionInfo& info, const std::string& atom, bool fact) {
    for (const pddl::Change& change : info.changes) {
      const bool right = fact ? change.kind == ChangeKind::Add
                              : change.kind != ChangeKind::Add && change.kind != ChangeKind::Delete;
      if (right && change.target == atom) return &change;
    }
    return nullptr;
  }

  static bool needs(const GroundActionInfo& info, const std::string& fact) {
    return std::ranges::any_of(info.preconditions, [&](const pddl::Requirement& each) {
      return each.kind == pddl::RequirementKind::Fact && each.positive && each.fact == fact;
    });
  }

  void check_completion(const GroundActionInfo& info, const ActionBinding& entry,
                        const translate::Assignment& assignment) {
    const std::string atom = translate::instantiate(entry.completion.atom, assignment);
    const std::string who = model::to_string(info.action);
    const bool fact = entry.completion.kind == translate::CompletionKind::Fact;
    if (fact ? binding_.observed(atom) == nullptr : binding_.sensor_of(atom) == nullptr) {
      return add(
          "B0014", entry, who + " ends with " + atom + ", which no sensor shows",
          fact ? "[[facts]] with fact = \"" + atom + "\"" : "[sensors.NAME] with fluent = \"" + atom + "\"");
    }
    const pddl::Change* const change = change_of(info, atom, fact);
    if (change == nullptr && !(fact && needs(info, atom))) {
      return add("B0014", entry,
                 who + " ends with " + atom + ", which it does not " + (fact ? "bring about" : "change"),
                 fact ? "'until' names a fact that is true after the action"
                      : "'until' names a fluent that the action changes");
    }
    if (!fact) check_reach(info, entry, *change, atom);
  }

  // A level that its sensor cannot show.
  void check_reach(const GroundActionInfo& info, const ActionBinding& entry, const pddl::Change& change,
                   const std::string& atom) {
    if (change.amount.kind != pddl::NumericKind::Constant) return;
    const auto [low, high] = shown_by(binding_, *binding_.sensor_of(atom));
    const double amount = change.amount.constant;
    const bool assigned = change.kind == ChangeKind::Assign;
    const bool added = change.kind == ChangeKind::Increase || change.kind == ChangeKind::Decrease;
    const bool beyond = assigned ? amount < low - 1e-9 || amount > high + 1e-9
                                 : added && std::abs(amount) > high - low + 1e-9;
    if (!beyond) return;
    add("B0014", entry,
        fmt::format("{} ends with {} {} {}, and its sensor shows {} to {} only",
                    model::to_string(info.action), atom, assigned ? "at" : "changed by", number(amount),
                    number(low), number(high)),
        "another goal of the action in the domain, or the range and calibration of the sensor");
  }

  void check_hold(const GroundActionInfo& info, const ActionBinding& entry,
                  const translate::Assignment& assignment) {
    for (const translate::Pattern& pattern : entry.hold) {
      const std::string atom = translate::instantiate(pattern, assignment);
      const bool undone = std::ranges::any_of(info.changes, [&](const pddl::Change& change) {
        return change.kind == ChangeKind::Delete && change.target == atom && change.when.empty();
      });
      if (undone)
        add("B0014", entry, model::to_string(info.action) + " holds " + atom + ", which it undoes itself",
            "'hold' names what stays true until the action has ended");
    }
  }

  // By the entry's own nominal duration, where the amount is known.
  void check_timeout(const GroundActionInfo& info, const ActionBinding& entry,
                     const translate::Assignment& assignment) {
    double nominal_s = entry.duration.fixed_s;
    if (entry.duration.of)
      nominal_s +=
          entry.duration.per_unit_s * amount_of(info, translate::instantiate(*entry.duration.of, assignment));
    const double timeout_s = std::chrono::duration<double>(entry.timeout).count();
    if (nominal_s <= timeout_s) return;
    add("B0015", entry,
        fmt::format("{} takes {} s by its own duration, and counts as failed after {} s",
                    model::to_string(info.action), number(nominal_s), number(timeout_s)),
        fmt::format("timeout_s = {}", number(std::ceil(1.5 * nominal_s))));
  }

  // By how much a fluent changes, or what it is where nothing changes it; 0 where that depends on the state.
  double amount_of(const GroundActionInfo& info, const std::string& fluent) const {
    for (const pddl::Change& change : info.changes) {
      if (change.target != fluent) continue;
      const bool added = change.kind == ChangeKind::Increase || change.kind == ChangeKind::Decrease;
      return added && change.amount.kind == pddl::NumericKind::Constant ? std::abs(change.amount.constant)
                                                                        : 0.0;
    }
    if (changed_by_any(fluent)) return 0.0;
    return std::abs(task_.initial().value(fluent).value_or(0.0));
  }

  bool changed_by_any(const std::string& atom) const {
    return std::ranges::any_of(ground_.actions, [&](const auto& info) { return info.writes.contains(atom); });
  }

  bool is_transferred(const translate::Pattern& atom) const {
    for (const ActionBinding& entry : binding_.actions) {
      for (const translate::Transfer& transfer : entry.transfers)
        if (transfer.to.name == atom.name && transfer.to.arguments.size() == atom.arguments.size())
          return true;
    }
    return false;
  }

  bool is_shown(const std::string& text, const translate::Pattern& atom) const {
    if (binding_.observed(text) != nullptr || binding_.sensor_of(text) != nullptr || is_transferred(atom))
      return true;
    return std::ranges::any_of(binding_.believed, [&](const auto& each) { return matches(each, atom); });
  }

  // What actions change and others, or the goal, rely on, without anything that shows it.
  void check_believed() {
    std::set<std::string> changed;
    std::map<std::string, std::string> needed_by;
    for (const std::string& goal : task_.goals())
      for (const std::string& atom : atoms_in(goal)) needed_by.emplace(atom, "the goal");
    for (const GroundActionInfo& info : ground_.actions) {
      changed.insert(info.writes.begin(), info.writes.end());
      for (const std::string& atom : info.reads)
        if (!info.counts.contains(atom)) needed_by.emplace(atom, "'" + info.action.name + "'");
    }
    std::set<std::string> told;
    for (const auto& [text, whose] : needed_by) {
      const auto atom = translate::parse_pattern(text);
      if (!atom || !changed.contains(text) || is_shown(text, *atom) || !told.insert(atom->name).second)
        continue;
      translate::Pattern general{atom->name, {}};
      for (std::size_t i = 1; i <= atom->arguments.size(); ++i)
        general.arguments.push_back("?p" + std::to_string(i));
      problems_.push_back({"B0012",
                           Severity::Warning,
                           {binding_.file, 0, 0},
                           "no sensor shows " + text + ", which actions change and " + whose + " needs",
                           "a sensor or switch for it, 'transfers', or believed = [\"" +
                               translate::to_string(general) + "\"]: the plan's own word is taken"});
    }
  }

  const pddl::Task& task_;
  const Binding& binding_;
  GroundActions ground_;
  std::set<std::pair<std::string, std::uint32_t>> told_;
  Diagnostics problems_;
};

}  // namespace

Diagnostics check_actions(const pddl::Task& task, const Binding& binding) {
  return ActionCheck(task, binding).run();
}

}  // namespace stepwright::cell_binding
