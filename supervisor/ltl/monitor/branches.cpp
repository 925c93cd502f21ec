#include "supervisor/ltl/monitor/branches.h"

#include <algorithm>
#include <unordered_map>

namespace stepwright::ltl {

namespace {

constexpr std::size_t kCases = 6;  // of one CASE, whose values are compared one after the other

class Writer {
 public:
  Writer(const Automaton& automaton, const std::vector<std::string>& inputs)
      : automaton_(automaton), inputs_(inputs) {}

  // How many branches a guard has when nothing is shared; `most` and one where there are more.
  std::size_t count(Guard guard, std::size_t most) {
    if (is_state(guard)) return 1;
    if (const auto known = counts_.find(guard); known != counts_.end()) return known->second;
    const GuardNode& node = automaton_.guards.nodes()[guard];
    const std::size_t sum = std::min(most + 1, count(node.low, most) + count(node.high, most));
    counts_.emplace(guard, sum);
    return sum;
  }

  // One of the states is the current one: halves until few are left, so that many cost little more than few.
  void states(const std::vector<std::uint32_t>& from, std::size_t first, std::size_t last,
              std::size_t indent) {
    if (last - first <= kCases) return cases(from, first, last, indent);
    const std::size_t middle = first + (last - first) / 2;
    line(indent, "IF State < " + std::to_string(from[middle]) + " THEN");
    states(from, first, middle, indent + 1);
    line(indent, "ELSE");
    states(from, middle, last, indent + 1);
    line(indent, "END_IF;");
  }

  std::string take() { return std::move(text_); }

 private:
  void cases(const std::vector<std::uint32_t>& from, std::size_t first, std::size_t last,
             std::size_t indent) {
    line(indent, "CASE State OF");
    for (std::size_t k = first; k < last; ++k) {
      line(indent + 1, std::to_string(from[k]) + ":");
      guard(automaton_.edges[from[k]], from[k], indent + 2);
    }
    line(indent, "END_CASE;");
  }

  // As deep as there are propositions.
  void guard(Guard at, std::uint32_t from, std::size_t indent) {
    if (stays(at, from)) return;
    if (is_state(at)) return line(indent, "State := " + std::to_string(state_of(at)) + ";");
    const char* word = "IF ";
    for (; !is_state(at); word = "ELSIF ") {
      const GuardNode& node = automaton_.guards.nodes()[at];
      const std::string& asked = inputs_[node.proposition];
      if (stays(node.high, from)) {
        line(indent, word + ("NOT " + asked) + " THEN");
        guard(node.low, from, indent + 1);
        return line(indent, "END_IF;");
      }
      line(indent, word + asked + " THEN");
      guard(node.high, from, indent + 1);
      at = node.low;
    }
    if (!stays(at, from)) {
      line(indent, "ELSE");
      guard(at, from, indent + 1);
    }
    line(indent, "END_IF;");
  }

  static bool stays(Guard at, std::uint32_t from) { return at == guard_of_state(from); }

  void line(std::size_t indent, const std::string& text) {
    text_ += std::string(2 * indent, ' ') + text + "\n";
  }

  const Automaton& automaton_;
  const std::vector<std::string>& inputs_;
  std::unordered_map<Guard, std::size_t> counts_;
  std::string text_;
};

}  // namespace

std::optional<std::string> branches(const Automaton& automaton, const std::vector<std::string>& inputs,
                                    std::size_t most, std::size_t indent) {
  Writer writer(automaton, inputs);
  std::vector<std::uint32_t> left;  // states that are left by some letter
  std::size_t all = 0;
  for (std::uint32_t state = 0; state < automaton.size(); ++state) {
    if (automaton.edges[state] == guard_of_state(state)) continue;
    left.push_back(state);
    all += writer.count(automaton.edges[state], most);
    if (all > most) return std::nullopt;
  }
  if (!left.empty()) writer.states(left, 0, left.size(), indent);
  return writer.take();
}

}  // namespace stepwright::ltl
