#include "ladder/lowering/sfc_name_check.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/sfc_codes.h"
#include "ladder/lowering/st_names.h"

namespace stepwright::lowering {
namespace {

using graphic::Pou;
using graphic::SfcChart;
using graphic::Variable;
using result::Diagnostics;

// In upper case; the first of a name counts.
using VariableIndex = std::unordered_map<std::string, const Variable*>;

VariableIndex index_of(const std::vector<Variable>& variables) {
  VariableIndex index;
  for (const Variable& each : variables) index.try_emplace(graphic::upper(each.name), &each);
  return index;
}

const Variable* find(const VariableIndex& variables, const std::string& name) {
  const auto found = variables.find(graphic::upper(name));
  return found == variables.end() ? nullptr : found->second;
}

template <typename Named>
graphic::NameSet names_of(const std::vector<Named>& all) {
  graphic::NameSet names;
  for (const Named& each : all) names.insert(each.name);
  return names;
}

// What graphic::check cannot see because it knows no variables.
class TargetChecker {
 public:
  TargetChecker(const Pou& pou, const std::vector<Variable>* globals)
      : chart_(std::get<SfcChart>(pou.body)),
        variables_(index_of(pou.variables)),
        steps_(names_of(chart_.steps)),
        actions_(names_of(chart_.actions)),
        knows_globals_(globals != nullptr) {
    if (knows_globals_) globals_ = index_of(*globals);
  }

  Diagnostics run() {
    for (const graphic::Step& step : chart_.steps) {
      if (find(variables_, step.name) != nullptr) {
        add(graphic::code::kNameOfVariable, step.where, "step '" + step.name + "' has the name of a variable",
            "rename one of them");
      }
      for (const graphic::ActionBlock& block : step.actions) {
        target(step, block);
        indicators(step, block);
      }
    }
    for (const graphic::Action& each : chart_.actions) action(each);
    return std::move(found_);
  }

 private:
  void add(const char* code, const result::Location& where, std::string message, std::string hint) {
    found_.push_back({code, result::Severity::Error, where, std::move(message), std::move(hint)});
  }

  void action(const graphic::Action& action) {
    if (find(variables_, action.name) != nullptr) {
      add(graphic::code::kNameOfVariable, action.where,
          "action '" + action.name + "' has the name of a variable", "rename one of them");
    }
    if (holds_return(reader_, action.st_body)) {
      add(graphic::code::kReturnInAction, action.where,
          "RETURN in action '" + action.name + "' would leave the whole chart",
          "use IF around the rest of the action");
    }
    for_each_written_flag(reader_, action.st_body, [&](std::string_view owner, char flag) {
      if (!has_flag(owner, flag)) return;
      add(graphic::code::kFlagWritten, action.where,
          "action '" + action.name + "' writes the flag " + std::string(owner) + "." + flag,
          "flags of steps and actions are read-only; transitions move the tokens");
    });
  }

  bool has_flag(std::string_view owner, char flag) const {
    return (flag == 'X' || flag == 'T' ? steps_ : actions_).contains(owner);
  }

  const Variable* variable_of(const std::string& name) const {
    const Variable* variable = find(variables_, name);
    return variable == nullptr ? find(globals_, name) : variable;
  }

  void target(const graphic::Step& step, const graphic::ActionBlock& block) {
    // The type of `motor.run` or `%QX0.0` is the compiler's business.
    if (actions_.contains(block.target) || !graphic::is_identifier(block.target)) return;
    const Variable* variable = variable_of(block.target);
    const std::string place = "target '" + block.target + "' of step '" + step.name + "'";
    if (variable == nullptr && knows_globals_) {
      add(graphic::code::kUnknownTarget, block.where, place + " is neither a variable nor an action",
          "declare it, or correct the name");
    } else if (variable != nullptr && !graphic::same_name(variable->type, "BOOL")) {
      add(graphic::code::kTargetNotBool, block.where, place + " is a " + variable->type + ", not a BOOL",
          "an action block drives a BOOL variable; give the chart an action with a body for anything else");
    }
  }

  void indicators(const graphic::Step& step, const graphic::ActionBlock& block) {
    if (!knows_globals_) return;
    for_each_first_name(reader_, block.indicator, [&](std::string_view name) {
      if (variable_of(std::string(name)) != nullptr) return;
      add(graphic::code::kUnknownIndicator, block.where,
          "indicator '" + std::string(name) + "' of action '" + block.target + "' of step '" + step.name +
              "' is not declared",
          "an indicator is a variable that shows what the action does");
    });
  }

  const SfcChart& chart_;
  syntax::PieceReader reader_;
  VariableIndex variables_;
  VariableIndex globals_;
  graphic::NameSet steps_;
  graphic::NameSet actions_;
  bool knows_globals_;
  Diagnostics found_;
};

}  // namespace

Diagnostics check_names(const Pou& pou, const std::vector<Variable>* globals) {
  return TargetChecker(pou, globals).run();
}

}  // namespace stepwright::lowering
