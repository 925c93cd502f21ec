#include "tests/unit/supervisor/htn/search/random_htn.h"

#include <utility>

namespace stepwright::htn::test {
namespace {

constexpr int kFirstObject = 10;
constexpr std::size_t kMostNodes = 3000;

class Maker {
 public:
  explicit Maker(std::mt19937& random) : random_(random) {}

  RandomHtn run() {
    htn_.objects = 1 + below(2);
    for (int i = 0, count = 2 + below(3); i < count; ++i) htn_.arities.push_back(below(2));
    for (int i = 0, count = 1 + below(3); i < count; ++i) htn_.task_arities.push_back(below(2));
    for (int i = 0, count = 2 + below(2); i < count; ++i) {
      RandomAction action;
      action.parameters = below(2);
      action.condition = literals(below(2), action.parameters);
      action.effect = literals(1 + below(2), action.parameters);
      htn_.actions.push_back(std::move(action));
    }
    for (int i = 0, count = static_cast<int>(htn_.task_arities.size()) + below(4); i < count; ++i) method(i);
    htn_.root = subtasks(1 + below(2), 0);
    htn_.initial = literals(below(3), 0);
    htn_.goal = literals(below(3), 0);
    return std::move(htn_);
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }

  void method(int number) {
    const int tasks = static_cast<int>(htn_.task_arities.size());
    RandomMethod method;
    method.task = number < tasks ? number : below(tasks);
    method.parameters = htn_.task_arities[static_cast<std::size_t>(method.task)] + (below(3) == 0 ? 1 : 0);
    method.condition = literals(below(3), method.parameters);
    method.subtasks = subtasks(below(4), method.parameters);
    htn_.methods.push_back(std::move(method));
  }

  int argument(int parameters) {
    const int chosen = below(parameters + 1);
    return chosen < parameters ? chosen : kFirstObject + below(htn_.objects);
  }

  std::vector<Literal> literals(int count, int parameters) {
    std::vector<Literal> list;
    for (int i = 0; i < count; ++i) {
      Literal literal;
      literal.predicate = below(static_cast<int>(htn_.arities.size()));
      if (htn_.arities[static_cast<std::size_t>(literal.predicate)] == 1)
        literal.argument = argument(parameters);
      literal.positive = below(3) != 0;
      list.push_back(literal);
    }
    return list;
  }

  std::vector<RandomSubtask> subtasks(int count, int parameters) {
    std::vector<RandomSubtask> list;
    for (int i = 0; i < count; ++i) {
      RandomSubtask subtask;
      subtask.action = below(2) == 0;
      subtask.symbol =
          below(static_cast<int>(subtask.action ? htn_.actions.size() : htn_.task_arities.size()));
      const auto at = static_cast<std::size_t>(subtask.symbol);
      const int arity = subtask.action ? htn_.actions[at].parameters : htn_.task_arities[at];
      if (arity == 1) subtask.argument = argument(parameters);
      list.push_back(subtask);
    }
    return list;
  }

  std::mt19937& random_;
  RandomHtn htn_;
};

std::string argument_text(int argument) {
  if (argument < 0) return "";
  return argument >= kFirstObject ? " o" + std::to_string(argument - kFirstObject)
                                  : " ?v" + std::to_string(argument);
}

std::string text_of(const std::vector<Literal>& literals, bool positive_only = false) {
  std::string text = positive_only ? "" : "(and";
  for (const Literal& literal : literals) {
    const std::string atom = "(p" + std::to_string(literal.predicate) + argument_text(literal.argument) + ")";
    if (literal.positive) {
      text += " " + atom;
    } else if (!positive_only) {
      text += " (not " + atom + ")";
    }
  }
  return positive_only ? text : text + ")";
}

std::string parameters_text(int count) {
  std::string text = "(";
  for (int i = 0; i < count; ++i) text += (i > 0 ? " ?v" : "?v") + std::to_string(i);
  return text + ")";
}

std::string text_of(const std::vector<RandomSubtask>& subtasks) {
  std::string text = "(and";
  for (const RandomSubtask& subtask : subtasks)
    text += std::string(subtask.action ? " (a" : " (t") + std::to_string(subtask.symbol) +
            argument_text(subtask.argument) + ")";
  return text + ")";
}

using Bits = std::uint32_t;

struct GroundTask {
  bool action = false;
  int symbol = 0;
  int object = -1;
  friend auto operator<=>(const GroundTask&, const GroundTask&) = default;
};

struct Node {
  std::vector<GroundTask> network;  // the first task at the end
  Bits state = 0;
  friend auto operator<=>(const Node&, const Node&) = default;
};

class Rules {
 public:
  explicit Rules(const RandomHtn& htn) : htn_(htn) {}

  static int value(int argument, const std::vector<int>& binding) {
    if (argument < 0) return -1;
    return argument >= kFirstObject ? argument - kFirstObject : binding[static_cast<std::size_t>(argument)];
  }

  static Bits bit(const Literal& literal, const std::vector<int>& binding) {
    const int object = value(literal.argument, binding);
    return Bits{1} << (3 * literal.predicate + object + 1);
  }

  static bool holds(const std::vector<Literal>& literals, const std::vector<int>& binding, Bits state) {
    for (const Literal& literal : literals)
      if (((state & bit(literal, binding)) != 0) != literal.positive) return false;
    return true;
  }

  Node root() const {
    Node node;
    push(htn_.root, {}, node.network);
    for (const Literal& literal : htn_.initial)
      if (literal.positive) node.state |= bit(literal, {});
    return node;
  }

  static void push(const std::vector<RandomSubtask>& subtasks, const std::vector<int>& binding,
                   std::vector<GroundTask>& network) {
    for (std::size_t i = subtasks.size(); i-- > 0;)
      network.push_back({subtasks[i].action, subtasks[i].symbol, value(subtasks[i].argument, binding)});
  }

  // The nodes that follow a node.
  std::vector<Node> next(const Node& node) const {
    std::vector<Node> nodes;
    const GroundTask task = node.network.back();
    Node rest = node;
    rest.network.pop_back();
    if (task.action) {
      const RandomAction& action = htn_.actions[static_cast<std::size_t>(task.symbol)];
      if (!holds(action.condition, {task.object}, node.state)) return nodes;
      for (const Literal& literal : action.effect)
        if (!literal.positive) rest.state &= ~bit(literal, {task.object});
      for (const Literal& literal : action.effect)
        if (literal.positive) rest.state |= bit(literal, {task.object});
      nodes.push_back(std::move(rest));
      return nodes;
    }
    for (const RandomMethod& method : htn_.methods) {
      if (method.task != task.symbol) continue;
      const int bound = htn_.task_arities[static_cast<std::size_t>(method.task)];
      const int choices = method.parameters > bound ? htn_.objects : 1;
      for (int choice = 0; choice < choices; ++choice) {
        std::vector<int> binding;
        if (bound == 1) binding.push_back(task.object);
        if (method.parameters > bound) binding.push_back(choice);
        if (!holds(method.condition, binding, node.state)) continue;
        Node child = rest;
        push(method.subtasks, binding, child.network);
        nodes.push_back(std::move(child));
      }
    }
    return nodes;
  }

  bool is_goal(const Node& node) const { return node.network.empty() && holds(htn_.goal, {}, node.state); }

 private:
  const RandomHtn& htn_;
};

class Enumerator {
 public:
  Enumerator(const RandomHtn& htn, std::size_t most, std::size_t most_steps, bool (*allowed)(const Sequence&))
      : rules_(htn), most_(most), left_(most_steps), allowed_(allowed) {}

  Enumeration run() {
    visit(rules_.root());
    return std::move(found_);
  }

 private:
  using Key = std::pair<Node, Sequence>;

  void visit(const Node& node) {
    if (left_ == 0) found_.complete = false;
    if (!found_.complete) return;
    --left_;
    if (node.network.empty()) {
      if (rules_.is_goal(node)) found_.plans.insert(actions_);
      return;
    }
    const GroundTask task = node.network.back();
    // The planner's bound is for networks that begin with a task.
    if (!task.action && node.network.size() > most_) return;
    const Key key{node, allowed_ != nullptr ? actions_ : Sequence{}};
    if (!task.action && !path_.insert(key).second) return;
    for (const Node& next : rules_.next(node)) {
      if (task.action) {
        actions_.push_back("a" + std::to_string(task.symbol) +
                           (task.object < 0 ? "" : " o" + std::to_string(task.object)));
        if (allowed_ == nullptr || allowed_(actions_)) visit(next);
        actions_.pop_back();
      } else {
        visit(next);
      }
    }
    if (!task.action) path_.erase(key);
  }

  Rules rules_;
  std::size_t most_;
  std::size_t left_;
  bool (*allowed_)(const Sequence&);
  Enumeration found_;
  Sequence actions_;
  std::set<Key> path_;
};

}  // namespace

RandomHtn random_htn(std::mt19937& random) {
  return Maker(random).run();
}

std::string domain_text(const RandomHtn& htn) {
  std::string text = "(define (domain random)\n  (:predicates (outside)";
  for (std::size_t i = 0; i < htn.arities.size(); ++i)
    text += " (p" + std::to_string(i) + (htn.arities[i] == 1 ? " ?v0)" : ")");
  text += ")\n";
  for (std::size_t i = 0; i < htn.task_arities.size(); ++i)
    text += "  (:task t" + std::to_string(i) + " :parameters " + parameters_text(htn.task_arities[i]) + ")\n";
  for (std::size_t i = 0; i < htn.methods.size(); ++i) {
    const RandomMethod& method = htn.methods[i];
    const int arity = htn.task_arities[static_cast<std::size_t>(method.task)];
    text += "  (:method m" + std::to_string(i) + " :parameters " + parameters_text(method.parameters) +
            " :task (t" + std::to_string(method.task) + (arity == 1 ? " ?v0)" : ")") + " :precondition " +
            text_of(method.condition) + " :ordered-subtasks " + text_of(method.subtasks) + ")\n";
  }
  for (std::size_t i = 0; i < htn.actions.size(); ++i) {
    const RandomAction& action = htn.actions[i];
    std::string condition = text_of(action.condition);
    if (htn.external) condition.insert(condition.size() - 1, " (outside)");
    text += "  (:action a" + std::to_string(i) + " :parameters " + parameters_text(action.parameters) +
            " :precondition " + condition + " :effect " + text_of(action.effect) + ")\n";
  }
  return text + ")\n";
}

std::string problem_text(const RandomHtn& htn) {
  std::string text = "(define (problem random)\n  (:domain random)\n  (:objects";
  for (int i = 0; i < htn.objects; ++i) text += " o" + std::to_string(i);
  std::string goal = text_of(htn.goal);
  if (htn.external) goal.insert(goal.size() - 1, " (outside)");
  return text + ")\n  (:htn :parameters () :ordered-subtasks " + text_of(htn.root) + ")\n  (:init" +
         text_of(htn.initial, true) + ")\n  (:goal " + goal + "))\n";
}

BruteForce explore(const RandomHtn& htn, std::size_t most) {
  const Rules rules(htn);
  BruteForce found;
  std::set<Node> met{rules.root()};
  std::vector<Node> open{rules.root()};
  while (!open.empty()) {
    const Node node = std::move(open.back());
    open.pop_back();
    if (node.network.empty()) {
      found.solvable = found.solvable || rules.is_goal(node);
      continue;
    }
    if (!node.network.back().action && node.network.size() > most) {
      found.cut = true;
      continue;
    }
    for (Node& next : rules.next(node))
      if (met.insert(next).second) open.push_back(std::move(next));
    if (met.size() > kMostNodes) {
      found.complete = false;
      return found;
    }
  }
  return found;
}

Enumeration enumerate(const RandomHtn& htn, std::size_t most, std::size_t most_steps,
                      bool (*allowed)(const Sequence&)) {
  return Enumerator(htn, most, most_steps, allowed).run();
}

}  // namespace stepwright::htn::test
