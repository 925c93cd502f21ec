#include "supervisor/ltl/drawing/guard_text.h"

namespace stepwright::ltl {

namespace {

class Texts {
 public:
  Texts(const Automaton& automaton, std::size_t most) : automaton_(automaton), most_(most) {}

  // As deep as there are propositions. Ways that no text takes up any more are not gone.
  void collect(Guard guard, const std::string& way) {
    if (is_state(guard)) {
      std::string& text = of[state_of(guard)];
      if (text.size() > most_) return;
      text += text.empty() ? "" : " | ";
      text += way.empty() ? "always" : way;
      return;
    }
    if (++steps_ > kMostSteps) return;
    const GuardNode& node = automaton_.guards.nodes()[guard];
    const std::string begin = way.empty() ? "" : way + " & ",
                      &name = automaton_.propositions[node.proposition];
    collect(node.high, begin + name);
    collect(node.low, begin + "!" + name);
  }

  void shorten() {
    for (auto& [state, text] : of)
      if (text.size() > most_) text = text.substr(0, most_) + "...";
  }

  std::map<std::uint32_t, std::string> of;

 private:
  static constexpr std::size_t kMostSteps = 10'000;

  const Automaton& automaton_;
  std::size_t most_, steps_ = 0;
};

}  // namespace

std::map<std::uint32_t, std::string> guard_texts(const Automaton& automaton, std::uint32_t from,
                                                 std::size_t most) {
  Texts texts(automaton, most);
  std::vector<std::uint32_t> after;
  automaton.guards.collect(automaton.edges[from], after);
  for (const std::uint32_t each : after) texts.of[each];
  texts.collect(automaton.edges[from], "");
  texts.shorten();
  for (auto& [state, text] : texts.of)
    if (text.empty()) text = "...";
  return std::move(texts.of);
}

}  // namespace stepwright::ltl
