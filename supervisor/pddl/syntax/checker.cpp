#include "supervisor/pddl/syntax/checker.h"

#include <algorithm>

#include "supervisor/pddl/lifted/derive.h"
#include "supervisor/pddl/lifted/evaluate.h"
#include "supervisor/pddl/syntax/formula_checker.h"
#include "supervisor/pddl/syntax/stratify.h"

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

// What PDDL has beyond the language here.
const std::vector<std::string> kUnsupportedRequirements = {":durative-actions",   ":duration-inequalities",
                                                           ":continuous-effects", ":timed-initial-literals",
                                                           ":timed-effects",      ":time",
                                                           ":preferences",        ":constraints",
                                                           ":goal-utilities",     ":object-fluents",
                                                           ":non-deterministic",  ":probabilistic-effects",
                                                           ":hierarchy",          ":method-preconditions"};

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
    match_domain();
    types();
    objects(domain_.constants);
    objects(problem_.objects);
    group_objects();
    symbols(domain_.predicates, definition_.predicates, definition_.predicate_ids, "predicate");
    symbols(domain_.functions, definition_.functions, definition_.function_ids, "function");
    axiom_heads();
    actions();
    axioms();
    initial_state();
    metric();
    goal();
    derive_initial();
    return std::move(definition_);
  }

 private:
  void requirements(const std::vector<RequirementFlag>& flags);
  void match_domain();
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
  void initial_state();
  void metric();
  void static_parts(const Expression& expression);
  void goal();
  void derive_initial();

  bool declare(std::map<std::string, int>& ids, const std::string& name, Place at, std::size_t id,
               const std::string& what) {
    if (ids.emplace(name, static_cast<int>(id)).second) return true;
    reporter_.error("P0108", at, "the " + what + " '" + name + "' is declared twice");
    return false;
  }

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
      reporter_.error("P0112", flag.at, "the requirement '" + flag.name + "' is not supported",
                      "a plan made without it could be wrong");
    } else if (!listed(kKnownRequirements)) {
      reporter_.warning("P0112", flag.at, "unknown requirement '" + flag.name + "'",
                        did_you_mean(flag.name, kKnownRequirements));
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

void Checker::match_domain() {
  if (problem_.domain.empty() || domain_.name.empty() || problem_.domain == domain_.name) return;
  reporter_.error("P0111", problem_.domain_at,
                  "the problem is for the domain '" + problem_.domain + "', not for '" + domain_.name + "'");
}

// A supertype that is used and nowhere declared is taken as declared: many published domains do so.
void Checker::implicit_parents() {
  const std::size_t count = definition_.types.size();
  for (std::size_t i = 1; i < count; ++i) {
    const Type type = definition_.types[i];
    if (definition_.type_ids.count(type.parent_name) != 0) continue;
    reporter_.warning("P0101", type.parent_at, "the supertype '" + type.parent_name + "' is not declared",
                      "add it to ':types'");
    definition_.type_ids.emplace(type.parent_name, static_cast<int>(definition_.types.size()));
    definition_.types.push_back({type.parent_name, type.parent_at, "object", type.parent_at, 0, {}});
  }
}

void Checker::types() {
  definition_.types.push_back({"object", {}, "", {}, -1, {}});
  definition_.type_ids.emplace("object", 0);
  for (const Typed& type : domain_.types) {
    if (type.name == "object") continue;
    names_.require(":typing", type.at);
    if (!declare(definition_.type_ids, type.name, type.at, definition_.types.size(), "type")) continue;
    definition_.types.push_back({type.name, type.at, type.type_name, type.type_at, 0, {}});
  }
  implicit_parents();
  for (std::size_t i = 1; i < definition_.types.size(); ++i) {
    Type& type = definition_.types[i];
    type.parent = definition_.type_ids.at(type.parent_name);
  }
  find_cycles();
}

void Checker::find_cycles() {
  for (std::size_t i = 1; i < definition_.types.size(); ++i) {
    int ancestor = definition_.types[i].parent;
    std::size_t steps = 0;
    while (ancestor > 0 && ancestor != static_cast<int>(i) && steps++ < definition_.types.size()) {
      ancestor = definition_.types[static_cast<std::size_t>(ancestor)].parent;
    }
    if (ancestor != static_cast<int>(i)) continue;
    Type& type = definition_.types[i];
    reporter_.error("P0109", type.at, "the type '" + type.name + "' is its own ancestor");
    type.parent = 0;  // Breaks the cycle, so that everything after can walk up.
  }
}

void Checker::objects(const std::vector<Typed>& list) {
  for (const Typed& object : list) {
    const std::vector<int> types = names_.types(object);
    if (!declare(definition_.object_ids, object.name, object.at, definition_.objects.size(), "object"))
      continue;
    definition_.objects.push_back({object.name, types});
  }
}

void Checker::group_objects() {
  definition_.objects_by_type.resize(definition_.types.size());
  for (std::size_t object = 0; object < definition_.objects.size(); ++object) {
    std::set<int> all;  // two types of an object may have an ancestor in common
    for (int type : definition_.objects[object].types) {
      for (; type != -1; type = definition_.types[static_cast<std::size_t>(type)].parent) all.insert(type);
    }
    for (const int type : all) {
      definition_.objects_by_type[static_cast<std::size_t>(type)].push_back(static_cast<int>(object));
    }
  }
}

void Checker::symbols(std::vector<Symbol>& parsed, std::vector<Symbol>& table,
                      std::map<std::string, int>& ids, const std::string& what) {
  for (Symbol& symbol : parsed) {
    if (!declare(ids, symbol.name, symbol.at, table.size(), what)) continue;
    names_.begin(symbol.parameters);
    table.push_back(std::move(symbol));
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
    if (!declare(definition_.action_ids, action.name, action.at, definition_.actions.size(), "action"))
      continue;
    names_.begin(action.parameters);
    names_.formula(action.precondition);
    names_.effect(action.effect);
    action.slots = names_.slots();
    definition_.actions.push_back(std::move(action));
  }
}

void Checker::initial_state() {
  const auto atom = [](const Call& call) {
    Atom ground{call.symbol, {}};
    for (const Term& term : call.arguments) ground.arguments.push_back(term.index);
    return ground;
  };
  for (Call& fact : problem_.facts) {
    if (!names_.ground(fact, false)) continue;
    if (names_.derived(fact, "set in ':init'")) continue;
    if (!definition_.facts.insert(atom(fact)).second) {
      reporter_.warning("P0114", fact.at, "this fact stands twice in ':init'");
    }
  }
  for (InitialFluent& initial : problem_.fluents) {
    if (!names_.ground(initial.call, true)) continue;
    const auto [place, added] = definition_.fluents.emplace(atom(initial.call), initial.value);
    if (!added && place->second != initial.value) {
      reporter_.error("P0114", initial.call.at, "'" + initial.call.name + "' gets two values in ':init'");
    }
  }
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

// What no action changes must have a value, and must not be a divisor of zero.
void Checker::static_parts(const Expression& expression) {
  const LiftedState initial = pddl::initial_state(definition_);
  const bool fixed = !changes(definition_, expression);
  if (expression.kind == NumericKind::Fluent && fixed && !evaluate(expression, {}, initial)) {
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
