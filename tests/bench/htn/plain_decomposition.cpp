#include "tests/bench/htn/plain_decomposition.h"

#include <algorithm>
#include <functional>
#include <set>

namespace stepwright::bench {
namespace {

using htn::Condition;
using htn::ConditionKind;
using htn::object_of;

using Binding = std::vector<int>;
using Row = std::vector<int>;

constexpr std::size_t kMostSteps = 1500;

struct Pending {
  bool primitive = false;
  int symbol = 0;
  Row objects;
};

class Plain {
 public:
  Plain(const htn::PlanningTask& task, std::chrono::steady_clock::time_point until)
      : task_(task), until_(until), facts_(task.predicates.size()) {
    for (const htn::GroundAtom& fact : task.facts)
      facts_[static_cast<std::size_t>(fact.symbol)].insert(fact.objects);
  }

  PlainAnswer run() {
    std::vector<Pending> network{{false, static_cast<int>(task_.tasks.size()) - 1, {}}};
    answer_.solved = seek(network);
    return std::move(answer_);
  }

 private:
  bool late() {
    if (++looks_ % 256 == 0 && std::chrono::steady_clock::now() >= until_) late_ = true;
    return late_;
  }

  // Of a network whose first task is at the end; it is as before where there is no plan.
  bool seek(std::vector<Pending>& network) {
    // Deeper recursion needs more stack than a thread has.
    if (late() || answer_.steps.size() > kMostSteps || depth_ > 2 * kMostSteps) return false;
    if (network.empty()) {
      Binding binding(static_cast<std::size_t>(task_.goal_slots), -1);
      return holds(task_.goal, binding);
    }
    const Pending first = network.back();
    network.pop_back();
    ++depth_;
    const bool found = first.primitive ? act(first, network) : decompose(first, network);
    --depth_;
    if (!found) network.push_back(first);
    return found;
  }

  bool act(const Pending& step, std::vector<Pending>& network) {
    const htn::Action& action = task_.actions[static_cast<std::size_t>(step.symbol)];
    Binding binding(static_cast<std::size_t>(action.slots), -1);
    std::ranges::copy(step.objects, binding.begin());
    if (!holds(action.condition, binding)) return false;
    std::vector<std::pair<int, Row>> added, deleted;
    for (const htn::Effect& effect : action.effects) {
      each(effect.variables, 0, binding, [&] {
        if (!holds(effect.condition, binding)) return;
        (effect.add ? added : deleted).emplace_back(effect.predicate, row(effect.terms, binding));
      });
    }
    std::vector<std::pair<int, Row>> gone, came;
    for (auto& [predicate, objects] : deleted)
      if (facts_[static_cast<std::size_t>(predicate)].erase(objects) != 0)
        gone.emplace_back(predicate, objects);
    for (auto& [predicate, objects] : added)
      if (facts_[static_cast<std::size_t>(predicate)].insert(objects).second)
        came.emplace_back(predicate, objects);
    answer_.steps.push_back(text_of(action.name, step.objects));
    if (seek(network)) return true;
    answer_.steps.pop_back();
    for (auto& [predicate, objects] : came) facts_[static_cast<std::size_t>(predicate)].erase(objects);
    for (auto& [predicate, objects] : gone) facts_[static_cast<std::size_t>(predicate)].insert(objects);
    return false;
  }

  bool decompose(const Pending& compound, std::vector<Pending>& network) {
    for (const int number : task_.tasks[static_cast<std::size_t>(compound.symbol)].methods) {
      const htn::Method& method = task_.methods[static_cast<std::size_t>(number)];
      Binding binding(static_cast<std::size_t>(method.slots), -1);
      if (!bind(method, compound.objects, binding)) continue;
      const std::size_t rest = network.size();
      const bool found = match(method.condition.parts, 0, binding, [&] {
        return each_until(method.parameters, 0, binding, [&] {
          ++answer_.decompositions;
          for (std::size_t i = method.subtasks.size(); i-- > 0;) {
            const htn::Subtask& subtask = method.subtasks[i];
            network.push_back({subtask.primitive, subtask.symbol, row(subtask.terms, binding)});
          }
          const bool good = fits(method, binding) && seek(network);
          if (!good) network.resize(rest);
          return good;
        });
      });
      if (found) return true;
    }
    return false;
  }

  bool fits(const htn::Method& method, Binding& binding) {
    return std::ranges::all_of(method.condition.parts,
                               [&](const Condition& part) { return holds(part, binding); });
  }

  bool bind(const htn::Method& method, const Row& objects, Binding& binding) const {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const htn::Term term = method.task_terms[i];
      if (term >= 0 && binding[static_cast<std::size_t>(term)] < 0)
        binding[static_cast<std::size_t>(term)] = objects[i];
      if (object_of(term, binding) != objects[i]) return false;
    }
    return true;
  }

  // Positive atoms bind their variables, from the left to the right.
  bool match(const std::vector<Condition>& parts, std::size_t from, Binding& binding,
             const std::function<bool()>& then) {
    while (from < parts.size() && parts[from].kind != ConditionKind::Atom) ++from;
    if (from == parts.size()) return then();
    const Condition& atom = parts[from];
    const std::set<Row> rows = facts_[static_cast<std::size_t>(atom.symbol)];
    for (const Row& objects : rows) {
      if (late()) return false;
      const Binding before = binding;
      bool good = true;
      for (std::size_t i = 0; i < objects.size() && good; ++i) {
        const htn::Term term = atom.terms[i];
        if (term >= 0 && binding[static_cast<std::size_t>(term)] < 0)
          binding[static_cast<std::size_t>(term)] = objects[i];
        good = object_of(term, binding) == objects[i];
      }
      if (good && match(parts, from + 1, binding, then)) return true;
      binding = before;
    }
    return false;
  }

  // The objects of what is not bound yet.
  bool each_until(const std::vector<htn::Variable>& variables, std::size_t from, Binding& binding,
                  const std::function<bool()>& visit) {
    while (from < variables.size() && binding[static_cast<std::size_t>(variables[from].slot)] >= 0) ++from;
    if (from == variables.size()) return visit();
    for (const int object : task_.types[static_cast<std::size_t>(variables[from].type)].objects) {
      if (late()) return false;
      binding[static_cast<std::size_t>(variables[from].slot)] = object;
      if (each_until(variables, from + 1, binding, visit)) return true;
    }
    binding[static_cast<std::size_t>(variables[from].slot)] = -1;
    return false;
  }

  void each(const std::vector<htn::Variable>& variables, std::size_t from, Binding& binding,
            const std::function<void()>& visit) {
    if (from == variables.size()) return visit();
    for (const int object : task_.types[static_cast<std::size_t>(variables[from].type)].objects) {
      binding[static_cast<std::size_t>(variables[from].slot)] = object;
      each(variables, from + 1, binding, visit);
    }
  }

  bool holds(const Condition& condition, Binding& binding) {
    switch (condition.kind) {
      case ConditionKind::Atom:
        return facts_[static_cast<std::size_t>(condition.symbol)].contains(row(condition.terms, binding));
      case ConditionKind::Equal:
        return object_of(condition.terms[0], binding) == object_of(condition.terms[1], binding);
      case ConditionKind::OfType:
        return task_.is_of_type(object_of(condition.terms[0], binding), condition.symbol);
      case ConditionKind::And:
        return std::ranges::all_of(condition.parts,
                                   [&](const Condition& part) { return holds(part, binding); });
      case ConditionKind::Or:
        return std::ranges::any_of(condition.parts,
                                   [&](const Condition& part) { return holds(part, binding); });
      case ConditionKind::Not:
        return !holds(condition.parts[0], binding);
      case ConditionKind::Imply:
        return !holds(condition.parts[0], binding) || holds(condition.parts[1], binding);
      case ConditionKind::Forall:
      case ConditionKind::Exists:
        break;
    }
    bool all = true, any = false;
    each(condition.variables, 0, binding, [&] {
      const bool here = holds(condition.parts[0], binding);
      all = all && here;
      any = any || here;
    });
    return condition.kind == ConditionKind::Forall ? all : any;
  }

  static Row row(const std::vector<htn::Term>& terms, const Binding& binding) {
    Row objects;
    for (const htn::Term term : terms) objects.push_back(object_of(term, binding));
    return objects;
  }

  std::string text_of(const std::string& name, const Row& objects) const {
    std::string text = "(" + name;
    for (const int object : objects) text += " " + task_.objects[static_cast<std::size_t>(object)].name;
    return text + ")";
  }

  const htn::PlanningTask& task_;
  std::chrono::steady_clock::time_point until_;
  std::vector<std::set<Row>> facts_;
  PlainAnswer answer_;
  std::size_t depth_ = 0;
  std::uint64_t looks_ = 0;
  bool late_ = false;
};

}  // namespace

PlainAnswer decompose_plainly(const htn::PlanningTask& task, std::chrono::steady_clock::time_point until) {
  return Plain(task, until).run();
}

}  // namespace stepwright::bench
