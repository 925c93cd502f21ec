#include "cell/monitors/cell_monitors.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "runtime/ground/files/files.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/monitor/monitor_block.h"
#include "supervisor/ltl/syntax/formula_bytes.h"

namespace stepwright::cell_monitors {
namespace {

constexpr std::size_t kMostWords = 200;

// A name as viewers show it: main.pump.on, %IX0.0, main.row[2].
bool is_tag(const std::string& name) {
  return std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '%' || c == '[' || c == ']';
  });
}

// The formula without its comments.
std::string in_one_line(const std::string& text) {
  std::string line;
  bool quoted = false, comment = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"' && !comment) quoted = !quoted;
    const bool duration = k > 0 && (text[k - 1] == 'T' || text[k - 1] == 't') && k + 1 < text.size() &&
                          std::isdigit(static_cast<unsigned char>(text[k + 1])) != 0;
    if (c == '#' && !quoted && !duration) comment = true;
    if (c == '\n') comment = false;
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (comment || (blank && (line.empty() || line.back() == ' '))) continue;
    line += blank ? ' ' : c;
  }
  while (line.ends_with(' ')) line.pop_back();
  return line.size() > kMostWords ? line.substr(0, kMostWords) + "..." : line;
}

// As `ltl check --let` writes it: "!main.stop".
std::string in_st(const std::string& expression) {
  const std::size_t first = expression.find_first_not_of(' ');
  if (first == std::string::npos || expression[first] != '!') return expression;
  return "NOT (" + expression.substr(first + 1) + ")";
}

class Maker {
 public:
  Maker(const config::MonitorConfig& config, result::Diagnostics& problems)
      : config_(config), problems_(problems) {}

  std::optional<CellMonitor> run() {
    std::string text = config_.formula;
    if (!config_.formula_file.empty()) {
      auto read = files::read_file(config_.formula_file.string(), ltl::kMostFormulaBytes);
      if (!read) return fail(std::move(read.error()));
      text = *std::move(read);
    }
    auto formula = ltl::parse_formula(text, file());
    if (!formula) return fail(std::move(formula.error()));
    auto automaton = ltl::monitor_automaton(*formula, {}, file());
    if (!automaton) return fail(std::move(automaton.error()));
    CellMonitor monitor;
    monitor.words = in_one_line(text);
    fill(*automaton, monitor);
    if (!write(*formula, *automaton, monitor)) return std::nullopt;
    return monitor;
  }

 private:
  // Places in a formula of the configuration are told from its beginning.
  std::string file() const { return config_.formula_file.string(); }

  std::nullopt_t fail(result::Diagnostics found) {
    for (result::Diagnostic& each : found) {
      if (each.where.file.empty()) {
        if (each.where.line > 0)
          each.message += " (at " + std::to_string(each.where.line) + ":" +
                          std::to_string(each.where.column) + " of the formula)";
        each.where = config_.where;
      }
      problems_.push_back(std::move(each));
    }
    return std::nullopt;
  }

  void fill(const ltl::Monitor& made, CellMonitor& monitor) const {
    const auto& verdicts = made.automaton.verdicts;
    monitor.name = config_.name;
    monitor.states = made.automaton.size();
    monitor.propositions = made.automaton.propositions;
    monitor.can_fail = std::ranges::find(verdicts, ltl::Verdict::False) != verdicts.end();
    monitor.can_be_satisfied = std::ranges::find(verdicts, ltl::Verdict::True) != verdicts.end();
    monitor.may_never_tell = made.may_never_tell;
    monitor.event = config_.event;
    monitor.safe_state = config_.safe_state;
    monitor.alarm = config_.alarm;
    monitor.where = config_.where;
  }

  // Of each proposition; empty for that of a timer.
  bool meanings(const ltl::Formula& formula, std::vector<std::string>& expressions,
                std::vector<result::Location>& places) {
    bool sound = true;
    for (std::uint32_t k = 0; k < formula.proposition_count(); ++k) {
      const std::string& name = formula.tree.propositions[k];
      const auto given = std::ranges::find(config_.let, name, &config::PropositionMeaning::name);
      places.push_back(given != config_.let.end() ? given->where : config_.where);
      const bool timer = timed_of(formula.tree, k) != nullptr;
      expressions.push_back(timer ? "" : given != config_.let.end() ? in_st(given->expression) : name);
      if (timer || given != config_.let.end() || is_tag(name)) continue;
      problems_.push_back({"C0556", result::Severity::Error, config_.where,
                           "'" + name + "' of monitor '" + config_.name + "' is no tag",
                           "say in let what it means"});
      sound = false;
    }
    for (const config::PropositionMeaning& each : config_.let) {
      const auto& names = formula.tree.propositions;
      if (std::ranges::find(names, each.name) != names.end()) continue;
      problems_.push_back(
          {"C0557", result::Severity::Error, each.where,
           "the formula of monitor '" + config_.name + "' has no proposition '" + each.name + "'", ""});
      sound = false;
    }
    return sound;
  }

  bool write(const ltl::Formula& formula, const ltl::Monitor& made, CellMonitor& monitor) {
    std::vector<std::string> expressions;
    std::vector<result::Location> places;
    if (!meanings(formula, expressions, places)) return false;
    graphic::NameSet names;
    ltl::BlockOptions options;
    options.name = program_name(config_.name);
    names.insert(options.name);
    for (const std::string_view each : ltl::program_names()) names.insert(each);
    for (const std::string& each : formula.tree.propositions)
      options.inputs.push_back(names.unique(graphic::is_keyword(each) ? each + "_in" : each));
    options.about = "monitor " + config_.name + ": " + monitor.words;
    options.formula = &formula.tree;
    options.on_changes = ltl::stutter_report(formula).kind != ltl::StutterKind::Invariant;
    auto program = ltl::monitor_program(made.automaton, expressions, config_.safe_state, options);
    if (!program) {
      fail(std::move(program.error()));
      return false;
    }
    driver::Watcher& watcher = monitor.program;
    watcher.name = options.name;
    const auto lines = static_cast<std::size_t>(std::ranges::count(program->text, '\n')) + 1;
    watcher.origins.assign(lines, config_.where);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (program->lines[k] == 0) continue;
      watcher.origins[program->lines[k] - 1] = places[k];
      ++watcher.outside_reads;
    }
    watcher.text = std::move(program->text);
    watcher.states = {
        {"Undecided", "Undecided", monitor.words}, {"Satisfied", "Satisfied"}, {"Failed", "Failed"}};
    return true;
  }

  const config::MonitorConfig& config_;
  result::Diagnostics& problems_;
};

}  // namespace

result::Result<std::vector<CellMonitor>> cell_monitors(const config::CellConfig& config) {
  std::vector<CellMonitor> monitors;
  result::Diagnostics problems;
  for (const config::MonitorConfig& each : config.monitors)
    if (auto made = Maker(each, problems).run()) monitors.push_back(*std::move(made));
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  // What stops the scan leaves those behind it without their letter.
  std::ranges::stable_partition(monitors, [](const CellMonitor& each) { return !each.safe_state; });
  return monitors;
}

std::vector<driver::Watcher> watchers_of(const std::vector<CellMonitor>& monitors) {
  std::vector<driver::Watcher> watchers;
  for (const CellMonitor& each : monitors) watchers.push_back(each.program);
  return watchers;
}

std::string sentence_of(const CellMonitor& monitor) {
  std::string text = monitor.words + ": " + std::to_string(monitor.states) + " states over ";
  for (std::size_t k = 0; k < monitor.propositions.size(); ++k)
    text += (k == 0 ? "" : ", ") + monitor.propositions[k];
  if (!monitor.can_fail) return text + "; it cannot fail";
  text += "; when it fails: ";
  std::string actions;
  const auto add = [&](bool wanted, const char* word) {
    if (wanted) actions += (actions.empty() ? "" : ", ") + std::string(word);
  };
  add(monitor.alarm, "alarm");
  add(monitor.safe_state, "safe state");
  add(monitor.event, "event to the supervisor");
  text += actions.empty() ? "nothing but its tags" : actions;
  if (monitor.may_never_tell) text += "; some runs leave it undecided for ever";
  return text;
}

}  // namespace stepwright::cell_monitors
