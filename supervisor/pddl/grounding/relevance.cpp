#include "supervisor/pddl/grounding/relevance.h"

#include <functional>

namespace stepwright::pddl {
namespace {

void for_each_variable(const Condition& condition, const std::function<void(int)>& visit) {
  for (const Comparison& comparison : condition.comparisons) {
    for_each_variable(comparison.difference, visit);
  }
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) for_each_variable(option, visit);
  }
}

class Finder {
 public:
  explicit Finder(const RawTask& raw) : raw_(raw) {
    relevance_.facts.assign(raw.facts.size(), false);
    relevance_.variables.assign(raw.variables.size(), false);
    relevance_.kept.assign(raw.variables.size(), false);
    relevance_.weights.assign(raw.variables.size(), 0.0);
    axioms_read_.assign(raw.axioms.size(), false);
  }

  Relevance run() {
    for (const RawGoal& goal : raw_.goals) read(goal.condition);
    for_each_effect([&](const GroundOperator& op, const GroundEffect& effect) {
      read(op.precondition);
      read(effect.when);
      for (const NumericEffect& numeric : effect.numeric) {
        // An effect that can be undefined, or contradict another, forbids the action: it decides something.
        if (op.may_conflict || may_be_undefined(numeric.amount) || numeric.kind == ChangeKind::ScaleDown) {
          keep(numeric.variable);
        }
      }
    });
    // A fluent without an initial value forbids the actions that read or increase it, so it stays in the
    // state.
    for (std::size_t v = 0; v < raw_.variables.size(); ++v) {
      if (raw_.initial_values[v] != raw_.initial_values[v]) keep(static_cast<int>(v));
    }
    close();
    choose_accumulated();
    return std::move(relevance_);
  }

 private:
  void read(int variable) { relevance_.variables[static_cast<std::size_t>(variable)] = true; }

  void keep(int variable) {
    read(variable);
    relevance_.kept[static_cast<std::size_t>(variable)] = true;
  }

  bool may_be_undefined(const GroundExpression& amount) const {
    const auto undefined = [](double value) { return value != value; };
    bool found = amount.linear() && undefined(amount.constant);
    for (const NumericOperation& operation : amount.program) {
      found = found || operation.kind == NumericKind::Divide || undefined(operation.constant);
    }
    pddl::for_each_variable(amount, [&](int variable) {
      found = found || undefined(raw_.initial_values[static_cast<std::size_t>(variable)]);
    });
    return found;
  }

  void read(const Condition& condition) {
    for (const int literal : condition.literals)
      relevance_.facts[static_cast<std::size_t>(literal / 2)] = true;
    for_each_variable(condition, [&](int v) { read(v); });
    for (const auto& options : condition.choices) {
      for (const Condition& option : options) read(option);
    }
  }

  template <typename Visit>
  void for_each_effect(const Visit& visit) {
    for (std::size_t i = 0; i < raw_.operators.size(); ++i) {
      if (!raw_.reachable.operators[i]) continue;
      for (const GroundEffect& effect : raw_.operators[i].effects) visit(raw_.operators[i], effect);
    }
  }

  // What relevant variables (and accumulated fluents) are computed from is relevant.
  void close() {
    for (bool changed = true; changed;) {
      changed = false;
      for_each_effect([&](const GroundOperator&, const GroundEffect& effect) {
        for (const NumericEffect& numeric : effect.numeric) {
          const auto target = static_cast<std::size_t>(numeric.variable);
          if (!relevance_.variables[target] && relevance_.weights[target] == 0.0) continue;
          pddl::for_each_variable(numeric.amount, [&](int v) {
            const auto place = static_cast<std::size_t>(v);
            changed = changed || !relevance_.variables[place];
            relevance_.variables[place] = true;
          });
        }
      });
      changed = read_axioms() || changed;
    }
  }

  // What relevant derived facts depend on is relevant; true if that is anything new.
  bool read_axioms() {
    bool changed = false;
    for (std::size_t i = 0; i < raw_.axioms.size(); ++i) {
      const GroundAxiom& axiom = raw_.axioms[i];
      if (axioms_read_[i] || !relevance_.facts[static_cast<std::size_t>(axiom.fact)]) continue;
      axioms_read_[i] = changed = true;
      read(axiom.body);
    }
    return changed;
  }

  void choose_accumulated() {
    const GroundExpression& metric = raw_.metric;
    for (const LinearTerm& term : metric.terms) {
      const auto v = static_cast<std::size_t>(term.variable);
      if (!relevance_.variables[v]) relevance_.weights[v] = term.coefficient;
    }
    if (!metric.linear()) pddl::for_each_variable(metric, [&](int v) { read(v); });
    for_each_effect([&](const GroundOperator&, const GroundEffect& effect) {
      for (const NumericEffect& numeric : effect.numeric) {
        if (numeric.kind == ChangeKind::Increase || numeric.kind == ChangeKind::Decrease) continue;
        const auto v = static_cast<std::size_t>(numeric.variable);
        if (relevance_.weights[v] != 0.0) read(numeric.variable);
      }
    });
    close();
    // A fluent that turned out to be read is a variable after all.
    for (std::size_t v = 0; v < relevance_.weights.size(); ++v) {
      if (relevance_.variables[v]) relevance_.weights[v] = 0.0;
    }
  }

  const RawTask& raw_;
  Relevance relevance_;
  std::vector<bool> axioms_read_;
};

}  // namespace

Relevance find_relevance(const RawTask& raw) {
  return Finder(raw).run();
}

}  // namespace stepwright::pddl
