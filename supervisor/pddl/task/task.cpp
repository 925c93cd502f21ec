#include "supervisor/pddl/task/task.h"

#include <fstream>
#include <string_view>
#include <vector>

#include "runtime/ground/result/utf8_place.h"
#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/semantics/checker.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;  // its tokens take thirty times as much
using result::kByteOrderMark;
constexpr const char* kGoalText = "goal";  // the name of a goal given to with_goal, in diagnostics

}  // namespace

Task::Task(std::shared_ptr<const Definition> definition, result::Diagnostics warnings)
    : definition_(std::move(definition)),
      initial_(name_state(*definition_, initial_state(*definition_))),
      warnings_(std::move(warnings)) {}

const std::string& Task::domain_name() const {
  return definition_->domain_name;
}

const std::string& Task::problem_name() const {
  return definition_->problem_name;
}

std::vector<std::string> Task::goals() const {
  const Formula& goal = definition_->goal;
  if (goal.kind != FormulaKind::And) return {print(*definition_, goal)};
  std::vector<std::string> texts;
  for (const Formula& part : goal.parts) texts.push_back(print(*definition_, part));
  return texts;
}

std::string Task::metric() const {
  return definition_->metric ? print(*definition_, definition_->metric->expression) : std::string();
}

bool Task::maximizes() const {
  return definition_->metric && definition_->metric->maximize;
}

result::Result<Task> Task::with_initial(const State& state) const {
  auto lifted = lift(*definition_, state);
  if (!lifted) return result::forward(lifted);
  auto changed = std::make_shared<Definition>(*definition_);
  changed->facts = std::move(lifted->facts);
  changed->fluents = std::move(lifted->fluents);
  return Task(std::move(changed), warnings_);
}

result::Result<Task> Task::with_goal(std::string_view formula) const {
  auto changed = std::make_shared<Definition>(*definition_);
  // The goal's places are in a text of their own.
  if (changed->files.empty() || changed->files.back() != kGoalText) changed->files.emplace_back(kGoalText);
  Reporter reporter(changed->files);
  const auto file = static_cast<std::uint32_t>(changed->files.size() - 1);
  Formula goal = parse_goal(tokenize(formula, file, reporter), reporter);
  if (reporter.failed()) return tl::unexpected<result::Diagnostics>(reporter.take());
  check_goal(std::move(goal), *changed, reporter);
  if (reporter.failed()) return tl::unexpected<result::Diagnostics>(reporter.take());
  return Task(std::move(changed), warnings_);
}

result::Result<Task> parse_task(const Source& domain, const Source& problem) {
  Reporter reporter({domain.file, problem.file});
  ParsedDomain parsed_domain = parse_domain(tokenize(domain.text, 0, reporter), reporter);
  ParsedProblem parsed_problem = parse_problem(tokenize(problem.text, 1, reporter), reporter);
  // What a broken section declares is missing; complaints about those names would only hide the cause.
  if (reporter.failed()) return tl::unexpected<result::Diagnostics>(reporter.take());
  auto definition =
      std::make_shared<Definition>(check_task(std::move(parsed_domain), std::move(parsed_problem), reporter));
  const bool failed = reporter.failed();
  result::Diagnostics diagnostics = reporter.take();
  if (failed) return tl::unexpected<result::Diagnostics>(std::move(diagnostics));
  return Task(std::move(definition), std::move(diagnostics));
}

result::Result<Source> read_source(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::vector<char> block(std::size_t{1} << 20);
  file.peek();  // a folder can be opened; only reading shows it
  while (file && text.size() <= kMostBytes) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.is_open() || file.bad()) {
    return result::fail("P0001", {path, 0, 0}, "the file cannot be read", "does it exist, and is it a file?");
  }
  if (text.size() > kMostBytes) {
    return result::fail("P0001", {path, 0, 0},
                        "the file is larger than " + std::to_string(kMostBytes >> 20) + " MB",
                        "is this the right file?");
  }
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return Source{path, std::move(text)};
}

result::Result<Task> load_task(const std::string& domain_path, const std::string& problem_path) {
  auto domain = read_source(domain_path);
  auto problem = read_source(problem_path);
  if (!domain && !problem) {
    result::Diagnostics both = domain.error();
    both.insert(both.end(), problem.error().begin(), problem.error().end());
    return tl::unexpected<result::Diagnostics>(std::move(both));
  }
  if (!domain) return result::forward(domain);
  if (!problem) return result::forward(problem);
  return parse_task(*domain, *problem);
}

}  // namespace stepwright::pddl
