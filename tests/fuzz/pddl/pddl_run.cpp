#include "tests/fuzz/pddl/pddl_run.h"

#include <algorithm>
#include <cctype>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/executor.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::fuzz::pddl {
namespace {

using namespace stepwright::pddl;

// Everything is bounded here: quantifiers multiply, and a random text may have many.
constexpr int kMostQuantifiers = 3;
constexpr int kMostParameters = 4;
constexpr std::size_t kMostObjects = 40;
constexpr int kMostDerivedParameters = 2;
constexpr int kMostBlanks = 140;
constexpr int kMostChecks = 20;
constexpr int kMostWalk = 6;

struct Parts {
  std::string domain, problem, plan;
};

Parts split(std::string_view input) {
  Parts parts;
  const std::size_t problem = input.find(";;problem\n");
  parts.domain = input.substr(0, problem);
  if (problem == std::string_view::npos) return parts;
  const std::size_t plan = input.find(";;plan\n", problem);
  parts.problem = input.substr(problem, plan == std::string_view::npos ? plan : plan - problem);
  if (plan != std::string_view::npos) parts.plan = input.substr(plan);
  return parts;
}

int count(std::string text, std::string_view word) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  int found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

// Deriving facts enumerates objects, and that happens while reading.
bool reads_quickly(const Parts& parts) {
  const std::string& domain = parts.domain;
  for (std::size_t at = domain.find(":derived"); at != std::string::npos;
       at = domain.find(":derived", at + 1)) {
    if (count(domain.substr(at, domain.find(')', at) - at), "?") > kMostDerivedParameters) return false;
  }
  if (count(domain, ":derived") == 0) return true;
  return domain.size() + parts.problem.size() < 4000 &&
         count(domain, "forall") + count(domain, "exists") <= kMostQuantifiers &&
         count(parts.problem, " ") + count(parts.problem, "\n") <= kMostBlanks;
}

bool small(const Definition& definition, const Parts& parts) {
  const int quantifiers =
      count(parts.domain + parts.problem, "forall") + count(parts.domain + parts.problem, "exists");
  const auto few = [](const auto& schema) { return schema.parameters.size() <= kMostParameters; };
  return quantifiers <= 2 * kMostQuantifiers && definition.objects.size() <= kMostObjects &&
         std::all_of(definition.actions.begin(), definition.actions.end(), few) &&
         std::all_of(definition.axioms.begin(), definition.axioms.end(), few);
}

std::string check_diagnostics(const result::Diagnostics& diagnostics, const Parts& parts) {
  if (diagnostics.empty()) return "refused without a diagnostic";
  const auto lines = [](const std::string& text) {
    return static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  };
  for (const result::Diagnostic& d : diagnostics) {
    const bool code =
        d.code.size() == 5 && d.code[0] == 'P' &&
        std::all_of(d.code.begin() + 1, d.code.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!code || d.message.empty()) return "a diagnostic without code or message: " + result::to_string(d);
    const std::string& text = d.where.file == "domain"    ? parts.domain
                              : d.where.file == "problem" ? parts.problem
                                                          : parts.plan;
    if (d.where.file.empty() || d.where.line == 0 || d.where.column == 0 || d.where.line > lines(text)) {
      return "a diagnostic without a place: " + result::to_string(d);
    }
  }
  return {};
}

// What is printed is read back as the same.
std::string check_printing(const Task& task) {
  std::string goal = "(and";
  for (const std::string& part : task.goals()) goal += " " + part;
  const auto again = task.with_goal(goal + ")");
  if (!again) {
    const bool deep = again.error().front().code == "P0006";
    return deep ? std::string() : "a printed goal is not read back: " + result::to_string(again.error());
  }
  if (again->goals() != task.goals()) return "a printed goal is read back as another: " + goal + ")";
  const auto same = task.with_initial(task.initial());
  if (!same) return "the initial state is not accepted: " + result::to_string(same.error());
  return same->initial() == task.initial() ? std::string() : "the initial state changes when it is set";
}

std::string compare(const Definition& definition, const GroundTask& ground, const StateSpace& space,
                    const std::vector<Word>& state, const LiftedState& lifted) {
  for (std::size_t f = 0; f < ground.facts.size(); ++f) {
    if (space.fact(state.data(), static_cast<int>(f)) == (lifted.facts.count(ground.facts[f]) != 0)) continue;
    return "the executor and the ground task differ in " + fact_name(definition, ground.facts[f]);
  }
  for (const FactGroup& group : ground.groups) {
    const auto held = std::count_if(group.facts.begin(), group.facts.end(),
                                    [&](int fact) { return space.fact(state.data(), fact); });
    if (held > 1 || (group.exactly_one && held != 1)) {
      return "a group is broken: " +
             fact_name(definition, ground.facts[static_cast<std::size_t>(group.facts[0])]);
    }
  }
  return {};
}

std::string walk(const Task& task, const GroundTask& ground) {
  const Definition& definition = task.definition();
  const StateSpace space(ground);
  std::vector<Word> state = space.initial();
  std::vector<Word> next = state;
  Executor executor(definition, initial_state(definition));
  std::vector<int> operators;
  for (int step = 0; step <= kMostWalk; ++step) {
    std::string finding = compare(definition, ground, space, state, executor.state());
    if (!finding.empty()) return finding;
    space.applicable(state.data(), operators);
    bool moved = false;
    for (std::size_t i = 0; i < operators.size() && !moved; ++i) {
      // Another operator in every step.
      const int chosen = operators[(i + static_cast<std::size_t>(step) * 7) % operators.size()];
      const GroundOperator& op = ground.operators[static_cast<std::size_t>(chosen)];
      double cost = 0.0;
      if (!space.apply(op, state.data(), next.data(), cost)) continue;
      if (const auto failure = executor.step(action_of(ground, op))) {
        return "the executor refuses " + model::to_string(action_of(ground, op)) + ": " + failure->message;
      }
      std::swap(state, next);
      moved = true;
    }
    if (!moved) return {};
  }
  return {};
}

}  // namespace

Run run(std::string_view input) {
  Run run;
  const Parts parts = split(input);
  if (!reads_quickly(parts)) return run;
  const auto task = parse_task({"domain", parts.domain}, {"problem", parts.problem});
  if (!task) {
    run.diagnostics = task.error().size();
    run.finding = check_diagnostics(task.error(), parts);
    return run;
  }
  run.parsed = true;
  if (!small(task->definition(), parts)) return run;
  run.finding = check_printing(*task);
  if (!run.finding.empty()) return run;
  int checks = 0;
  const GroundTask ground = ground_task(task->definition(), [&] { return ++checks > kMostChecks; });
  if (ground.cancelled) return run;
  run.grounded = true;
  run.finding = walk(*task, ground);
  const auto plan = parse_plan({"plan", parts.plan});
  if (!plan && run.finding.empty()) run.finding = check_diagnostics(plan.error(), parts);
  if (plan) validate(*task, *plan, KeepStates::Last);
  return run;
}

}  // namespace stepwright::fuzz::pddl
