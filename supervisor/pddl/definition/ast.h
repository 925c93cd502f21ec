#pragma once

// The checked form of a domain and problem: what the parser builds and the checker completes. Names are lower
// case; after checking, every `index`, `symbol`, `type` and `slot` is resolved.
//
// Thread rule: immutable after checking. Variables live in numbered slots: the parameters of an action take
// 0, 1, ...; every quantifier inside takes slots of its own, so that a binding is a plain vector of objects.

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/lisp/place.h"
#include "supervisor/pddl/definition/numeric_kinds.h"

namespace stepwright::pddl {

// Place::file indexes Definition::files.
using lisp::Place;

struct Term {
  std::string name;  // variables with their question mark
  Place at;
  bool variable = false;
  int index = -1;  // slot of the variable or id of the object
};

// A predicate or function with its arguments.
struct Call {
  std::string name;
  Place at;
  std::vector<Term> arguments;
  int symbol = -1;
};

struct Expression {
  NumericKind kind = NumericKind::Constant;
  Place at;
  double number = 0.0;
  Call call;
  std::vector<Expression> operands;
};

// A declared name with its type: an object, a parameter, a quantified variable.
struct Typed {
  std::string name;
  Place at;
  std::string type_name = "object";  // or "(either a b)"
  Place type_at;
  std::vector<std::string> either;  // the types of an either
  int type = 0;
  int slot = -1;
};

enum class FormulaKind : std::uint8_t { Atom, SameObject, Compare, And, Or, Not, Imply, Forall, Exists };

// An empty And is true.
struct Formula {
  FormulaKind kind = FormulaKind::And;
  Place at;
  Call call;                      // Atom
  std::vector<Term> terms;        // SameObject: two
  Relation relation{};            // Compare
  std::vector<Expression> sides;  // Compare: two
  std::vector<Formula> parts;
  std::vector<Typed> variables;  // Forall, Exists
};

enum class EffectKind : std::uint8_t { And, Add, Delete, Numeric, When, Forall };

struct Effect {
  EffectKind kind = EffectKind::And;
  Place at;
  Call call;                       // Add, Delete: the predicate; Numeric: the fluent
  ChangeKind change{};             // Numeric
  std::vector<Expression> amount;  // Numeric: one
  std::vector<Formula> condition;  // When: one
  std::vector<Effect> parts;       // And; When, Forall: one
  std::vector<Typed> variables;    // Forall
};

struct Action {
  std::string name;
  Place at;
  std::vector<Typed> parameters;
  Formula precondition;
  Effect effect;
  int slots = 0;  // parameters and all nested variables
};

// A predicate or a function.
struct Symbol {
  std::string name;
  Place at;
  std::vector<Typed> parameters;
  bool changes = false;   // some action has it in an effect; derived: some action changes what it depends on
  bool derived = false;   // a predicate that axioms define
  bool assigned = false;  // a function that some action gives a value, whatever it had before
  int layer = 0;          // derived: only layers below may be negated in its axioms
};

// A rule of a derived predicate (PDDL 2.2, ":derived"): the fact over the parameters holds where the body
// does. What no rule derives does not hold.
struct Axiom {
  int predicate = 0;
  Place at;
  std::string name;  // of the predicate
  std::vector<Typed> parameters;
  Formula body;
  int slots = 0;  // parameters and all nested variables
};

struct Type {
  std::string name;
  Place at;
  std::vector<std::string> parent_names;  // mostly one; an object of the type is one of each
  Place parent_at;
  std::vector<int> parents;  // none: the root, or an either
  std::vector<int> members;  // of an either: an object of any of them fits
};

struct Object {
  std::string name;
  std::vector<int> types;  // one; of an either: all of them, for it is an object of each
};

// A ground predicate or function.
struct Atom {
  int symbol = 0;
  std::vector<int> arguments;
  friend auto operator<=>(const Atom&, const Atom&) = default;
};

struct Metric {
  bool maximize = false;
  Expression expression;
};

struct Definition {
  std::vector<std::string> files;
  std::string domain_name;
  std::string problem_name;
  std::set<std::string> requirements;
  std::vector<Type> types;  // [0] is object
  std::vector<Object> objects;
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<Action> actions;
  std::vector<Axiom> axioms;  // by layer
  std::set<Atom> facts;       // with those that the axioms derive from them
  std::map<Atom, double> fluents;
  Formula goal;
  int goal_slots = 0;
  std::optional<Metric> metric;
  int total_time = -1;  // the function total-time, if the metric uses it: every action increases it by one

  // The ids by name.
  std::map<std::string, int> type_ids;
  std::map<std::string, int> object_ids;
  std::map<std::string, int> predicate_ids;
  std::map<std::string, int> function_ids;
  std::map<std::string, int> action_ids;

  // The objects of a type and of its subtypes.
  std::vector<std::vector<int>> objects_by_type;

  // The type and all its ancestors, each once.
  std::vector<int> lineage(int type) const;
  // Does every object of the type fit where one of `ancestor` is asked for?
  bool is_subtype(int type, int ancestor) const;
  // Does the object fit where one of the type is asked for?
  bool is_of_type(int object, int type) const;
};

// The function that PDDL 2.1 predefines for metrics: the number of actions here, where nothing has a
// duration.
inline constexpr const char* kTotalTimeName = "total-time";

// The function that ":action-costs" is about (PDDL 3.1).
inline constexpr const char* kTotalCostName = "total-cost";

}  // namespace stepwright::pddl
