#include "supervisor/pddl/grounding/grounder.h"

#include "supervisor/pddl/grounding/compiler.h"
#include "supervisor/pddl/grounding/invariants.h"
#include "supervisor/pddl/grounding/joiner.h"
#include "supervisor/pddl/grounding/raw_task.h"
#include "supervisor/pddl/grounding/reachability.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kStepsBetweenChecks = 1024;

class Grounder {
 public:
  Grounder(const Definition& definition, const std::function<bool()>& stop, const RoomFor& room_for)
      : definition_(definition), stop_(stop), room_for_(room_for), compiler_(definition, stop) {}

  GroundTask run() {
    raw_.definition = &definition_;
    goals();
    if (definition_.metric) {
      raw_.metric = compiler_.expression(definition_.metric->expression, {});
      if (definition_.metric->maximize) raw_.metric = combine(NumericKind::Negate, raw_.metric, {});
    }
    if (compiler_.stopped() || !operators()) return cancelled();
    raw_.facts = compiler_.facts();
    raw_.variables = compiler_.variables();
    const std::vector<Invariant> invariants = find_invariants(raw_, stop_);
    return simplify(std::move(raw_), invariants, room_for_);
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

  // No list is longer than that of the operators, and while it grows it is there twice.
  bool room_for_one_more() {
    std::vector<GroundOperator>& list = raw_.operators;
    if (list.size() < list.capacity()) return true;
    const std::size_t next = list.size() + list.size() / 4 + 64;
    if (!room_for_(next * sizeof(GroundOperator))) return false;
    list.reserve(next);
    return true;
  }

  bool time_to_stop() { return ++steps_ % kStepsBetweenChecks == 0 && stop_(); }

  // Facts are joined to operators, operators make facts reachable, and so on. False if stopped.
  bool operators() {
    if (stop_()) return false;
    for (const Atom& fact : definition_.facts) {
      if (definition_.predicates[static_cast<std::size_t>(fact.symbol)].changes) compiler_.fact(fact);
    }
    const std::vector<JoinRule> rules = join_rules(definition_);
    Reachability reach(raw_, compiler_);
    Joiner joiner(definition_, rules, [&](const JoinRule& rule, Binding& binding) {
      if (time_to_stop() || !room_for_one_more()) return false;
      compile(rule, binding, reach);
      return !compiler_.stopped();
    });
    if (!joiner.start()) return false;
    for (int fact = 0; reach.next(fact);) {
      const Atom atom = compiler_.facts()[static_cast<std::size_t>(fact)];
      if (time_to_stop() || !joiner.arrive(atom)) return false;
    }
    reach.grow_tables();
    return true;
  }

  void compile(const JoinRule& rule, Binding& binding, Reachability& reach) {
    if (rule.action >= 0) {
      if (auto op = compiler_.compile(rule.action, binding)) reach.add_operator(std::move(*op));
      return;
    }
    const Axiom& axiom = definition_.axioms[static_cast<std::size_t>(rule.axiom)];
    if (auto compiled = compiler_.compile(axiom, rule.conjuncts, binding))
      reach.add_axiom(std::move(*compiled));
  }

  const Definition& definition_;
  const std::function<bool()>& stop_;
  const RoomFor& room_for_;
  Compiler compiler_;
  RawTask raw_;
  std::size_t steps_ = 0;
};

}  // namespace

GroundTask ground_task(const Definition& definition, const std::function<bool()>& stop,
                       const RoomFor& room_for) {
  return Grounder(definition, stop, room_for).run();
}

}  // namespace stepwright::pddl
