#include "supervisor/translate/handshake.h"

#include <algorithm>
#include <utility>

#include "ladder/graphic/identifier.h"

namespace stepwright::translate {
namespace {

using graphic::CompareOp;
using graphic::StepId;

const char* variable_of(HandshakeWord word) {
  return kHandshakeVariables[static_cast<std::size_t>(word)];
}

class Gates {
 public:
  Gates(Translation& translation, graphic::Pou& pou)
      : translation_(translation), pou_(pou), chart_(std::get<graphic::SfcChart>(pou.body)) {
    for (const graphic::Variable& each : pou.variables) names_.insert(each.name);
    for (const graphic::Variable& each : translation.project.globals) names_.insert(each.name);
    for (const graphic::Step& each : chart_.steps) names_.insert(each.name);
    for (const graphic::Transition& each : chart_.transitions) names_.insert(each.name);
  }

  result::Result<void> add() {
    if (auto declared = declare(); !declared) return declared;
    const std::size_t steps = chart_.steps.size();
    for (std::size_t i = 0; i < steps; ++i) {
      const StepInfo info = translation_.steps[i];
      const StepId step(static_cast<std::uint32_t>(i));
      switch (info.kind) {
        case StepKind::Start:
          tell(step, "HS_BEGIN", "HS_WAITING := 0; HS_STARTED := 0; HS_OUTCOME := 0;");
          break;
        case StepKind::Action:
          gate(step, info);
          break;
        case StepKind::Done:
          tell(step, "HS_END", "HS_OUTCOME := 1;");
          break;
        case StepKind::Failed:
          tell(step, "HS_FAIL", "HS_OUTCOME := 2;");
          break;
        default:
          break;
      }
    }
    return {};
  }

 private:
  result::Result<void> declare() {
    for (std::size_t i = 0; i < kHandshakeVariables.size(); ++i) {
      if (!names_.insert(kHandshakeVariables[i])) {
        return result::fail("T0006", {},
                            std::string("'") + kHandshakeVariables[i] + "' is a name of the handshake",
                            "rename the tag");
      }
      graphic::Variable word;
      word.name = kHandshakeVariables[i];
      word.type = "INT";
      word.section = graphic::VariableSection::Global;
      word.address = handshake_address(static_cast<HandshakeWord>(i));
      word.comment = "register of the handshake";
      translation_.project.globals.push_back(word);
      word.section = graphic::VariableSection::External;
      word.address.clear();
      pou_.variables.push_back(std::move(word));
    }
    return {};
  }

  // Every way into the action's step leads to its gate first.
  void gate(StepId action, const StepInfo& info) {
    const std::string number = std::to_string(*info.action + 1);
    const StepId gate(static_cast<std::uint32_t>(chart_.steps.size()));
    for (graphic::Transition& transition : chart_.transitions) {
      std::replace(transition.targets.begin(), transition.targets.end(), action, gate);
    }
    graphic::Step step;
    step.name = names_.unique("G" + chart_.steps[action.value].name.substr(1));
    step.comment = "waits until action " + number + " is granted";
    StepInfo waits;
    waits.name = step.name;
    waits.after = info.after;
    chart_.steps.push_back(std::move(step));
    translation_.steps.push_back(std::move(waits));
    graphic::Transition granted;
    granted.name = names_.unique("GRANT_" + number);
    granted.sources = {gate};
    granted.targets = {action};
    granted.condition =
        graphic::all({graphic::compare(variable_of(HandshakeWord::Enable), CompareOp::NotEqual, "0"),
                      graphic::compare(variable_of(HandshakeWord::Go), CompareOp::Equal, number)});
    granted.priority = static_cast<int>(chart_.transitions.size()) + 1;
    chart_.transitions.push_back(std::move(granted));
    tell(gate, "HS_AT_" + number, "HS_WAITING := " + number + ";");
    // Once: another action that began later must not be overwritten by one that is still active.
    tell(action, "HS_RUN_" + number, "HS_STARTED := " + number + ";", graphic::Qualifier::P1);
  }

  // The step writes registers for as long as it is active, or once.
  void tell(StepId step, const std::string& name, const std::string& body,
            graphic::Qualifier qualifier = graphic::Qualifier::N) {
    const auto same = [&](const graphic::Action& each) { return each.name == name; };
    if (std::ranges::none_of(chart_.actions, same)) {
      graphic::Action action;
      action.name = name;
      action.st_body = body;
      chart_.actions.push_back(std::move(action));
    }
    graphic::ActionBlock block;
    block.qualifier = qualifier;
    block.target = name;
    chart_.steps[step.value].actions.push_back(std::move(block));
  }

  Translation& translation_;
  graphic::Pou& pou_;
  graphic::SfcChart& chart_;
  graphic::NameSet names_;
};

}  // namespace

std::string handshake_address(HandshakeWord word) {
  return "%MW" + std::to_string(static_cast<unsigned>(word));
}

result::Result<void> add_handshake(Translation& translation) {
  const auto pou = std::ranges::find(translation.project.pous, translation.program, &graphic::Pou::name);
  return Gates(translation, *pou).add();
}

}  // namespace stepwright::translate
