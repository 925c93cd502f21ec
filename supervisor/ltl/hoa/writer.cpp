#include <map>

#include "supervisor/ltl/hoa/hoa.h"

namespace stepwright::ltl {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char each : text) {
    if (each == '"' || each == '\\') out += '\\';
    out += each;
  }
  return out + "\"";
}

class Labels {
 public:
  Labels(const Guards& guards, std::size_t most) : guards_(guards), left_(most) {}

  // The label of each state that a guard leads to; false when there are too many conjunctions.
  bool collect(Guard guard, const std::string& way) {
    if (is_state(guard)) {
      if (left_-- == 0) return false;
      std::string& label = of[state_of(guard)];
      if (!label.empty()) label += " | ";
      label += way.empty() ? "t" : way;
      return true;
    }
    const GuardNode& node = guards_.nodes()[guard];
    const std::string begin = way.empty() ? "" : way + "&", number = std::to_string(node.proposition);
    return collect(node.low, begin + "!" + number) && collect(node.high, begin + number);
  }

  std::map<std::uint32_t, std::string> of;

 private:
  const Guards& guards_;
  std::size_t left_;
};

}  // namespace

result::Result<std::string> write_hoa(const Automaton& automaton, HoaPart part, const std::string& name,
                                      std::size_t most_terms) {
  std::string text = "HOA: v1\nname: " + quoted(name) + "\nStates: " + std::to_string(automaton.size()) +
                     "\nStart: " + std::to_string(automaton.initial) +
                     "\nAP: " + std::to_string(automaton.propositions.size());
  for (const std::string& each : automaton.propositions) text += " " + quoted(each);
  text +=
      "\nacc-name: Buchi\nAcceptance: 1 Inf(0)\nproperties: trans-labels explicit-labels state-acc complete "
      "deterministic" +
      std::string(part == HoaPart::Good ? " terminal" : " weak") + "\n--BODY--\n";
  for (std::uint32_t state = 0; state < automaton.size(); ++state) {
    const bool accepts = part == HoaPart::Good ? automaton.accepting(state) : !automaton.rejecting(state);
    text += "State: " + std::to_string(state) + (accepts ? " {0}\n" : "\n");
    Labels labels(automaton.guards, most_terms);
    if (!labels.collect(automaton.edges[state], "")) {
      return result::fail("L0026", {},
                          "the labels of state " + std::to_string(state) + " have more than " +
                              std::to_string(most_terms) + " conjunctions",
                          "divide the formula, each part with an automaton of its own");
    }
    for (const auto& [to, label] : labels.of) text += "[" + label + "] " + std::to_string(to) + "\n";
  }
  return text + "--END--\n";
}

}  // namespace stepwright::ltl
