#include "supervisor/pddl/semantics/checker.h"

#include <algorithm>

#include "supervisor/lisp/name_hints.h"
#include "supervisor/pddl/lifted/derive.h"
#include "supervisor/pddl/lifted/evaluate.h"
#include "supervisor/pddl/semantics/formula_checker.h"
#include "supervisor/pddl/semantics/stratify.h"
#include "supervisor/pddl/semantics/valueless_changes.h"

namespace stepwright::pddl {
namespace {

const std::vector<std::string> kKnownRequirements = {":strips",
                                                     ":typing",
                                                     ":negative-preconditions",
                                                     ":disjunctive-preconditions",
                                                     ":equality",
                                                     ":existential-preconditions",
                                                     ":universal-preconditions",
                                                     ":quantified-preconditions",
                                                     ":conditional-effects",
                                                     ":fluents",
                                                     ":numeric-fluents",
                                                     ":adl",
                                                     ":action-costs",
                                                     ":derived-predicates"};

// What PDDL has beyond the language here. Many domains declare some of it and use none.
const std::vector<std::string> kUnsupportedRequirements = {":durative-actions",   ":duration-inequalities",
                                                           ":continuous-effects", ":timed-initial-literals",
                                                           ":timed-effects",      ":time",
                                                           ":preferences",        ":constraints",
                                                           ":goal-utilities",     ":object-fluents",
                                                           ":non-deterministic",  ":probabilistic-effects",
                                                           ":hierarchy",          ":method-preconditions"};

Atom atom_of(const Call& call) {
  Atom ground{call.symbol, {}};
  for (const Term& term : call.arguments) ground.arguments.push_back(term.index);
  return ground;
}

class Checker {
 public:
  Checker(ParsedDomain domain, ParsedProblem problem, Reporter& reporter)
      : domain_(std::move(domain)),
        problem_(std::move(problem)),
        reporter_(reporter),
        names_(definition_, reporter) {}

  Definition run() {
    definition_.files = reporter_.files();
    definition_.domain_name = domain_.name;
    definition_.problem_name = problem_.name;
    requirements(domain_.requirements);
    requirements(problem_.requirements);
    if (!match_domain()) return std::move(definition_);
    types();
    objects(domain_.constants);
    objects(problem_.objects);
    group_objects();
    symbols(domain_.predicates, definition_.predicates, definition_.predicate_ids, "predicate");
    symbols(domain_.functions, definition_.functions, definition_.function_ids, "function");
    axiom_heads();
    actions();
    axioms();
    initial_facts();
    initial_fluents();
    warn_of_valueless_changes(definition_, reporter_);
    metric();
    goal();
    derive_initial();
    return std::move(definition_);
  }

 private:
  void requirements(const std::vector<RequirementFlag>& flags);
  bool match_domain();
  void type(const Typed& type);
  void types();
  void implicit_parents();
  void find_cycles();
  void objects(const std::vector<Typed>& list);
  void group_objects();
  void symbols(std::vector<Symbol>& parsed, std::vector<Symbol>& table, std::map<std::string, int>& ids,
               const std::string& what);
  void axiom_heads();
  void actions();
  void axioms();
  void initial_facts();
  void initial_fluents();
  void start_total_cost();
  void metric();
  void static_parts(const Expression& expression);
  void goal();
  void derive_initial();

  void repeated(const std::string& what, const std::string& name, Place at, bool same);

  ParsedDomain domain_;
  ParsedProblem problem_;
  Reporter& reporter_;
  Definition definition_;
  FormulaChecker names_;
};

void Checker::requirements(const std::vector<RequirementFlag>& flags) {
  std::set<std::string>& set = definition_.requirements;
  for (const RequirementFlag& flag : flags) {
    const auto listed = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), flag.name) != list.end();
    };
    if (listed(kUnsupportedRequirements)) {
      reporter_.warning("P0112", flag.at, "the requirement '" + flag.name + "' is not supported",
                        "what uses it is refused where it stands");
    } else if (!listed(kKnownRequirements)) {
      reporter_.warning("P0112", flag.at, "unknown requirement '" + flag.name + "'",
                        lisp::did_you_mean(flag.name, kKnownRequirements));
    }
    set.insert(flag.name);
  }
  if (set.count(":adl") != 0) {
    set.insert({":strips", ":typing", ":negative-preconditions", ":disjunctive-preconditions", ":equality",
                ":quantified-preconditions", ":conditional-effects"});
  }
  if (set.count(":quantified-preconditions") != 0) {
    set.insert({":existential-preconditions", ":universal-preconditions"});
  }
  if (set.count(":fluents") != 0 || set.count(":action-costs") != 0) set.insert(":numeric-fluents");
}

// What else is wrong with a problem of another domain only hides that it is one.
bool Checker::match_domain() {
  if (problem_.domain.empty() || domain_.name.empty() || problem_.domain == domain_.name) return true;
  reporter_.error("P0111", problem_.domain_at,
                  "the problem is for the domain '" + problem_.domain + "', not for '" + domain_.name + "'",
                  "are these the two files that belong together?");
  return false;
}

// A supertype that is used and nowhere declared is taken as declared: many published domains do so.
void Checker::implicit_parents() {
  const std::size_t count = definition_.types.size();
  for (std::size_t i = 1; i < count; ++i) {
    const Type type = definition_.types[i];
    for (const std::string& parent : type.parent_names) {
      if (definition_.type_ids.count(parent) != 0) continue;
      reporter_.warning("P0101", type.parent_at, "the supertype '" + parent + "' is not declared",
                        "add it to ':types'");
      definition_.type_ids.emplace(parent, static_cast<int>(definition_.types.size()));
      definition_.types.push_back({parent, type.parent_at, {"object"}, type.parent_at, {}, {}});
    }
  }
}

// A type that stands twice has the supertypes of both places; so it has those of an either.
void Checker::type(const Typed& type) {
  std::vector<std::string> parents = type.either;
  if (parents.empty()) parents.push_back(type.type_name);
  const auto [known, added] =
      definition_.type_ids.emplace(type.name, static_cast<int>(definition_.types.size()));
  if (added) {
    definition_.types.push_back({type.name, type.at, std::move(parents), type.type_at, {}, {}});
    return;
  }
  reporter_.warning("P0108", type.at, "the type '" + type.name + "' is declared twice",
                    "it has the supertypes of both declarations");
  std::vector<std::string>& all = definition_.types[static_cast<std::size_t>(known->second)].parent_names;
  all.insert(all.end(), parents.begin(), parents.end());
}

void Checker::types() {
  definition_.types.push_back({"object", {}, {}, {}, {}, {}});
  definition_.type_ids.emplace("object", 0);
  for (const Typed& type : domain_.types) {
    if (type.name == "object") continue;
    names_.require(":typing", type.at);
    this->type(type);
  }
  implicit_parents();
  for (std::size_t i = 1; i < definition_.types.size(); ++i) {
    Type& type = definition_.types[i];
    for (const std::string& parent : type.parent_names) {
      type.parents.push_back(definition_.type_ids.at(parent));
    }
  }
  find_cycles();
}

void Checker::find_cycles() {
  for (std::size_t i = 1; i < definition_.types.size(); ++i) {
    Type& type = definition_.types[i];
    const bool circle = std::any_of(type.parents.begin(), type.parents.end(), [&](int parent) {
      const std::vector<int> line = definition_.lineage(parent);
      return std::find(line.begin(), line.end(), static_cast<int>(i)) != line.end();
    });
    if (!circle) continue;
    reporter_.error("P0109", type.at, "the type '" + type.name + "' is its own ancestor");
    type.parents = {0};  // Breaks the cycle.
  }
}

// What stands twice in the same way is harmless: constants are repeated among the objects of many problems.
void Checker::repeated(const std::string& what, const std::string& name, Place at, bool same) {
  const std::string message = "the " + what + " '" + name + "' is declared twice";
  if (same) {
    reporter_.warning("P0108", at, message, "once is enough");
  } else {
    reporter_.error("P0108", at, message, "with different types: which of them is meant?");
  }
}

void Checker::objects(const std::vector<Typed>& list) {
  for (const Typed& object : list) {
    const std::vector<int> types = names_.types(object);
    const auto [known, added] =
        definition_.object_ids.emplace(object.name, static_cast<int>(definition_.objects.size()));
    if (added) {
      definition_.objects.push_back({object.name, types});
    } else {
      repeated("object", object.name, object.at,
               definition_.objects[static_cast<std::size_t>(known->second)].types == types);
    }
  }
}

void Checker::group_objects() {
  definition_.objects_by_type.resize(definition_.types.size());
  for (std::size_t object = 0; object < definition_.objects.size(); ++object) {
    std::set<int> all;  // two types of an object may have an ancestor in common
    for (const int type : definition_.objects[object].types) {
      const std::vector<int> line = definition_.lineage(type);
      all.insert(line.begin(), line.end());
    }
    for (const int type : all) {
      definition_.objects_by_type[static_cast<std::size_t>(type)].push_back(static_cast<int>(object));
    }
  }
}

void Checker::symbols(std::vector<Symbol>& parsed, std::vector<Symbol>& table,
                      std::map<std::string, int>& ids, const std::string& what) {
  const auto types_of = [](const Symbol& symbol) {
    std::vector<int> types;
    for (const Typed& parameter : symbol.parameters) types.push_back(parameter.type);
    return types;
  };
  for (Symbol& symbol : parsed) {
    names_.declaration(symbol.parameters);
    const auto [known, added] = ids.emplace(symbol.name, static_cast<int>(table.size()));
    if (added) {
      table.push_back(std::move(symbol));
    } else {
      repeated(what, symbol.name, symbol.at,
               types_of(symbol) == types_of(table[static_cast<std::size_t>(known->second)]));
    }
  }
}

// A head without types takes those of the predicate's declaration.
void Checker::axiom_heads() {
  for (Axiom& axiom : domain_.axioms) {
    names_.require(":derived-predicates", axiom.at);
    const int predicate = names_.predicate(axiom.name, axiom.at, axiom.parameters.size());
    if (predicate < 0) continue;
    Symbol& symbol = definition_.predicates[static_cast<std::size_t>(predicate)];
    symbol.derived = true;
    axiom.predicate = predicate;
    for (std::size_t i = 0; i < axiom.parameters.size(); ++i) {
      Typed& parameter = axiom.parameters[i];
      const bool untyped =
          parameter.type_at.line == parameter.at.line && parameter.type_at.column == parameter.at.column;
      if (untyped) parameter.type_name = symbol.parameters[i].type_name;
    }
    definition_.axioms.push_back(std::move(axiom));
  }
}

void Checker::axioms() {
  for (Axiom& axiom : definition_.axioms) {
    names_.begin(axiom.parameters);
    names_.arguments(axiom.name, axiom.predicate, axiom.parameters);
    names_.formula(axiom.body);
    axiom.slots = names_.slots();
  }
  if (!reporter_.failed()) stratify(definition_, reporter_);
}

void Checker::actions() {
  for (Action& action : domain_.actions) {
    const auto id = static_cast<int>(definition_.actions.size());
    if (!definition_.action_ids.emplace(action.name, id).second) {
      reporter_.error("P0108", action.at, "the action '" + action.name + "' is declared twice");
      continue;
    }
    names_.begin(action.parameters);
    names_.formula(action.precondition);
    names_.effect(action.effect);
    action.slots = names_.slots();
    definition_.actions.push_back(std::move(action));
  }
}

void Checker::initial_facts() {
  for (Call& fact : problem_.facts) {
    if (!names_.ground(fact, false)) continue;
    if (names_.derived(fact, "set in ':init'")) continue;
    if (!definition_.facts.insert(atom_of(fact)).second) {
      reporter_.warning("P0114", fact.at, "this fact stands twice in ':init'");
    }
  }
  for (Call& fact : problem_.denied) {
    if (!names_.ground(fact, false)) continue;
    if (names_.derived(fact, "set in ':init'")) continue;
    if (definition_.facts.count(atom_of(fact)) != 0) {
      reporter_.error("P0114", fact.at, "this fact stands in ':init' both with and without 'not'");
    }
  }
}

void Checker::initial_fluents() {
  for (InitialFluent& initial : problem_.fluents) {
    if (!names_.ground(initial.call, true)) continue;
    const auto [place, added] = definition_.fluents.emplace(atom_of(initial.call), initial.value);
    if (!added && place->second != initial.value) {
      reporter_.error("P0114", initial.call.at, "'" + initial.call.name + "' gets two values in ':init'");
    }
  }
  start_total_cost();
}

// PDDL leaves the costs undefined then, so that no action could be executed; nobody means that.
void Checker::start_total_cost() {
  const auto found = definition_.function_ids.find(kTotalCostName);
  if (found == definition_.function_ids.end()) return;
  const Symbol& cost = definition_.functions[static_cast<std::size_t>(found->second)];
  if (!cost.parameters.empty() || !definition_.fluents.emplace(Atom{found->second, {}}, 0.0).second) return;
  reporter_.warning("P0118", problem_.at, "'total-cost' has no value in ':init': it starts at 0",
                    "add (= (total-cost) 0) to ':init'");
}

bool mentions(const Expression& expression, const std::string& name) {
  if (expression.kind == NumericKind::Fluent && expression.call.name == name) return true;
  return std::any_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return mentions(operand, name); });
}

bool changes(const Definition& definition, const Expression& expression) {
  if (expression.kind == NumericKind::Fluent &&
      definition.functions[static_cast<std::size_t>(expression.call.symbol)].changes) {
    return true;
  }
  return std::any_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return changes(definition, operand); });
}

// What no action assigns must have a value, for only that can be increased; what no action changes must not
// be a divisor of zero.
void Checker::static_parts(const Expression& expression) {
  const LiftedState initial = pddl::initial_state(definition_);
  const bool valueless = expression.kind == NumericKind::Fluent &&
                         !definition_.functions[static_cast<std::size_t>(expression.call.symbol)].assigned &&
                         !evaluate(expression, {}, initial);
  if (valueless) {
    reporter_.error("P0118", expression.at,
                    "the metric reads " + print(definition_, expression) + ", which never gets a value",
                    "give it one in ':init'");
  }
  for (const Expression& operand : expression.operands) static_parts(operand);
  for (std::size_t i = 1; i < expression.operands.size() && expression.kind == NumericKind::Divide; ++i) {
    const Expression& divisor = expression.operands[i];
    if (changes(definition_, divisor) || evaluate(divisor, {}, initial) != 0.0) continue;
    reporter_.error("P0117", divisor.at, "the divisor " + print(definition_, divisor) + " is zero");
  }
}

void Checker::metric() {
  if (!problem_.metric) return;
  const bool declared = definition_.function_ids.count(kTotalTimeName) != 0;
  if (!declared && mentions(problem_.metric->expression, kTotalTimeName)) {
    definition_.total_time = static_cast<int>(definition_.functions.size());
    definition_.function_ids.emplace(kTotalTimeName, definition_.total_time);
    definition_.functions.push_back({kTotalTimeName, problem_.metric->expression.at, {}, true});
    definition_.fluents[Atom{definition_.total_time, {}}] = 0.0;
  }
  std::vector<Typed> none;
  names_.begin(none);
  names_.expression(problem_.metric->expression);
  if (!reporter_.failed()) static_parts(problem_.metric->expression);
  definition_.metric = std::move(problem_.metric);
}

void Checker::goal() {
  std::vector<Typed> none;
  names_.begin(none);
  names_.formula(problem_.goal);
  definition_.goal = std::move(problem_.goal);
  definition_.goal_slots = names_.slots();
}

void Checker::derive_initial() {
  if (reporter_.failed()) return;
  LiftedState state = pddl::initial_state(definition_);
  derive(definition_, state);
  definition_.facts = std::move(state.facts);
}

}  // namespace

Definition check_task(ParsedDomain domain, ParsedProblem problem, Reporter& reporter) {
  return Checker(std::move(domain), std::move(problem), reporter).run();
}

void check_goal(Formula goal, Definition& definition, Reporter& reporter) {
  FormulaChecker names(definition, reporter);
  std::vector<Typed> none;
  names.begin(none);
  names.formula(goal);
  definition.goal = std::move(goal);
  definition.goal_slots = names.slots();
}

}  // namespace stepwright::pddl
