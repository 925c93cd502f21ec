// The effects of BodyResolver.

#include "supervisor/htn/task/body_resolver.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kMostCopied = 100'000;  // conditions around effects, in a whole domain

}  // namespace

void BodyResolver::effect(const ParsedEffect& effect, Action& action) {
  Around around;
  this->effect(effect, around, action);
}

void BodyResolver::effect(const ParsedEffect& effect, Around& around, Action& action) {
  switch (effect.kind) {
    case EffectKind::Add:
    case EffectKind::Delete:
      leaf(effect, around, action);
      return;
    case EffectKind::Cost:
      cost(effect, around, action);
      return;
    case EffectKind::When:
      around.conditions.push_back(inner(effect.condition[0]));
      this->effect(effect.parts[0], around, action);
      around.conditions.pop_back();
      return;
    case EffectKind::Forall: {
      const std::size_t outside = around.variables.size();
      for (Variable& variable : push(effect.variables)) around.variables.push_back(std::move(variable));
      this->effect(effect.parts[0], around, action);
      around.variables.resize(outside);
      pop(effect.variables.size());
      return;
    }
    case EffectKind::And:
      for (const ParsedEffect& part : effect.parts) this->effect(part, around, action);
      return;
  }
}

void BodyResolver::leaf(const ParsedEffect& parsed, const Around& around, Action& action) {
  const bool add = parsed.kind == EffectKind::Add;
  if (is_external(parsed.call)) {
    if (!around.variables.empty() || !around.conditions.empty()) return refuse_external(parsed.call);
    ExternalLiteral external;
    external.positive = add;
    if (atom(parsed.call, Fit::Subtype, external.predicate, external.terms))
      action.external_effects.push_back(std::move(external));
    return;
  }
  copied_ += around.conditions.size() + around.variables.size();
  if (copied_ > kMostCopied) {
    reporter_.error("P0606", parsed.at, "too many effects stand in conditions within conditions");
    return;
  }
  Effect effect;
  effect.add = add;
  if (!atom(parsed.call, Fit::Subtype, effect.predicate, effect.terms)) return;
  effect.variables = around.variables;
  effect.condition.parts = around.conditions;
  task_.predicates[static_cast<std::size_t>(effect.predicate)].changes = true;
  action.effects.push_back(std::move(effect));
}

void BodyResolver::cost(const ParsedEffect& parsed, const Around& around, Action& action) {
  if (!around.variables.empty() || !around.conditions.empty()) {
    reporter_.error("P0008", parsed.at, "a cost cannot depend on a condition here",
                    "write it into the outermost conjunction of the effect");
    return;
  }
  Amount amount;
  amount.number = parsed.amount.number;
  const ParsedCall& function = parsed.amount.function;
  if (!function.name.empty()) {
    amount.function = symbol(function, names_.functions, "P0103", "function");
    if (amount.function < 0) return;
    const Symbol& known = task_.functions[static_cast<std::size_t>(amount.function)];
    if (!arguments(function, known.parameter_types, Fit::Overlap, amount.terms)) return;
  } else if (amount.number < 0.0) {
    reporter_.error("P0608", parsed.amount.at, "an action cannot cost less than nothing");
    return;
  }
  action.costs.push_back(std::move(amount));
}

}  // namespace stepwright::htn
