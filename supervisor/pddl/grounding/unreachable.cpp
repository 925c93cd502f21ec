#include "supervisor/pddl/grounding/unreachable.h"

#include <algorithm>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {
namespace {

bool changes_to(const Effect& effect, int predicate, EffectKind kind) {
  if (effect.kind == kind && effect.call.symbol == predicate) return true;
  return std::any_of(effect.parts.begin(), effect.parts.end(),
                     [&](const Effect& part) { return changes_to(part, predicate, kind); });
}

class Explanation {
 public:
  explicit Explanation(const RawTask& raw) : raw_(raw), definition_(*raw.definition) {}

  std::string of(const RawGoal& goal) const {
    const Formula& formula = *goal.formula;
    const bool negated = formula.kind == FormulaKind::Not;
    const Formula& inner = negated ? formula.parts[0] : formula;
    if (goal.condition.impossible && inner.kind == FormulaKind::Atom) {
      return "no action makes " + print(definition_, inner) + (negated ? " false" : " true");
    }
    return of(goal.condition);
  }

 private:
  // Empty if the condition can hold.
  std::string of(const Condition& condition) const {
    if (condition.impossible) return "what never changes forbids it";
    for (const int literal : condition.literals) {
      if (!raw_.reachable.state.literals[static_cast<std::size_t>(literal)]) return of(literal);
    }
    for (const Comparison& comparison : condition.comparisons) {
      const Interval range = evaluate_interval(comparison.difference, raw_.reachable.state.values);
      if (!possible(comparison.relation, range)) return ranges(comparison.difference);
    }
    for (const auto& options : condition.choices) {
      const auto can = [&](const Condition& option) { return can_hold(option, raw_.reachable.state); };
      if (std::none_of(options.begin(), options.end(), can)) return alternatives(options);
    }
    return {};
  }

  std::string of(int literal) const {
    const Atom& fact = raw_.facts[static_cast<std::size_t>(literal / 2)];
    const std::string name = fact_name(definition_, fact);
    const std::string become = literal % 2 == 0 ? "true" : "false";
    if (definition_.predicates[static_cast<std::size_t>(fact.symbol)].derived) {
      return "no rule of the derived predicate can ever make " + name + " " + become;
    }
    std::string names;
    for (const Action& action : definition_.actions) {
      const EffectKind kind = literal % 2 == 0 ? EffectKind::Add : EffectKind::Delete;
      if (changes_to(action.effect, fact.symbol, kind)) names += (names.empty() ? "" : ", ") + action.name;
    }
    if (names.empty()) return "no action makes " + name + " " + become;
    return "none of the actions that could make " + name + " " + become + " (" + names + ") can ever do so";
  }

  std::string ranges(const GroundExpression& difference) const {
    std::string text;
    for_each_variable(difference, [&](int variable) {
      const auto v = static_cast<std::size_t>(variable);
      const Interval range = raw_.reachable.state.values[v];
      text += (text.empty() ? "" : ", ") + fluent_name(definition_, raw_.variables[v]);
      text += range.empty() ? " never gets a value"
                            : " stays between " + number_text(range.low) + " and " + number_text(range.high);
    });
    return text;
  }

  std::string alternatives(const std::vector<Condition>& options) const {
    std::string text = "none of its alternatives can hold";
    for (const Condition& option : options) text += "; " + of(option);
    return text;
  }

  const RawTask& raw_;
  const Definition& definition_;
};

}  // namespace

std::string why_unreachable(const RawTask& raw, const RawGoal& goal) {
  const Definition& definition = *raw.definition;
  const Place at = goal.formula->at;
  result::Diagnostic diagnostic;
  diagnostic.code = "P0501";
  if (at.file < definition.files.size()) diagnostic.where = {definition.files[at.file], at.line, at.column};
  diagnostic.message =
      "the goal " + print(definition, *goal.formula) + " cannot be reached: " + Explanation(raw).of(goal);
  return result::to_string(diagnostic);
}

}  // namespace stepwright::pddl
