#pragma once

// HDDL as it is written (Hoeller, Behnke, Bercher, Biundo, Fiorino, Pellier, Alford 2020, "HDDL: an extension
// to PDDL for expressing hierarchical planning problems"): what the parser makes of a text. Names are lower
// case and not looked up.
//
// Thread rule: plain values.

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/lisp/place.h"
#include "supervisor/lisp/section_parser.h"
#include "supervisor/lisp/typed_list.h"

namespace stepwright::htn {

using lisp::Place;
using lisp::TypedName;

struct ParsedTerm {
  std::string name;  // variables with their question mark
  Place at;
  bool variable = false;
};

// A predicate, function, task or action with its arguments.
struct ParsedCall {
  std::string name;
  Place at;
  std::vector<ParsedTerm> arguments;
};

enum class FormulaKind : std::uint8_t { Atom, Equal, And, Or, Not, Imply, Forall, Exists };

// An empty And is true.
struct ParsedFormula {
  FormulaKind kind = FormulaKind::And;
  Place at;
  ParsedCall call;  // Atom; Equal: its two arguments
  std::vector<ParsedFormula> parts;
  std::vector<TypedName> variables;  // Forall, Exists
};

// An amount by which total-cost grows: a number, or a function if it has a name.
struct ParsedAmount {
  double number = 0.0;
  ParsedCall function;
  Place at;
};

enum class EffectKind : std::uint8_t { And, Add, Delete, Cost, When, Forall };

struct ParsedEffect {
  EffectKind kind = EffectKind::And;
  Place at;
  ParsedCall call;                       // Add, Delete
  ParsedAmount amount;                   // Cost
  std::vector<ParsedFormula> condition;  // When: one
  std::vector<ParsedEffect> parts;       // And; When, Forall: one
  std::vector<TypedName> variables;      // Forall
};

// A predicate, function or compound task.
struct ParsedSymbol {
  std::string name;
  Place at;
  std::vector<TypedName> parameters;
};

struct ParsedAction {
  std::string name;
  Place at;
  std::vector<TypedName> parameters;
  ParsedFormula precondition;
  ParsedEffect effect;
};

struct ParsedSubtask {
  std::string label;  // "t1" of (t1 (go ?a ?b)); empty: none
  Place label_at;
  ParsedCall call;
};

// "(< t1 t2)".
struct ParsedOrder {
  ParsedTerm before;
  ParsedTerm after;
};

// Subtasks in the order in which they are done, once the parser has put them so.
struct ParsedNetwork {
  Place at;
  bool ordered = false;  // by their keyword, and not by `orders`
  std::vector<ParsedSubtask> subtasks;
  std::vector<ParsedOrder> orders;
  ParsedFormula constraints;
};

struct ParsedMethod {
  std::string name;
  Place at;
  std::vector<TypedName> parameters;
  bool has_task = false;
  ParsedCall task;
  ParsedFormula precondition;
  ParsedNetwork network;
};

struct ParsedDomain {
  std::string name;
  Place at;
  std::vector<lisp::RequirementFlag> requirements;
  std::vector<TypedName> types;
  std::vector<TypedName> constants;
  std::vector<ParsedSymbol> predicates;
  std::vector<ParsedSymbol> functions;
  std::vector<ParsedSymbol> tasks;
  std::vector<ParsedMethod> methods;
  std::vector<ParsedAction> actions;
};

// "(= (road-length a b) 5)".
struct ParsedValue {
  ParsedCall function;
  double value = 0.0;
};

struct ParsedProblem {
  std::string name;
  Place at;
  std::string domain;
  Place domain_at;
  std::vector<lisp::RequirementFlag> requirements;
  std::vector<TypedName> objects;
  std::vector<ParsedCall> facts;
  std::vector<ParsedCall> denied;  // "(not (fact))"
  std::vector<ParsedValue> values;
  bool has_network = false;
  std::vector<TypedName> parameters;  // of the network
  ParsedNetwork network;
  ParsedFormula goal;  // true without one
};

}  // namespace stepwright::htn
