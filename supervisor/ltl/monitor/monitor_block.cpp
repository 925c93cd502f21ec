#include "supervisor/ltl/monitor/monitor_block.h"

#include <array>
#include <cassert>

#include "supervisor/ltl/monitor/branches.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kSmallTable = 256, kLineWidth = 100;
constexpr std::array<std::string_view, 9> kNames = {"Reset", "Verdict", "State", "Since", "Before",
                                                    "Begun", "Letter",  "Next",  "Last"};

// Without what ends a comment or begins another one.
std::string in_comment(std::string text) {
  for (std::size_t k = 0; k + 1 < text.size(); ++k)
    if ((text[k] == '*' && text[k + 1] == ')') || (text[k] == '(' && text[k + 1] == '*'))
      text.insert(k + 1, " ");
  for (char& each : text)
    if (static_cast<unsigned char>(each) < ' ') each = ' ';
  return text;
}

class Block {
 public:
  Block(const Automaton& automaton, const BlockOptions& options)
      : automaton_(automaton), options_(options), propositions_(automaton.propositions.size()) {}

  result::Result<std::string> write() {
    const bool fits = propositions_ < 16 && entries() <= options_.most_entries;
    const bool table = options_.form == BlockForm::Table ||
                       (options_.form == BlockForm::Automatic && fits && entries() <= kSmallTable);
    if (table && !fits)
      return too_large("the table has more than " + std::to_string(options_.most_entries) + " entries");
    const std::size_t indent = options_.on_changes ? 1 : 0;
    const auto step = table ? table_step(2 * indent)
                            : branches(automaton_, options_.inputs, options_.most_branches, indent);
    if (!step)
      return too_large("the step has more than " + std::to_string(options_.most_branches) + " branches");
    head(table);
    reset();
    add("Before := State;\n");
    if (options_.on_changes) {
      add("IF NOT Begun" + changed() + " THEN\n" + *step + remembered() + "END_IF;\n");
    } else {
      add(*step);
    }
    tail();
    return std::move(text_);
  }

 private:
  std::size_t entries() const { return automaton_.size() << propositions_; }

  tl::unexpected<result::Diagnostics> too_large(const std::string& message) const {
    return result::fail("L0031", {}, message, "watch the parts of the formula with a block each");
  }

  void add(const std::string& text) { text_ += text; }

  void head(bool table) {
    add("(* " + in_comment(options_.about) + " *)\n");
    if (options_.on_changes) add("(* X counts letters: a letter is read when the inputs change. *)\n");
    add("FUNCTION_BLOCK " + options_.name + "\nVAR_INPUT\n");
    for (std::size_t k = 0; k < propositions_; ++k) {
      const std::string& name = automaton_.propositions[k];
      const std::string comment = name == options_.inputs[k] ? "" : "  (* " + in_comment(name) + " *)";
      add("  " + options_.inputs[k] + " : BOOL;" + comment + "\n");
    }
    add("  Reset : BOOL;  (* begins anew and reads no letter *)\nEND_VAR\nVAR_OUTPUT\n");
    add("  Verdict : INT := " + verdict_text(automaton_.initial) +
        ";  (* 0: undecided, 1: TRUE, 2: FALSE *)\n");
    add("  State : UINT := " + std::to_string(automaton_.initial) + ";\n");
    add("  Since : UDINT;  (* scans since the state was entered *)\nEND_VAR\nVAR\n  Before : UINT;\n");
    if (table) add("  Letter : UINT;\n");
    if (options_.on_changes) {
      add("  Begun : BOOL;\n");
      if (propositions_ > 0) add("  Last : ARRAY[0.." + std::to_string(propositions_ - 1) + "] OF BOOL;\n");
    }
    add("END_VAR\n");
    if (table) add(table_text());
  }

  std::string verdict_text(std::uint32_t state) const {
    return std::to_string(static_cast<int>(automaton_.verdicts[state]));
  }

  // Rows of all letters, state by state.
  std::string table_text() const {
    std::string text = "VAR CONSTANT\n  Next : ARRAY[0.." + std::to_string(entries() - 1) + "] OF UINT := [";
    std::string line;
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
      for (Letter letter = 0; letter < Letter{1} << propositions_; ++letter) {
        line += std::to_string(automaton_.next(state, letter)) + ", ";
        if (line.size() < kLineWidth) continue;
        text += "\n    " + line;
        line.clear();
      }
    }
    text += "\n    " + line;
    text.resize(text.find_last_of(','));
    return text + "];\nEND_VAR\n";
  }

  std::optional<std::string> table_step(std::size_t spaces) const {
    std::string letter;
    for (std::size_t k = 0; k < propositions_; ++k) {
      const std::string bit = "BOOL_TO_UINT(" + options_.inputs[k] + ")";
      letter += (k == 0 ? bit : " + " + std::to_string(1u << k) + " * " + bit);
    }
    const std::string begin(spaces, ' ');
    return begin + "Letter := " + (letter.empty() ? "0" : letter) + ";\n" + begin + "State := Next[State * " +
           std::to_string(1u << propositions_) + " + Letter];\n";
  }

  void reset() {
    add("IF Reset THEN\n  State := " + std::to_string(automaton_.initial) +
        ";\n  Verdict := " + verdict_text(automaton_.initial) + ";\n  Since := 0;\n");
    if (options_.on_changes) add("  Begun := FALSE;\n");
    add("  RETURN;\nEND_IF;\n");
  }

  std::string changed() const {
    std::string text;
    for (std::size_t k = 0; k < propositions_; ++k)
      text += " OR (" + options_.inputs[k] + " XOR Last[" + std::to_string(k) + "])";
    return text;
  }

  std::string remembered() const {
    std::string text = "  Begun := TRUE;\n";
    for (std::size_t k = 0; k < propositions_; ++k)
      text += "  Last[" + std::to_string(k) + "] := " + options_.inputs[k] + ";\n";
    return text;
  }

  void tail() {
    add("IF State <> Before THEN\n  Since := 0;\nELSIF Since < 4294967295 THEN\n  Since := Since + "
        "1;\nEND_IF;\n");
    std::string cases;
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
      if (automaton_.verdicts[state] == Verdict::Undecided) continue;
      cases += "  " + std::to_string(state) + ": Verdict := " + verdict_text(state) + ";\n";
    }
    if (!cases.empty()) add("CASE State OF\n" + cases + "ELSE\n  Verdict := 0;\nEND_CASE;\n");
    add("END_FUNCTION_BLOCK\n");
  }

  const Automaton& automaton_;
  const BlockOptions& options_;
  std::size_t propositions_;
  std::string text_;
};

}  // namespace

std::span<const std::string_view> block_names() {
  return kNames;
}

result::Result<std::string> monitor_block(const Automaton& automaton, const BlockOptions& options) {
  assert(options.inputs.size() == automaton.propositions.size());
  return Block(automaton, options).write();
}

}  // namespace stepwright::ltl
