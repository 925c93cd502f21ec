#include "supervisor/htn/task/resolver.h"

#include <algorithm>

#include "supervisor/htn/task/body_resolver.h"
#include "supervisor/htn/task/external.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kMostParameters = 10'000;  // of a method
constexpr const char* kRootName = ":htn";        // no name of a text

class Resolver {
 public:
  Resolver(const ParsedDomain& domain, const ParsedProblem& problem, const std::vector<std::string>& external,
           lisp::Reporter& reporter)
      : domain_(domain),
        problem_(problem),
        external_(external),
        reporter_(reporter),
        declarations_(task_, names_, reporter),
        bodies_(task_, names_, declarations_, reporter) {}

  PlanningTask run() {
    task_.files = reporter_.files();
    task_.domain_name = domain_.name;
    task_.problem_name = problem_.name;
    declarations_.requirements(domain_.requirements);
    declarations_.requirements(problem_.requirements);
    if (!same_domain() || !declarations_.types(domain_.types)) return std::move(task_);
    if (!declarations_.objects(domain_.constants, problem_.objects)) return std::move(task_);
    declarations_.symbols(domain_.predicates, task_.predicates, names_.predicates, "predicate");
    declarations_.symbols(domain_.functions, task_.functions, names_.functions, "function");
    mark_external(external_, domain_.at, names_, task_, reporter_);
    declare_actions();
    declare_tasks();
    actions();
    methods();
    root();
    initial_state();
    goal();
    return std::move(task_);
  }

 private:
  // What else is wrong with a problem of another domain only hides that it is one.
  bool same_domain() {
    if (problem_.domain.empty() || domain_.name.empty() || problem_.domain == domain_.name) return true;
    reporter_.error("P0111", problem_.domain_at,
                    "the problem is for the domain '" + problem_.domain + "', not for '" + domain_.name + "'",
                    "are these the two files that belong together?");
    return false;
  }

  void declare_actions() {
    for (const ParsedAction& parsed : domain_.actions) {
      if (!names_.actions.emplace(parsed.name, static_cast<int>(task_.actions.size())).second) {
        declarations_.repeated("action", parsed.name, parsed.at);
        continue;
      }
      Action action;
      action.name = parsed.name;
      action.at = parsed.at;
      action.parameters = bodies_.begin(parsed.parameters);
      task_.actions.push_back(std::move(action));
      parsed_actions_.push_back(&parsed);
    }
  }

  void declare_tasks() {
    for (const ParsedSymbol& parsed : domain_.tasks) {
      const bool known = names_.actions.contains(parsed.name);
      if (known || !names_.tasks.emplace(parsed.name, static_cast<int>(task_.tasks.size())).second) {
        declarations_.repeated("task", parsed.name, parsed.at);
        continue;
      }
      task_.tasks.push_back({parsed.name, parsed.at, declarations_.types_of(parsed.parameters), {}});
    }
  }

  void actions() {
    for (std::size_t i = 0; i < task_.actions.size(); ++i) {
      Action action = std::move(task_.actions[i]);
      const ParsedAction& parsed = *parsed_actions_[i];
      bodies_.begin(parsed.parameters);
      action.condition = bodies_.condition(parsed.precondition, action.external_conditions);
      bodies_.effect(parsed.effect, action);
      action.slots = bodies_.slots();
      task_.actions[i] = std::move(action);
    }
  }

  void methods() {
    std::map<std::string, int> seen;
    for (const ParsedMethod& parsed : domain_.methods) {
      if (!seen.emplace(parsed.name, 0).second) declarations_.repeated("method", parsed.name, parsed.at);
      const auto found = names_.tasks.find(parsed.task.name);
      if (found == names_.tasks.end()) {
        unknown_task(parsed);
        continue;
      }
      Method method = body(parsed.name, parsed.at, parsed.parameters, parsed.precondition, parsed.network);
      method.task = found->second;
      Condition types;
      method.task_terms = bodies_.task_terms(parsed.task, method.task, types);
      for (Condition& each : types.parts) method.condition.parts.push_back(std::move(each));
      task_.tasks[static_cast<std::size_t>(method.task)].methods.push_back(
          static_cast<int>(task_.methods.size()));
      task_.methods.push_back(std::move(method));
    }
    for (const CompoundTask& task : task_.tasks) {
      if (!task.methods.empty()) continue;
      reporter_.warning("P0609", task.at, "the task '" + task.name + "' has no method",
                        "no plan can have it");
    }
  }

  void unknown_task(const ParsedMethod& method) {
    const bool action = names_.actions.contains(method.task.name);
    reporter_.error("P0601", method.task.at, "there is no compound task '" + method.task.name + "'",
                    action ? "'" + method.task.name + "' is an action, which needs no method"
                           : "declare it with ':task'");
  }

  Method body(const std::string& name, Place at, const std::vector<TypedName>& parameters,
              const ParsedFormula& precondition, const ParsedNetwork& network) {
    Method method;
    method.name = name;
    method.at = at;
    method.parameters = bodies_.begin(parameters);
    if (parameters.size() > kMostParameters) {
      reporter_.error("P0606", at,
                      "'" + name + "' has more than " + std::to_string(kMostParameters) + " parameters");
    }
    method.condition = bodies_.condition(precondition, method.external_conditions);
    Condition constraints = bodies_.condition(network.constraints, method.external_conditions);
    for (Condition& each : constraints.parts) method.condition.parts.push_back(std::move(each));
    for (const ParsedSubtask& parsed : network.subtasks) {
      Subtask subtask;
      if (bodies_.subtask(parsed.call, subtask, method.condition))
        method.subtasks.push_back(std::move(subtask));
    }
    method.slots = bodies_.slots();
    return method;
  }

  void root() {
    const auto task = static_cast<int>(task_.tasks.size());
    Method method = body(kRootName, problem_.network.at, problem_.parameters, {}, problem_.network);
    method.task = task;
    task_.root = task_.methods.size();
    task_.tasks.push_back({kRootName, problem_.network.at, {}, {static_cast<int>(task_.root)}});
    task_.methods.push_back(std::move(method));
  }

  void initial_state() {
    std::vector<std::pair<GroundAtom, Place>> facts;
    for (const ParsedCall& parsed : problem_.facts) {
      GroundAtom atom;
      if (!bodies_.ground(parsed, false, atom)) continue;
      if (task_.predicates[static_cast<std::size_t>(atom.symbol)].external) {
        reporter_.error("P0607", parsed.at, "'" + parsed.name + "' is evaluated outside and has no facts");
        continue;
      }
      facts.emplace_back(std::move(atom), parsed.at);
    }
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::ranges::stable_sort(facts, less);
    for (const auto& [atom, at] : facts) {
      if (task_.facts.empty() || task_.facts.back() != atom) {
        task_.facts.push_back(atom);
      } else {
        reporter_.warning("P0114", at, "this fact stands twice in ':init'");
      }
    }
    for (const ParsedCall& parsed : problem_.denied) {
      GroundAtom atom;
      if (!bodies_.ground(parsed, false, atom)) continue;
      if (std::ranges::binary_search(task_.facts, atom))
        reporter_.error("P0114", parsed.at, "this fact stands in ':init' both with and without 'not'");
    }
    for (const ParsedValue& parsed : problem_.values) value(parsed);
  }

  void value(const ParsedValue& parsed) {
    GroundAtom atom;
    if (!bodies_.ground(parsed.function, true, atom)) return;
    if (parsed.value < 0.0) {
      reporter_.error("P0608", parsed.function.at, "a cost cannot be less than nothing");
    }
    const auto [place, added] = task_.values.emplace(std::move(atom), parsed.value);
    if (!added && place->second != parsed.value)
      reporter_.error("P0114", parsed.function.at,
                      "'" + parsed.function.name + "' gets two values in ':init'");
  }

  void goal() {
    bodies_.begin({});
    task_.goal = bodies_.condition(problem_.goal, task_.external_goals);
    task_.goal_slots = bodies_.slots();
  }

  const ParsedDomain& domain_;
  const ParsedProblem& problem_;
  const std::vector<std::string>& external_;
  lisp::Reporter& reporter_;
  PlanningTask task_;
  Names names_;
  Declarations declarations_;
  BodyResolver bodies_;
  std::vector<const ParsedAction*> parsed_actions_;
};

}  // namespace

PlanningTask resolve(const ParsedDomain& domain, const ParsedProblem& problem,
                     const std::vector<std::string>& external, lisp::Reporter& reporter) {
  return Resolver(domain, problem, external, reporter).run();
}

}  // namespace stepwright::htn
