#pragma once

// From tokens to the unresolved form of a domain or a problem. Names stay names here; the checker resolves
// them.
//
// Thread rule: pure functions. Every error is reported; what could be read is returned all the same, so that
// the checker can find more.

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/lexer.h"
#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

struct ParsedDomain {
  std::string name;
  Place at;
  std::vector<RequirementFlag> requirements;
  std::vector<Typed> types;
  std::vector<Typed> constants;
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<Action> actions;
  std::vector<Axiom> axioms;
};

struct InitialFluent {
  Call call;
  double value = 0.0;
};

struct ParsedProblem {
  std::string name;
  Place at;
  std::string domain;
  Place domain_at;
  std::vector<RequirementFlag> requirements;
  std::vector<Typed> objects;
  std::vector<Call> facts;
  std::vector<Call> denied;  // "(not (fact))"
  std::vector<InitialFluent> fluents;
  bool has_goal = false;
  Formula goal;
  std::optional<Metric> metric;
};

ParsedDomain parse_domain(std::vector<Token> tokens, Reporter& reporter);
ParsedProblem parse_problem(std::vector<Token> tokens, Reporter& reporter);

// A goal on its own, as Task::with_goal takes it.
Formula parse_goal(std::vector<Token> tokens, Reporter& reporter);

}  // namespace stepwright::pddl
