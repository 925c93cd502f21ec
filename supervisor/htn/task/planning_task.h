#pragma once

// A hierarchical planning task: a domain and a problem in HDDL, read and checked, every name a number.
//
// Thread rule: immutable after reading. Variables live in numbered slots: the parameters of an action or a
// method take 0, 1, ...; every quantifier inside takes slots of its own, so that a binding is a plain vector
// of objects.
//
//   auto task = read_task({"domain.hddl", domain}, {"problem.hddl", problem});
//   if (!task) return forward(task);
//   task->methods[task->root].subtasks      // what is to be done

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "supervisor/lisp/place.h"

namespace stepwright::htn {

using lisp::Place;

// The slot of a variable, or ~object of an object.
using Term = int;

constexpr Term term_of_object(int object) {
  return ~object;
}

// The object that a term means; -1 if its slot is not bound.
inline int object_of(Term term, const std::vector<int>& binding) {
  return term < 0 ? ~term : binding[static_cast<std::size_t>(term)];
}

struct Variable {
  std::string name;  // with its question mark
  int type = 0;
  int slot = 0;
};

enum class ConditionKind : std::uint8_t { Atom, Equal, OfType, And, Or, Not, Imply, Forall, Exists };

// A condition that the symbolic state decides. An empty And is true.
struct Condition {
  ConditionKind kind = ConditionKind::And;
  int symbol = -1;          // Atom: the predicate; OfType: the type
  std::vector<Term> terms;  // Atom; Equal: two; OfType: one
  std::vector<Condition> parts;
  std::vector<Variable> variables;  // Forall, Exists
};

// An atom, or its negation, that is evaluated outside of the symbolic state.
struct ExternalLiteral {
  int predicate = 0;
  std::vector<Term> terms;
  bool positive = true;
};

// An atom that is added or deleted, for all objects of the variables where the condition holds.
struct Effect {
  std::vector<Variable> variables;
  Condition condition;
  bool add = true;
  int predicate = 0;
  std::vector<Term> terms;
};

// What an action adds to total-cost: a number, or a function of objects that never changes.
struct Amount {
  double number = 0.0;
  int function = -1;
  std::vector<Term> terms;
};

struct Action {
  std::string name;
  Place at;
  std::vector<Variable> parameters;
  int slots = 0;  // parameters and all nested variables
  Condition condition;
  std::vector<ExternalLiteral> external_conditions;  // in the order of the text
  std::vector<Effect> effects;
  std::vector<ExternalLiteral> external_effects;  // in the order of the text
  std::vector<Amount> costs;
};

struct Subtask {
  bool primitive = false;
  int symbol = 0;  // an action, or a compound task
  std::vector<Term> terms;
};

struct Method {
  std::string name;
  Place at;
  int task = 0;
  std::vector<Variable> parameters;
  int slots = 0;
  std::vector<Term> task_terms;
  Condition condition;  // precondition, constraints, and types that subtasks ask for
  std::vector<ExternalLiteral> external_conditions;
  std::vector<Subtask> subtasks;  // in the order in which they are done
};

struct CompoundTask {
  std::string name;
  Place at;
  std::vector<int> parameter_types;
  std::vector<int> methods;  // in the order of the text
};

// A predicate or a function.
struct Symbol {
  std::string name;
  std::vector<int> parameter_types;
  bool changes = false;   // some action has it in an effect
  bool external = false;  // evaluated outside of the symbolic state
};

struct Object {
  std::string name;
  std::vector<int> types;  // one; of an either: all of them
};

// A ground predicate or function.
struct GroundAtom {
  int symbol = 0;
  std::vector<int> objects;
  friend auto operator<=>(const GroundAtom&, const GroundAtom&) = default;
};

struct Type {
  std::string name;
  std::vector<bool> below;   // of the declared types: the type itself and its subtypes
  std::vector<int> objects;  // ascending
};

struct PlanningTask {
  std::vector<std::string> files;
  std::string domain_name;
  std::string problem_name;
  std::vector<Type> types;  // [0] is object
  std::vector<Object> objects;
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<Action> actions;
  std::vector<CompoundTask> tasks;  // the last one stands for the problem's ":htn"
  std::vector<Method> methods;
  std::size_t root = 0;  // the method of the last task
  std::vector<GroundAtom> facts;
  std::map<GroundAtom, double> values;
  Condition goal;
  int goal_slots = 0;
  std::vector<ExternalLiteral> external_goals;

  bool is_of_type(int object, int type) const;
  // Whether every object of the one type fits where one of the other is asked for.
  bool is_subtype(int type, int of) const;
  bool overlap(int type, int other) const;
};

}  // namespace stepwright::htn
