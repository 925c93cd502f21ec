#include "ladder/lowering/step_timers.h"

#include <cassert>
#include <map>
#include <utility>

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {

namespace {

using graphic::Condition;
using graphic::ConditionKind;
using graphic::StepId;

class TimerRewriter {
 public:
  explicit TimerRewriter(graphic::Pou& pou) : pou_(pou), chart_(std::get<graphic::SfcChart>(pou.body)) {
    for (const graphic::Variable& variable : pou.variables) names_.insert(variable.name);
    for (const graphic::Step& step : chart_.steps) names_.insert(step.name);
    for (const graphic::Transition& transition : chart_.transitions) names_.insert(transition.name);
    for (const graphic::Action& action : chart_.actions) names_.insert(action.name);
  }

  void rewrite() {
    for (graphic::Transition& transition : chart_.transitions) {
      rewrite(transition.condition, transition.sources);
    }
  }

 private:
  void rewrite(Condition& condition, const std::vector<StepId>& sources) {
    for (Condition& child : condition.children) rewrite(child, sources);
    const bool waits =
        condition.kind == ConditionKind::Comparison && condition.op == graphic::CompareOp::GreaterEqual;
    if (!waits || condition.operand.find('#') == std::string::npos) return;
    for (const StepId source : sources) {
      if (!graphic::same_name(condition.name, chart_.steps[source.value].name + ".T")) continue;
      condition = graphic::contact(flag(source, condition.operand));
      return;
    }
  }

  // The flag that is set once `step` has been active for `time`.
  const std::string& flag(StepId step, const std::string& time) {
    std::string& name = flags_[{step, time}];
    if (!name.empty()) return name;
    graphic::Step& owner = chart_.steps[step.value];
    name = names_.unique(owner.name + "_DUE");
    graphic::ActionBlock block;
    block.qualifier = graphic::Qualifier::D;
    block.target = name;
    block.duration = time;
    owner.actions.push_back(std::move(block));
    graphic::Variable variable;
    variable.name = name;
    variable.type = "BOOL";
    variable.comment = owner.name + " has been active for " + time;
    pou_.variables.push_back(std::move(variable));
    return name;
  }

  graphic::Pou& pou_;
  graphic::SfcChart& chart_;
  graphic::NameSet names_;
  std::map<std::pair<StepId, std::string>, std::string> flags_;
};

}  // namespace

graphic::Pou with_step_timers(graphic::Pou pou) {
  assert(std::holds_alternative<graphic::SfcChart>(pou.body));
  TimerRewriter(pou).rewrite();
  return pou;
}

}  // namespace stepwright::lowering
