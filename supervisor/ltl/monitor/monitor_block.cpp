#include "supervisor/ltl/monitor/monitor_block.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "supervisor/ltl/monitor/branches.h"
#include "supervisor/ltl/monitor/step_table.h"
#include "supervisor/ltl/monitor/timer_text.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::array<std::string_view, 15> kNames = {"Reset",     "Verdict",   "State",  "Since", "Before",
                                                     "Begun",     "Row",       "Next",   "Last",  "Left",
                                                     "Undecided", "Satisfied", "Failed", "Far",   "Made"};
constexpr std::size_t kBlockNames = 9;
constexpr std::uint32_t kNoWay = 65'535;

// Without what ends a comment or begins another one.
std::string in_comment(std::string text) {
  for (std::size_t k = 0; k + 1 < text.size(); ++k)
    if ((text[k] == '*' && text[k + 1] == ')') || (text[k] == '(' && text[k + 1] == '*'))
      text.insert(k + 1, " ");
  for (char& each : text)
    if (static_cast<unsigned char>(each) < ' ') each = ' ';
  return text;
}

// Of the automaton as it is written: tells it from others.
std::uint32_t fingerprint(const std::string& text) {
  std::uint32_t hash = 2'166'136'261u;  // FNV-1a
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 16'777'619u;
  return hash;
}

class Block {
 public:
  // `expressions` of a program, null of a block.
  Block(const Automaton& automaton, const BlockOptions& options,
        const std::vector<std::string>* expressions = nullptr, bool stops = false)
      : automaton_(automaton),
        options_(options),
        expressions_(expressions),
        stops_(stops),
        propositions_(automaton.propositions.size()) {}

  std::vector<std::uint32_t> take_lines() { return std::move(lines_); }

  result::Result<std::string> write() {
    if (options_.form != BlockForm::Branches) table_ = step_table(automaton_, options_.most_entries);
    if (!table_ && options_.form == BlockForm::Table)
      return too_large("the table has more than " + std::to_string(options_.most_entries) + " entries");
    const std::size_t indent = options_.on_changes ? 1 : 0;
    const auto step = table_ ? table_step(2 * indent)
                             : branches(automaton_, options_.inputs, options_.most_branches, indent);
    if (!step)
      return too_large("the step has more than " + std::to_string(options_.most_branches) + " branches");
    made_ = fingerprint((table_ ? table_text() : *step) + array_text("Far", far()));
    head();
    if (is_program()) reads();
    reset();
    timers();
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
    add((is_program() ? "PROGRAM " : "FUNCTION_BLOCK ") + options_.name + "\n");
    add(is_program() ? "VAR\n" : "VAR_INPUT\n");
    for (std::size_t k = 0; k < propositions_; ++k)
      if (timer_of(k) == nullptr) add(declaration(k));
    add("  Reset : BOOL;  (* begins anew and reads no letter *)\nEND_VAR\nVAR_OUTPUT\n");
    add("  Verdict : INT := " + verdict_text(automaton_.initial) +
        ";  (* 0: undecided, 1: TRUE, 2: FALSE *)\n");
    add("  State : UINT := " + std::to_string(automaton_.initial) + ";\n");
    add("  Since : UDINT;  (* scans since the state was entered *)\n");
    if (is_program())
      add("  Left : UINT := " + std::to_string(has_way() ? far()[automaton_.initial] : kNoWay) +
          ";  (* transitions to TRUE, at least *)\n");
    add("END_VAR\nVAR\n  Before : UINT;\n");
    for (std::size_t k = 0; k < propositions_; ++k)
      if (const Timed* timed = timer_of(k))
        add(declaration(k) + timer_declarations(*timed, options_.inputs[k]));
    if (is_program()) add("  Made : UDINT := " + std::to_string(made_) + ";  (* of this automaton *)\n");
    if (table_ && table_->looks > 1) add("  Row : UINT;\n");
    if (options_.on_changes) {
      add("  Begun : BOOL;\n");
      if (propositions_ > 0) add("  Last : ARRAY[0.." + std::to_string(propositions_ - 1) + "] OF BOOL;\n");
    }
    add("END_VAR\n");
    if (is_program()) flag_declarations();
    if (table_) add(table_text());
    if (has_way()) add("VAR CONSTANT\n" + array_text("Far", far()) + "END_VAR\n");
  }

  bool is_program() const { return expressions_ != nullptr; }

  const Timed* timer_of(std::size_t proposition) const {
    return options_.formula == nullptr ? nullptr
                                       : timed_of(*options_.formula, static_cast<std::uint32_t>(proposition));
  }

  std::string declaration(std::size_t k) const {
    const std::string& name = automaton_.propositions[k];
    const std::string comment = name == options_.inputs[k] ? "" : "  (* " + in_comment(name) + " *)";
    return "  " + options_.inputs[k] + " : BOOL;" + comment + "\n";
  }

  // Only a program tells it, and only of what can become TRUE.
  bool has_way() const {
    return is_program() && std::ranges::any_of(automaton_.distance,
                                               [](std::uint32_t each) { return each != Automaton::kNever; });
  }

  std::vector<std::uint32_t> far() const {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t each : automaton_.distance) numbers.push_back(std::min(each, kNoWay));
    return numbers;
  }

  // The steps of the chart that viewers see come last: what begins charts anew resets all behind the first
  // one, and what the monitor knows is to outlast it.
  void flag_declarations() {
    add("VAR_OUTPUT\n");
    const Verdict first = automaton_.verdicts[automaton_.initial];
    const auto flag = [&](const char* name, Verdict verdict) {
      add(std::string("  ") + name + " : BOOL" + (first == verdict ? " := TRUE;\n" : ";\n"));
    };
    flag("Undecided", Verdict::Undecided);
    flag("Satisfied", Verdict::True);
    flag("Failed", Verdict::False);
    add("END_VAR\n");
  }

  // What its propositions mean comes first: these statements see no name of the program (Watcher).
  void reads() {
    lines_.assign(propositions_, 0);
    for (std::size_t k = 0; k < propositions_; ++k) {
      if (timer_of(k) != nullptr) continue;
      lines_[k] = static_cast<std::uint32_t>(std::ranges::count(text_, '\n')) + 1;
      add(options_.inputs[k] + " := " + (*expressions_)[k] + ";\n");
    }
  }

  void timers() {
    if (options_.formula == nullptr) return;
    for (const Timed& each : options_.formula->timed)
      add(timer_step(*options_.formula, each, options_.inputs));
  }

  std::string verdict_text(std::uint32_t state) const {
    return std::to_string(static_cast<int>(automaton_.verdicts[state]));
  }

  std::string table_text() const {
    return "VAR CONSTANT\n" + array_text("Next", table_->entries) + "END_VAR\n";
  }

  static std::string array_text(const std::string& name, const std::vector<std::uint32_t>& entries) {
    std::string text = "  " + name + " : ARRAY[0.." + std::to_string(entries.size() - 1) + "] OF UINT := [";
    std::string line = "\n    ";
    for (std::size_t k = 0; k < entries.size(); ++k) {
      line += std::to_string(entries[k]) + (k + 1 < entries.size() ? ", " : "];\n");
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
    const std::string made = std::to_string(made_);
    // A verdict of FALSE whose step is off: charts have begun anew, and so does a monitor that had failed.
    add(is_program()
            ? "IF Reset OR Made <> " + made +
                  " OR (Verdict = 2 AND NOT Failed) THEN\n  Reset := FALSE;\n  Made := " + made + ";\n"
            : std::string("IF Reset THEN\n"));
    add("  State := " + std::to_string(automaton_.initial) +
        ";\n  Verdict := " + verdict_text(automaton_.initial) + ";\n  Since := 0;\n");
    if (options_.on_changes) add("  Begun := FALSE;\n");
    for (std::size_t k = 0; k < propositions_; ++k)
      if (const Timed* timed = timer_of(k)) add(timer_reset(*timed, options_.inputs[k]));
    if (has_way()) add("  Left := Far[State];\n");
    if (is_program()) add(flags("  "));
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

  static std::string flags(const std::string& indent) {
    return indent + "Undecided := Verdict = 0;\n" + indent + "Satisfied := Verdict = 1;\n" + indent +
           "Failed := Verdict = 2;\n";
  }

  // States that are decided are never left: the verdict changes where the state does.
  void tail() {
    add("IF State <> Before THEN\n  Since := 0;\n");
    std::string cases;
    for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
      if (automaton_.verdicts[state] == Verdict::Undecided) continue;
      cases += "    " + std::to_string(state) + ": Verdict := " + verdict_text(state) + ";\n";
    }
    if (!cases.empty()) add("  CASE State OF\n" + cases + "  ELSE\n    Verdict := 0;\n  END_CASE;\n");
    if (has_way()) add("  Left := Far[State];\n");
    add("ELSIF Since < 4294967295 THEN\n  Since := Since + 1;\nEND_IF;\n");
    if (is_program()) add(flags(""));
    if (stops_) add("IF Failed THEN\n  __STOP();\nEND_IF;\n");
    add(is_program() ? "END_PROGRAM\n" : "END_FUNCTION_BLOCK\n");
  }

  const Automaton& automaton_;
  const BlockOptions& options_;
  const std::vector<std::string>* expressions_;
  bool stops_;
  std::size_t propositions_;
  std::uint32_t made_ = 0;
  std::vector<std::uint32_t> lines_;
  std::optional<StepTable> table_;
  std::string text_;
};

}  // namespace

std::span<const std::string_view> block_names() {
  return std::span(kNames).first(kBlockNames);
}

std::span<const std::string_view> program_names() {
  return kNames;
}

result::Result<std::string> monitor_block(const Automaton& automaton, const BlockOptions& options) {
  assert(options.inputs.size() == automaton.propositions.size());
  return Block(automaton, options).write();
}

result::Result<MonitorProgram> monitor_program(const Automaton& automaton,
                                               const std::vector<std::string>& expressions, bool stops,
                                               const BlockOptions& options) {
  assert(expressions.size() == automaton.propositions.size());
  Block block(automaton, options, &expressions, stops);
  auto text = block.write();
  if (!text) return result::forward(text);
  return MonitorProgram{*std::move(text), block.take_lines()};
}

}  // namespace stepwright::ltl
