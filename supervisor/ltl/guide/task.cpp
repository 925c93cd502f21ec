#include "supervisor/ltl/guide/task.h"

#include <utility>

#include "runtime/ground/result/closest.h"

namespace stepwright::ltl {

namespace {

// A path through regions has no times: what a timer says is for monitors.
result::Diagnostics deadlines(const SyntaxTree& tree, const std::string& file) {
  result::Diagnostics problems;
  for (const Timed& each : tree.timed) {
    problems.push_back(
        {"L0312",
         result::Severity::Error,
         {file, each.at.line, each.at.column},
         "a task that is planned for takes no deadlines and no durations: " + each.duration,
         "leave it out of the task; a rule of [[monitors]] watches it, or `stepwright ltl monitor`"});
  }
  return problems;
}

result::Diagnostics unknown_places(const Formula& formula, const std::vector<std::string>& places,
                                   const std::string& file) {
  result::Diagnostics problems;
  std::vector<bool> told(formula.tree.propositions.size(), false);
  for (const SyntaxNode& node : formula.tree.nodes) {
    if (node.op != Operator::Name || node.proposition < places.size() || told[node.proposition]) continue;
    told[node.proposition] = true;
    const std::string& name = formula.tree.propositions[node.proposition];
    const std::string* meant = result::closest(name, places, 3);
    result::Diagnostic problem;
    problem.code = "L0311";
    problem.where = {file, node.at.line, node.at.column};
    problem.message = "the floor has no place '" + name + "'";
    problem.hint = meant != nullptr ? "did you mean '" + *meant + "'?" : "name a proposition of the scene";
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace

result::Result<Task> read_task(const std::string& text, const std::vector<std::string>& places,
                               const std::string& file, const BuildOptions& options) {
  auto formula = parse_formula(text, file, places);
  if (!formula) return result::forward(formula);
  if (auto timed = deadlines(formula->tree, file); !timed.empty()) return tl::unexpected(std::move(timed));
  if (auto unknown = unknown_places(*formula, places, file); !unknown.empty())
    return tl::unexpected(std::move(unknown));
  auto automaton = task_automaton(*formula, options, file);
  if (!automaton) return result::forward(automaton);
  return Task{*std::move(formula), *std::move(automaton)};
}

void begin_behind(const std::vector<Letter>& read, Automaton& automaton) {
  for (const Letter letter : read) automaton.initial = automaton.next(automaton.initial, letter);
}

}  // namespace stepwright::ltl
