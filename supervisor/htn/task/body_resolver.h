#pragma once

// Resolves what stands inside of actions, methods, networks and the goal.
//
// Thread rule: one reading, one object. It needs the declarations to be complete.

#include <string>
#include <vector>

#include "supervisor/htn/task/declarations.h"

namespace stepwright::htn {

class BodyResolver {
 public:
  BodyResolver(PlanningTask& task, const Names& names, Declarations& declarations, lisp::Reporter& reporter)
      : task_(task), names_(names), declarations_(declarations), reporter_(reporter) {}

  // The variables of an action or method; replaces those of the one before.
  std::vector<Variable> begin(const std::vector<TypedName>& parameters);

  // Literals of external predicates in the outermost conjunction go to `externals`; elsewhere they are
  // refused (P0607).
  Condition condition(const ParsedFormula& formula, std::vector<ExternalLiteral>& externals);

  void effect(const ParsedEffect& effect, Action& action);

  // The task of a method. Its parameters' types that are wider than the task's become conditions.
  std::vector<Term> task_terms(const ParsedCall& call, int task, Condition& types);

  // A task or an action with its arguments. False after an error.
  bool subtask(const ParsedCall& call, Subtask& subtask, Condition& types);

  // A ground fact of the initial state, or a function with objects. False after an error.
  bool ground(const ParsedCall& call, bool function, GroundAtom& atom);

  // Slots needed so far by the current body.
  int slots() const { return slots_; }

 private:
  // What an argument may be: of the type, or of one that an object may have beside it.
  enum class Fit : std::uint8_t { Subtype, Overlap };
  // The quantifiers and conditions around an effect.
  struct Around {
    std::vector<Variable> variables;
    std::vector<Condition> conditions;
  };

  Condition inner(const ParsedFormula& formula);
  void outer(const ParsedFormula& formula, Condition& all, std::vector<ExternalLiteral>& externals);
  bool is_external(const ParsedCall& call) const;
  void refuse_external(const ParsedCall& call);
  std::vector<Variable> push(const std::vector<TypedName>& variables);
  void pop(std::size_t count) { scope_.resize(scope_.size() - count); }
  bool term(const ParsedTerm& parsed, Term& term);
  int type_of(Term term) const;
  bool fits(Term term, int wanted, Fit fit) const;
  bool arguments(const ParsedCall& call, const std::vector<int>& types, Fit fit, std::vector<Term>& terms);
  int symbol(const ParsedCall& call, const std::map<std::string, int>& ids, const char* code,
             const std::string& what);
  bool atom(const ParsedCall& call, Fit fit, int& predicate, std::vector<Term>& terms);
  void effect(const ParsedEffect& effect, Around& around, Action& action);
  void leaf(const ParsedEffect& effect, const Around& around, Action& action);
  void cost(const ParsedEffect& effect, const Around& around, Action& action);
  void narrow(const std::vector<Term>& terms, const std::vector<int>& types, Condition& all);

  PlanningTask& task_;
  const Names& names_;
  Declarations& declarations_;
  lisp::Reporter& reporter_;
  std::vector<Variable> scope_;
  std::vector<int> slot_types_;
  int slots_ = 0;
  std::size_t copied_ = 0;  // conditions around effects
};

}  // namespace stepwright::htn
