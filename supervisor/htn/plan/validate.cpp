#include "supervisor/htn/plan/validate.h"

#include <cmath>
#include <map>
#include <optional>

#include "supervisor/htn/plan/judged_state.h"
#include "supervisor/htn/syntax/parser.h"

namespace stepwright::htn {
namespace {

// A node of the plan, and what its parent says that it has to be.
struct Expected {
  std::size_t node = 0;
  std::string name;
  std::vector<std::string> arguments;
};

class Validator {
 public:
  Validator(const ParsedDomain& domain, const ParsedProblem& problem, const Plan& plan,
            const std::set<std::string>& external)
      : problem_(problem), plan_(plan), state_(domain, problem, external) {
    for (const ParsedAction& action : domain.actions) actions_.emplace(action.name, &action);
    for (const ParsedMethod& method : domain.methods) methods_.emplace(method.name, &method);
    for (const ParsedSymbol& task : domain.tasks) tasks_.emplace(task.name, &task);
  }

  Validation run() {
    Validation judged;
    judged.node = plan_.nodes.size();
    const auto fault = walk(judged.node);
    judged.valid = !fault;
    judged.reason = fault.value_or("");
    judged.cost = state_.cost();
    return judged;
  }

 private:
  using Fault = std::optional<std::string>;

  Fault walk(std::size_t& at) {
    if (Fault fault = begin()) return fault;
    std::size_t visited = 0, steps = 0;
    while (!open_.empty()) {
      const Expected expected = std::move(open_.back());
      open_.pop_back();
      at = expected.node;
      if (at >= plan_.nodes.size()) return "a node that is not there";
      // A walk that comes to a node twice would never end.
      if (++visited > plan_.nodes.size()) return "a node stands under two tasks";
      const PlanNode& node = plan_.nodes[at];
      const std::string name = to_string(node);
      if (node.name != expected.name || node.arguments != expected.arguments)
        return name + " is not the subtask that its method has here";
      if (node.method.empty() && (steps >= plan_.steps.size() || plan_.steps[steps++] != at))
        return name + " is not the next step of the plan";
      if (Fault fault = node.method.empty() ? act(node) : decompose(node)) return name + ": " + *fault;
    }
    at = plan_.nodes.size();
    if (visited != plan_.nodes.size() || steps != plan_.steps.size()) return "something is under no task";
    if (!state_.holds(problem_.goal, {})) return "the goal does not hold in the end";
    if (std::abs(state_.cost() - plan_.cost) > 1e-9 * (1.0 + std::abs(plan_.cost)))
      return "the plan costs " + std::to_string(state_.cost());
    return std::nullopt;
  }

  Fault begin() {
    NamedBinding binding;
    if (Fault fault = bind(problem_.parameters, plan_.binding, binding)) return fault;
    if (!state_.holds(problem_.network.constraints, binding)) return "the constraints of ':htn' do not hold";
    return expect(problem_.network, binding, plan_.roots);
  }

  Fault bind(const std::vector<TypedName>& parameters, const std::vector<std::string>& objects,
             NamedBinding& binding) const {
    if (parameters.size() != objects.size()) return "a wrong number of objects";
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!state_.is_of(objects[i], parameters[i]))
        return "'" + objects[i] + "' is not of type '" + parameters[i].type_name + "'";
      binding[parameters[i].name] = objects[i];
    }
    return std::nullopt;
  }

  Fault expect(const ParsedNetwork& network, const NamedBinding& binding,
               const std::vector<std::size_t>& children) {
    if (network.subtasks.size() != children.size()) return "a wrong number of subtasks";
    for (std::size_t i = children.size(); i-- > 0;) {
      const ParsedCall& call = network.subtasks[i].call;
      open_.push_back({children[i], call.name, objects(call, binding)});
    }
    return std::nullopt;
  }

  static std::vector<std::string> objects(const ParsedCall& call, const NamedBinding& binding) {
    std::vector<std::string> names;
    for (const ParsedTerm& term : call.arguments)
      names.push_back(term.variable ? binding.at(term.name) : term.name);
    return names;
  }

  Fault act(const PlanNode& node) {
    const auto action = actions_.find(node.name);
    if (action == actions_.end()) return "there is no such action";
    if (!node.children.empty()) return "an action has no subtasks";
    NamedBinding binding;
    if (Fault fault = bind(action->second->parameters, node.arguments, binding)) return fault;
    if (!state_.holds(action->second->precondition, binding)) return "its precondition does not hold";
    state_.apply(*action->second, binding);
    return std::nullopt;
  }

  Fault decompose(const PlanNode& node) {
    const auto found = methods_.find(node.method);
    if (found == methods_.end()) return "there is no method '" + node.method + "'";
    const ParsedMethod& method = *found->second;
    NamedBinding binding;
    if (Fault fault = bind(method.parameters, node.binding, binding)) return fault;
    if (method.task.name != node.name || objects(method.task, binding) != node.arguments)
      return "the method '" + node.method + "' is not for this task";
    NamedBinding of_task;
    if (Fault fault = bind(tasks_.at(node.name)->parameters, node.arguments, of_task)) return fault;
    if (!state_.holds(method.precondition, binding))
      return "the precondition of the method '" + node.method + "' does not hold";
    if (!state_.holds(method.network.constraints, binding))
      return "the constraints of the method '" + node.method + "' do not hold";
    return expect(method.network, binding, node.children);
  }

  const ParsedProblem& problem_;
  const Plan& plan_;
  JudgedState state_;
  std::map<std::string, const ParsedAction*> actions_;
  std::map<std::string, const ParsedMethod*> methods_;
  std::map<std::string, const ParsedSymbol*> tasks_;
  std::vector<Expected> open_;  // what comes next, from the end
};

}  // namespace

Validation validate(const lisp::Source& domain, const lisp::Source& problem, const Plan& plan,
                    const std::set<std::string>& external) {
  lisp::Reporter reporter({domain.file, problem.file});
  const ParsedDomain parsed_domain = parse_domain(lisp::tokens_of(domain.text, 0, reporter), reporter);
  const ParsedProblem parsed_problem = parse_problem(lisp::tokens_of(problem.text, 1, reporter), reporter);
  return Validator(parsed_domain, parsed_problem, plan, external).run();
}

}  // namespace stepwright::htn
