#pragma once

// Resolves the names inside conditions, expressions and effects.
//
// Thread rule: one check, one object. It needs the declarations of the definition to be complete.

#include <map>
#include <string>
#include <vector>

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

class FormulaChecker {
 public:
  FormulaChecker(Definition& definition, Reporter& reporter) : definition_(definition), reporter_(reporter) {}

  // The variables of an action; replaces those of the one before.
  void begin(std::vector<Typed>& parameters);

  // The parameters of a predicate or function, whose names say nothing.
  void declaration(std::vector<Typed>& parameters);

  void formula(Formula& formula);
  void effect(Effect& effect);
  void expression(Expression& expression);

  // A ground fact or fluent of the initial state. False after an error.
  bool ground(Call& call, bool function);

  // The id of the predicate that an axiom defines with so many parameters; -1 after an error.
  int predicate(const std::string& name, Place at, std::size_t arity);

  // Checks the types of an axiom's parameters against the predicate's declaration.
  void arguments(const std::string& name, int predicate, const std::vector<Typed>& parameters);

  // Reports P0115 if the fact is derived: then it cannot be `changed`, "set in ':init'".
  bool derived(const Call& fact, const std::string& changed);

  // The type named; reports an unknown one (P0101) and answers object.
  int type(const std::string& name, Place at);
  int type(const Typed& typed);

  // The types that an object of this declaration has.
  std::vector<int> types(const Typed& object);

  // Slots needed so far by the current action or goal.
  int slots() const { return slots_; }

  // Notes that a requirement is used; the first use of an undeclared one is a warning.
  void require(const std::string& flag, Place at);

 private:
  void push(std::vector<Typed>& variables);
  void pop(std::size_t count);
  bool resolve(Call& call, bool function);
  bool resolve_symbol(Call& call, bool function);
  bool resolve(Term& term, std::vector<int>& types);
  std::string name_of(const std::vector<int>& types) const;
  std::string hint_for(const std::string& name, const std::map<std::string, int>& ids) const;
  bool unknown_object(const Term& term);
  void wrong_type(const std::string& name, Place at, const std::string& found, const std::string& symbol,
                  std::size_t argument, int wanted);
  void numeric_effect(Effect& effect);

  Definition& definition_;
  Reporter& reporter_;
  std::vector<Typed> scope_;
  int slots_ = 0;
  bool negated_ = false;
  std::map<std::string, bool> warned_;
  bool unknown_type_ = false;  // something was declared with a type that there is not
};

}  // namespace stepwright::pddl
