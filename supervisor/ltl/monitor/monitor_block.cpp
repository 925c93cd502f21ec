#include "supervisor/ltl/monitor/monitor_block.h"

#include <array>
#include <cassert>

#include "supervisor/ltl/monitor/branches.h"
#include "supervisor/ltl/monitor/step_table.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::array<std::string_view, 9> kNames = {"Reset", "Verdict", "State", "Since", "Before",
                                                    "Begun", "Row",     "Next",  "Last"};

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
    if (options_.form != BlockForm::Branches) table_ = step_table(automaton_, options_.most_entries);
    if (!table_ && options_.form == BlockForm::Table)
      return too_large("the table has more than " + std::to_string(options_.most_entries) + " entries");
    const std::size_t indent = options_.on_changes ? 1 : 0;
    const auto step = table_ ? table_step(2 * indent)
                             : branches(automaton_, options_.inputs, options_.most_branches, indent);
    if (!step)
      return too_large("the step has more than " + std::to_string(options_.most_branches) + " branches");
    head();
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
  tl::unexpected<result::Diagnostics> too_large(const std::string& message) const {
    return result::fail("L0031", {}, message, "watch the parts of the formula with a block each");
  }

  void add(const std::string& text) { text_ += text; }

  void head() {
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
    if (table_ && table_->looks > 1) add("  Row : UINT;\n");
    if (options_.on_changes) {
      add("  Begun : BOOL;\n");
      if (propositions_ > 0) add("  Last : ARRAY[0.." + std::to_string(propositions_ - 1) + "] OF BOOL;\n");
    }
    add("END_VAR\n");
    if (table_) add(table_text());
  }

  std::string verdict_text(std::uint32_t state) const {
    return std::to_string(static_cast<int>(automaton_.verdicts[state]));
  }

  std::string table_text() const {
    const std::vector<std::uint32_t>& entries = table_->entries;
    std::string text =
        "VAR CONSTANT\n  Next : ARRAY[0.." + std::to_string(entries.size() - 1) + "] OF UINT := [";
    std::string line = "\n    ";
    for (std::size_t k = 0; k < entries.size(); ++k) {
      line += std::to_string(entries[k]) + (k + 1 < entries.size() ? ", " : "];\nEND_VAR\n");
      if (line.size() < kLineWidth) continue;
      text += line;
      line = "\n    ";
    }
    return text + (line.size() > 5 ? line : "");
  }

  std::optional<std::string> table_step(std::size_t spaces) const {
    std::string text, row = "State";
    for (std::uint32_t look = 0; look < table_->looks; ++look) {
      std::string index = row + " * " + std::to_string(1u << table_->width);
      for (std::uint32_t bit = 0; bit < table_->width && look * table_->width + bit < propositions_; ++bit)
        index += " + " + (bit == 0 ? "" : std::to_string(1u << bit) + " * ") + "BOOL_TO_UINT(" +
                 options_.inputs[look * table_->width + bit] + ")";
      row = look + 1 == table_->looks ? "State" : "Row";
      text += std::string(spaces, ' ') + row + " := Next[" + index + "];\n";
    }
    return text;
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
  std::optional<StepTable> table_;
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
