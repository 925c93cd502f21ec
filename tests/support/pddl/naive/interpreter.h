#pragma once

// PDDL by the book, on names and nothing but names: a second opinion on what texts mean. It reads the texts
// itself, enumerates everything, evaluates in three values (true, false, undefined: Kleene 1952) and knows no
// indices, slots or numbers. Slow, and without a line in common with the library.
//
//   Interpreter pddl(domain, problem);
//   auto next = pddl.apply(pddl.initial(), {"go", {"a", "b"}});   // nothing if not applicable

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/pddl/naive/tree.h"

namespace stepwright::pddl::testing {

// Facts as "(at t p1)"; fluents likewise.
struct NaiveState {
  std::set<std::string> facts;
  std::map<std::string, double> fluents;
  friend auto operator<=>(const NaiveState&, const NaiveState&) = default;
};

struct NaiveAction {
  std::string name;
  std::vector<std::string> arguments;
  friend auto operator<=>(const NaiveAction&, const NaiveAction&) = default;
};

class Interpreter {
 public:
  Interpreter(const std::string& domain, const std::string& problem);

  NaiveState initial() const;

  // Every action with every choice of objects of its parameters' types.
  std::vector<NaiveAction> actions() const;

  // The state after the action. Nothing if it is unknown, its arguments are wrong, its precondition does not
  // hold, or an effect is undefined or contradicts another.
  std::optional<NaiveState> apply(const NaiveState& state, const NaiveAction& action) const;

  bool goal(const NaiveState& state) const;

  // The value of the metric; nothing if it is undefined. Without a metric: 0.
  std::optional<double> metric(const NaiveState& state) const;

  // Replaces the derived facts by those that follow from the rest.
  void derive(NaiveState& state) const;

 private:
  using Binding = std::map<std::string, std::string>;
  enum class Truth { No, Undefined, Yes };
  struct Changes;

  void read_domain(const Tree& domain);
  void read_problem(const Tree& problem);
  void add_objects(const std::vector<TypedName>& names);
  bool fits(const std::string& object, const std::vector<std::string>& types) const;
  void each(const std::vector<TypedName>& variables, Binding binding,
            const std::function<void(const Binding&)>& visit, std::size_t next = 0) const;
  Truth truth(const Tree& formula, const Binding& binding, const NaiveState& state) const;
  Truth compare(const Tree& formula, const Binding& binding, const NaiveState& state) const;
  std::optional<double> value(const Tree& expression, const Binding& binding, const NaiveState& state) const;
  void collect(const Tree& effect, const Binding& binding, const NaiveState& state, Changes& changes) const;
  std::set<std::string> negated_in(const Tree& formula, bool negated) const;
  bool derived(const std::string& fact) const;

  std::map<std::string, std::vector<std::string>> parents_;  // of types
  std::vector<TypedName> objects_;
  std::map<std::string, Tree> schemas_;
  std::vector<std::string> order_;  // of the schemas
  std::vector<Tree> axioms_;
  std::map<std::string, std::vector<TypedName>> predicates_;
  std::set<std::string> functions_;
  std::map<std::string, std::size_t> layers_;  // of derived predicates
  Tree goal_, metric_;
  NaiveState initial_;
};

}  // namespace stepwright::pddl::testing
