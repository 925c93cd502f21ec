#include "ladder/lowering/sfc_name_check.h"

#include <algorithm>
#include <cctype>
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

const Variable* find(const std::vector<Variable>& variables, const std::string& name) {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const Variable& v) { return graphic::same_name(v.name, name); });
  return found == variables.end() ? nullptr : &*found;
}

// What graphic::check cannot see because it knows no variables.
class TargetChecker {
 public:
  TargetChecker(const Pou& pou, const std::vector<Variable>* globals)
      : pou_(pou), chart_(std::get<SfcChart>(pou.body)), globals_(globals) {}

  Diagnostics run() {
    for (const graphic::Step& step : chart_.steps) {
      if (find(pou_.variables, step.name) != nullptr) {
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
    if (find(pou_.variables, action.name) != nullptr) {
      add(graphic::code::kNameOfVariable, action.where,
          "action '" + action.name + "' has the name of a variable", "rename one of them");
    }
    for_each_identifier(action.st_body, [&](std::string_view name) {
      if (graphic::same_name(name, "RETURN")) {
        add(graphic::code::kReturnInAction, action.where,
            "RETURN in action '" + action.name + "' would leave the whole chart",
            "use IF around the rest of the action");
      }
    });
    for_each_written_flag(action.st_body, [&](std::string_view owner, char flag) {
      if (!has_flag(owner, flag)) return;
      add(graphic::code::kFlagWritten, action.where,
          "action '" + action.name + "' writes the flag " + std::string(owner) + "." + flag,
          "flags of steps and actions are read-only; transitions move the tokens");
    });
  }

  bool has_flag(std::string_view owner, char flag) const {
    const auto named = [&](const auto& each) { return graphic::same_name(each.name, owner); };
    return flag == 'X' || flag == 'T' ? std::any_of(chart_.steps.begin(), chart_.steps.end(), named)
                                      : std::any_of(chart_.actions.begin(), chart_.actions.end(), named);
  }

  const Variable* variable_of(const std::string& name) const {
    const Variable* variable = find(pou_.variables, name);
    return variable == nullptr && globals_ != nullptr ? find(*globals_, name) : variable;
  }

  void target(const graphic::Step& step, const graphic::ActionBlock& block) {
    const bool is_action = std::any_of(chart_.actions.begin(), chart_.actions.end(), [&](const auto& action) {
      return graphic::same_name(action.name, block.target);
    });
    // The type of `motor.run` or `%QX0.0` is the compiler's business.
    if (is_action || !graphic::is_identifier(block.target)) return;
    const Variable* variable = variable_of(block.target);
    const std::string place = "target '" + block.target + "' of step '" + step.name + "'";
    if (variable == nullptr && globals_ != nullptr) {
      add(graphic::code::kUnknownTarget, block.where, place + " is neither a variable nor an action",
          "declare it, or correct the name");
    } else if (variable != nullptr && !graphic::same_name(variable->type, "BOOL")) {
      add(graphic::code::kTargetNotBool, block.where, place + " is a " + variable->type + ", not a BOOL",
          "an action block drives a BOOL variable; give the chart an action with a body for anything else");
    }
  }

  void indicators(const graphic::Step& step, const graphic::ActionBlock& block) {
    if (globals_ == nullptr) return;
    std::string name;
    bool begins = true;  // the first name of a path: "motor" of "motor.fault"
    for (const char c : block.indicator + ",") {
      const bool in_name = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
      if (in_name && begins) name += c;
      if (!in_name && c != ' ') begins = false;
      if (c != ',') continue;
      if (graphic::is_identifier(name) && variable_of(name) == nullptr) {
        add(graphic::code::kUnknownIndicator, block.where,
            "indicator '" + name + "' of action '" + block.target + "' of step '" + step.name +
                "' is not declared",
            "an indicator is a variable that shows what the action does");
      }
      name.clear();
      begins = true;
    }
  }

  const Pou& pou_;
  const SfcChart& chart_;
  const std::vector<Variable>* globals_;
  Diagnostics found_;
};

}  // namespace

Diagnostics check_names(const Pou& pou, const std::vector<Variable>* globals) {
  return TargetChecker(pou, globals).run();
}

}  // namespace stepwright::lowering
