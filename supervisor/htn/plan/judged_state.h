#pragma once

// The state of the validator: facts by their text, conditions and effects as the files say them.
//
// Thread rule: one validation, one object. Shares nothing with the search but the parser.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "supervisor/htn/syntax/syntax_tree.h"

namespace stepwright::htn {

// Objects by the names of variables.
using NamedBinding = std::map<std::string, std::string>;

class JudgedState {
 public:
  // `external`: predicates that somebody else judges; in a conjunction they are taken to hold, and their
  // effects are left out.
  JudgedState(const ParsedDomain& domain, const ParsedProblem& problem,
              const std::set<std::string>& external);

  bool is_of(const std::string& object, const TypedName& type) const;
  bool holds(const ParsedFormula& formula, const NamedBinding& binding) const;
  void apply(const ParsedAction& action, const NamedBinding& binding);
  double cost() const { return cost_; }

 private:
  std::vector<std::string> objects_of(const TypedName& type) const;
  // For every choice of objects for the variables.
  template <typename Visit>
  void each(const std::vector<TypedName>& variables, const NamedBinding& binding, const Visit& visit) const;
  bool skipped(const ParsedFormula& formula) const;
  bool is_a(const std::string& type, const std::string& wanted, std::set<std::string>& met) const;
  void collect(const ParsedEffect& effect, const NamedBinding& binding, std::set<std::string>& added,
               std::set<std::string>& deleted);

  const std::set<std::string>& external_;
  std::map<std::string, std::set<std::string>> parents_;  // of types
  std::map<std::string, std::set<std::string>> types_;    // of objects
  std::set<std::string> facts_;
  std::map<std::string, double> values_;
  double cost_ = 0.0;
};

}  // namespace stepwright::htn
