#include "tests/bench/grounding/enumerating_grounder.h"

#include <limits>

#include "supervisor/pddl/grounding/compiler.h"
#include "supervisor/pddl/grounding/invariants.h"
#include "supervisor/pddl/grounding/raw_task.h"
#include "tests/bench/grounding/binding_enumerator.h"
#include "tests/bench/grounding/round_explorer.h"

namespace stepwright::pddl::baseline {
namespace {

constexpr std::size_t kBindingsBetweenChecks = 1024;

class Grounder {
 public:
  Grounder(const Definition& definition, const std::function<bool()>& stop)
      : definition_(definition), stop_(stop), compiler_(definition, stop) {}

  GroundTask run() {
    raw_.definition = &definition_;
    goals();
    if (definition_.metric) {
      raw_.metric = compiler_.expression(definition_.metric->expression, {});
      if (definition_.metric->maximize) raw_.metric = combine(NumericKind::Negate, raw_.metric, {});
    }
    if (!operators() || !axioms()) return cancelled();
    initial_state();
    if (!explore(raw_, start(), stop_)) return cancelled();
    const std::vector<Invariant> invariants = find_invariants(raw_, stop_);
    return simplify(std::move(raw_), invariants, everything_fits);
  }

 private:
  GroundTask cancelled() const {
    GroundTask task;
    task.definition = &definition_;
    task.cancelled = true;
    return task;
  }

  void goals() {
    Binding binding(static_cast<std::size_t>(definition_.goal_slots), -1);
    const Formula& goal = definition_.goal;
    if (goal.kind != FormulaKind::And) {
      raw_.goals.push_back({compiler_.condition(goal, binding), &goal});
      return;
    }
    for (const Formula& part : goal.parts) raw_.goals.push_back({compiler_.condition(part, binding), &part});
  }

  bool operators() {
    const LiftedState initial = pddl::initial_state(definition_);
    for (std::size_t a = 0; a < definition_.actions.size(); ++a) {
      BindingEnumerator bindings(definition_, definition_.actions[a], initial);
      const bool finished = bindings.run([&](Binding& binding) {
        if (++count_ % kBindingsBetweenChecks == 0 && stop_()) return false;
        if (auto op = compiler_.compile(static_cast<int>(a), binding))
          raw_.operators.push_back(std::move(*op));
        return true;
      });
      if (!finished) return false;
    }
    return true;
  }

  bool axioms() {
    const LiftedState initial = pddl::initial_state(definition_);
    for (const Axiom& axiom : definition_.axioms) {
      if (!definition_.predicates[static_cast<std::size_t>(axiom.predicate)].changes) continue;
      BindingEnumerator bindings(definition_, axiom, initial);
      const bool finished = bindings.run([&](Binding& binding) {
        if (++count_ % kBindingsBetweenChecks == 0 && stop_()) return false;
        if (auto compiled = compiler_.compile(axiom, {&axiom.body}, binding))
          raw_.axioms.push_back(std::move(*compiled));
        return true;
      });
      if (!finished) return false;
    }
    return true;
  }

  RelaxedState start() const {
    RelaxedState state;
    state.literals.resize(2 * raw_.facts.size());
    for (std::size_t f = 0; f < raw_.facts.size(); ++f) {
      state.literals[2 * f + (raw_.initial_facts[f] ? 0 : 1)] = true;
      if (raw_.derived(f)) state.literals[2 * f + 1] = true;
    }
    for (const double value : raw_.initial_values) {
      state.values.push_back(value == value ? Interval::point(value) : Interval{});
    }
    return state;
  }

  void initial_state() {
    raw_.facts = compiler_.facts();
    raw_.variables = compiler_.variables();
    for (const Atom& atom : raw_.facts) raw_.initial_facts.push_back(definition_.facts.count(atom) != 0);
    for (const Atom& atom : raw_.variables) {
      const auto found = definition_.fluents.find(atom);
      raw_.initial_values.push_back(found == definition_.fluents.end()
                                        ? std::numeric_limits<double>::quiet_NaN()
                                        : snap(found->second));
    }
  }

  const Definition& definition_;
  const std::function<bool()>& stop_;
  Compiler compiler_;
  RawTask raw_;
  std::size_t count_ = 0;
};

}  // namespace

GroundTask ground_by_enumeration(const Definition& definition, const std::function<bool()>& stop) {
  return Grounder(definition, stop).run();
}

}  // namespace stepwright::pddl::baseline
