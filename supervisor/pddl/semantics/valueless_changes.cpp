#include "supervisor/pddl/semantics/valueless_changes.h"

namespace stepwright::pddl {
namespace {

class ValuelessChanges {
 public:
  ValuelessChanges(const Definition& definition, Reporter& reporter)
      : reporter_(reporter), valued_(definition.functions.size(), false) {
    for (const auto& [fluent, value] : definition.fluents) mark(fluent.symbol);
    for (std::size_t f = 0; f < valued_.size(); ++f) {
      if (definition.functions[f].assigned) valued_[f] = true;
    }
  }

  void visit(const Effect& effect) {
    const int function = effect.call.symbol;
    if (effect.kind == EffectKind::Numeric && function >= 0 && !valued_[static_cast<std::size_t>(function)]) {
      reporter_.warning("P0118", effect.call.at,
                        "'" + effect.call.name + "' is changed here, but never gets a value to be changed",
                        "give it one in ':init'; no action can be executed with this effect");
      mark(function);  // said once
    }
    for (const Effect& part : effect.parts) visit(part);
  }

 private:
  void mark(int function) { valued_[static_cast<std::size_t>(function)] = true; }

  Reporter& reporter_;
  std::vector<bool> valued_;
};

}  // namespace

void warn_of_valueless_changes(const Definition& definition, Reporter& reporter) {
  ValuelessChanges changes(definition, reporter);
  for (const Action& action : definition.actions) changes.visit(action.effect);
}

}  // namespace stepwright::pddl
