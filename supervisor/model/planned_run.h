#pragma once

// Meaning of a plan, free of any planning language: named states, ground conditions, and for every action of
// a plan the state before and after it. A front end (pddl) makes it, translation and executive read it.
//
// Values only; safe to copy and to share between threads. Names are written as PDDL writes ground atoms, in
// lower case with single spaces: "(is-at v1 f1)", "(lev v1)".
//
//   Condition enough = compare(fluent("(lev v1)"), Comparison::GreaterEqual, constant(3));
//   holds(enough, state)  ->  true if the fluent is known and at least 3

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"

namespace stepwright::model {

// A state by names: true facts and the values of fluents. A fact that is not listed is false; a fluent not
// listed is unknown.
struct NamedState {
  std::set<std::string> facts;
  std::map<std::string, double> fluents;

  friend bool operator==(const NamedState&, const NamedState&) = default;
};

enum class ExpressionKind : std::uint8_t { Constant, Fluent, Sum, Difference, Product, Quotient };

// An arithmetic expression over fluents. Sum and Product take any number of operands, Difference and Quotient
// two (a negation is 0 - x).
struct Expression {
  ExpressionKind kind = ExpressionKind::Constant;
  double value = 0.0;  // Constant
  std::string fluent;  // Fluent
  std::vector<Expression> operands;

  friend bool operator==(const Expression&, const Expression&) = default;
};

enum class Comparison : std::uint8_t { Less, LessEqual, Equal, NotEqual, GreaterEqual, Greater };

enum class ConditionKind : std::uint8_t {
  All,      // every child; no child: true
  Any,      // one child at least; no child: false
  Fact,     // `fact` is true, or false if `negated`
  Compare,  // `left` comparison `right`
};

// A ground condition in negation normal form.
struct Condition {
  ConditionKind kind = ConditionKind::All;
  std::string fact;
  bool negated = false;
  Comparison comparison = Comparison::Equal;
  Expression left;
  Expression right;
  std::vector<Condition> children;

  friend bool operator==(const Condition&, const Condition&) = default;
};

struct PlannedAction {
  GroundAction action;
  Condition precondition;
  NamedState before;  // when the actions are executed in the order of the list
  NamedState after;
};

struct PlannedRun {
  NamedState initial;
  std::vector<PlannedAction> actions;
  // A partial order that suffices; `before` is smaller than `after` in each. Nothing = only the list's order
  // is known good (as in Plan).
  std::optional<std::vector<Ordering>> orderings;
};

Expression constant(double value);
Expression fluent(std::string name);
Condition fact(std::string name, bool negated = false);
Condition compare(Expression left, Comparison comparison, Expression right);
Condition all_of(std::vector<Condition> children);
Condition any_of(std::vector<Condition> children);

// The value in `state`; nullopt if a fluent is unknown or a divisor is zero.
std::optional<double> evaluate(const Expression& expression, const NamedState& state);
// Comparisons allow 1e-9 for rounding; one over an unknown fluent does not hold.
bool holds(const Condition& condition, const NamedState& state);

// Prefix form as in PDDL: "(>= (lev v1) 3)".
std::string to_string(const Expression& expression);
std::string to_string(const Condition& condition);

}  // namespace stepwright::model
