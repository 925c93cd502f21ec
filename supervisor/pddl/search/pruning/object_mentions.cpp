#include "supervisor/pddl/search/pruning/object_mentions.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

template <typename T>
void make_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Collects the objects that a part of the task mentions.
class Collector {
 public:
  explicit Collector(const GroundTask& task) : task_(task) {}

  void read(const Condition& condition) {
    for (const int literal : condition.literals) fact(literal / 2);
    for (const Comparison& comparison : condition.comparisons) read(comparison.difference);
    for (const auto& options : condition.choices) {
      for (const Condition& option : options) read(option);
    }
  }
  void read(const GroundExpression& expression) {
    for_each_variable(expression, [this](int v) { variable(v); });
  }
  void read(const GroundOperator& op) {
    read(op.precondition);
    for (const GroundEffect& effect : op.effects) {
      read(effect.when);
      read(effect.cost);
      for (const int f : effect.adds) fact(f);
      for (const int f : effect.deletes) fact(f);
      for (const NumericEffect& numeric : effect.numeric) {
        variable(numeric.variable);
        read(numeric.amount);
      }
    }
  }
  void fact(int f) { note(task_.facts[static_cast<std::size_t>(f)]); }

  std::vector<int> take() {
    make_unique(objects_);
    return std::exchange(objects_, {});
  }

 private:
  void variable(int v) { note(task_.variables[static_cast<std::size_t>(v)]); }
  void note(const Atom& atom) {
    objects_.insert(objects_.end(), atom.arguments.begin(), atom.arguments.end());
  }

  const GroundTask& task_;
  std::vector<int> objects_;
};

}  // namespace

// Symbols of facts and of fluents have numbers of their own; a place in an argument list counts as well.
void ObjectMentions::enter(const Atom& atom, int index, int symbol, std::vector<int> Entry::*list) {
  for (std::size_t place = 0; place < atom.arguments.size(); ++place) {
    Entry& entry = entries_[static_cast<std::size_t>(atom.arguments[place])];
    entry.pattern.emplace_back(symbol, static_cast<int>(place));
    if ((entry.*list).empty() || (entry.*list).back() != index) (entry.*list).push_back(index);
    for (const int other : atom.arguments) {
      if (other != atom.arguments[place]) entry.neighbours.push_back(other);
    }
  }
}

ObjectMentions::ObjectMentions(const GroundTask& task) : entries_(task.definition->objects.size()) {
  for (std::size_t f = 0; f < task.facts.size(); ++f)
    enter(task.facts[f], static_cast<int>(f), 2 * task.facts[f].symbol, &Entry::facts);
  for (std::size_t v = 0; v < task.variables.size(); ++v)
    enter(task.variables[v], static_cast<int>(v), 2 * task.variables[v].symbol + 1, &Entry::variables);
  for (Entry& entry : entries_) {
    std::sort(entry.pattern.begin(), entry.pattern.end());
    make_unique(entry.neighbours);
  }
  Collector collector(task);
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    collector.read(task.operators[i]);
    objects_.push_back(collector.take());
    for (const int object : objects_.back())
      entries_[static_cast<std::size_t>(object)].operators.push_back(static_cast<int>(i));
  }
  collector.read(task.goal);
  collector.read(task.potential);
  for (const int object : collector.take()) entries_[static_cast<std::size_t>(object)].by_goal = true;
  for (const GroundAxiom& axiom : task.axioms) {
    collector.fact(axiom.fact);
    collector.read(axiom.body);
  }
  for (const int object : collector.take()) entries_[static_cast<std::size_t>(object)].by_axiom = true;
}

bool ObjectMentions::apart(int a, int b) const {
  const auto& neighbours = at(a).neighbours;
  return !std::binary_search(neighbours.begin(), neighbours.end(), b);
}

}  // namespace stepwright::pddl
