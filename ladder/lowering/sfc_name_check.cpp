#include "ladder/lowering/sfc_name_check.h"

#include <algorithm>
#include <utility>

#include "ladder/graphic/identifier.h"
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
        add("E0521", "step '" + step.name + "' has the name of a variable", "rename one of them");
      }
      for (const graphic::ActionBlock& block : step.actions) target(step, block);
    }
    for (const graphic::Action& action : chart_.actions) {
      if (find(pou_.variables, action.name) != nullptr) {
        add("E0521", "action '" + action.name + "' has the name of a variable", "rename one of them");
      }
      for_each_identifier(action.st_body, [&](std::string_view name) {
        if (graphic::same_name(name, "RETURN")) {
          add("E0524", "RETURN in action '" + action.name + "' would leave the whole chart",
              "use IF around the rest of the action");
        }
      });
    }
    return std::move(found_);
  }

 private:
  void add(const char* code, std::string message, std::string hint) {
    found_.push_back({code, result::Severity::Error, {}, std::move(message), std::move(hint)});
  }

  void target(const graphic::Step& step, const graphic::ActionBlock& block) {
    const bool is_action = std::any_of(chart_.actions.begin(), chart_.actions.end(), [&](const auto& action) {
      return graphic::same_name(action.name, block.target);
    });
    // The type of `motor.run` or `%QX0.0` is the compiler's business.
    if (is_action || !graphic::is_identifier(block.target)) return;
    const Variable* variable = find(pou_.variables, block.target);
    if (variable == nullptr && globals_ != nullptr) variable = find(*globals_, block.target);
    const std::string place = "target '" + block.target + "' of step '" + step.name + "'";
    if (variable == nullptr && globals_ != nullptr) {
      add("E0523", place + " is neither a variable nor an action", "declare it, or correct the name");
    } else if (variable != nullptr && !graphic::same_name(variable->type, "BOOL")) {
      add("E0522", place + " is a " + variable->type + ", not a BOOL",
          "an action block drives a BOOL variable; give the chart an action with a body for anything else");
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
