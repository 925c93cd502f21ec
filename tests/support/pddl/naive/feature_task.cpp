#include "tests/support/pddl/naive/feature_task.h"

#include <map>
#include <random>
#include <vector>

namespace stepwright::pddl::testing {
namespace {

constexpr const char* kDeclarations = R"((define (domain features)
  (:requirements :adl :numeric-fluents :derived-predicates)
  (:types truck boat - vehicle vehicle thing - movable movable place box - object crate - thing)
  (:constants home - place spare - truck)
  (:predicates (at ?m - movable ?p - place) (in ?t - (either thing box) ?v - vehicle) (link ?a ?b - place)
    (ok ?v - (either vehicle box)) (lit) (busy ?v - vehicle) (reach ?a ?b - place) (free))
  (:functions (fuel ?v - vehicle) (room ?v - vehicle) - number (price) (dist ?a ?b - place) (spent) (weight ?t - (either box thing)))
  (:derived (busy ?v - vehicle) (exists (?t - (either box thing)) (in ?t ?v)))
  (:derived (reach ?a ?b) (or (link ?a ?b) (exists (?c - place) (and (link ?a ?c) (reach ?c ?b)))))
  (:derived (free) (exists (?v - vehicle) (and (ok ?v) (not (busy ?v)))))
)";

// Variables and objects by type; a term of a type may be any of its subtypes.
class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  TaskText run() {
    std::string domain = kDeclarations;
    const int count = 3 + pick(3);
    for (int i = 0; i < count; ++i) domain += action(i);
    return {domain + ")", problem()};
  }

 private:
  struct Variable {
    std::string name, type;
  };
  using Scope = std::vector<Variable>;

  int pick(int most) { return static_cast<int>(random_() % static_cast<std::uint32_t>(most)); }
  bool chance(int in) { return pick(in) == 0; }

  static bool is_a(const std::string& type, const std::string& wanted) {
    static const std::map<std::string, std::string> parents = {{"truck", "vehicle"},   {"boat", "vehicle"},
                                                               {"vehicle", "movable"}, {"crate", "thing"},
                                                               {"thing", "movable"},   {"movable", "object"}};
    for (std::string t = type; !t.empty();) {
      if (t == wanted || (wanted == "cargo" && (t == "thing" || t == "box"))) return true;
      const auto above = parents.find(t);
      t = above == parents.end() ? "" : above->second;
    }
    return false;
  }

  std::string term(const std::string& type, const Scope& scope) {
    static const Scope objects = {{"home", "place"}, {"x", "place"},  {"spare", "truck"},
                                  {"b1", "boat"},    {"c1", "crate"}, {"x1", "box"}};
    std::vector<std::string> fits;
    for (const Variable& variable : scope) {
      if (is_a(variable.type, type)) fits.push_back(variable.name);
    }
    if (fits.empty() || chance(6)) {
      for (const Variable& object : objects) {
        if (is_a(object.type, type)) fits.push_back(object.name);
      }
    }
    return fits[static_cast<std::size_t>(pick(static_cast<int>(fits.size())))];
  }

  std::string atom(const Scope& scope, bool may_be_derived) {
    switch (pick(may_be_derived ? 8 : 4)) {
      case 0:
        return "(at " + term("movable", scope) + " " + term("place", scope) + ")";
      case 1:
        return "(in " + term("cargo", scope) + " " + term("vehicle", scope) + ")";
      case 2:
        return "(ok " + term("vehicle", scope) + ")";
      case 3:
        return "(lit)";
      case 4:
        return "(busy " + term("vehicle", scope) + ")";
      case 5:
        return "(reach " + term("place", scope) + " " + term("place", scope) + ")";
      case 6:
        return "(link " + term("place", scope) + " " + term("place", scope) + ")";
      default:
        return "(free)";
    }
  }

  std::string fluent(const Scope& scope) {
    switch (pick(5)) {
      case 0:
        return "(fuel " + term("vehicle", scope) + ")";
      case 1:
        return "(room " + term("vehicle", scope) + ")";
      case 2:
        return "(weight " + term("cargo", scope) + ")";
      case 3:
        return "(dist " + term("place", scope) + " " + term("place", scope) + ")";
      default:
        return "(price)";
    }
  }

  std::string number() {
    static const char* numbers[] = {"0", "1", "2", "3", "5", "0.5", "2.25", "-1"};
    return numbers[pick(8)];
  }

  std::string expression(const Scope& scope, int depth) {
    if (depth > 1 || chance(2)) return chance(3) ? number() : fluent(scope);
    const std::string a = expression(scope, depth + 1), b = expression(scope, depth + 1);
    switch (pick(7)) {
      case 0:
        return "(* " + a + " " + b + ")";
      case 1:
        return "(/ " + a + " " + (b == "0" ? "4" : b) + ")";  // a zero that stands there is an error
      case 2:
        return "(- " + a + ")";
      case 3:
      case 4:
        return "(- " + a + " " + b + ")";
      default:
        return "(+ " + a + " " + b + (chance(4) ? " 1)" : ")");
    }
  }

  std::string comparison(const Scope& scope) {
    static const char* relations[] = {"<", "<=", "=", ">=", ">"};
    return std::string("(") + relations[pick(5)] + " " + expression(scope, 0) + " " + expression(scope, 1) +
           ")";
  }

  Variable variable() {
    static const char* types[] = {"vehicle", "truck", "thing", "place", "movable", "box"};
    return {"?q" + std::to_string(names_++), types[pick(6)]};
  }

  std::string condition(Scope scope, int depth) {
    const int choice = pick(depth > 2 ? 5 : 12);
    if (choice < 2) return atom(scope, true);
    if (choice == 2) return "(not " + atom(scope, true) + ")";
    if (choice == 3) return comparison(scope);
    if (choice == 4) return "(= " + term("movable", scope) + " " + term("vehicle", scope) + ")";
    if (choice == 5) return "(not " + condition(scope, depth + 1) + ")";
    if (choice < 8) {
      const char* head = choice == 6 ? "(and " : "(or ";
      return head + condition(scope, depth + 1) + " " + condition(scope, depth + 1) + ")";
    }
    if (choice == 8) return "(imply " + condition(scope, depth + 1) + " " + condition(scope, depth + 1) + ")";
    const Variable bound = variable();
    scope.push_back(bound);
    return std::string(choice < 11 ? "(exists" : "(forall") + " (" + bound.name + " - " + bound.type + ") " +
           condition(scope, depth + 1) + ")";
  }

  std::string change(const Scope& scope) {
    static const char* targets[] = {"fuel", "room", "weight", "price"};
    const int target = pick(4);
    const std::string fluent = target == 3 ? "(price)"
                                           : std::string("(") + targets[target] + " " +
                                                 term(target == 2 ? "cargo" : "vehicle", scope) + ")";
    switch (pick(9)) {
      case 0:
        return "(scale-up " + fluent + " 2)";
      case 1:
        return "(scale-down " + fluent + " " + (chance(3) ? expression(scope, 1) : "2") + ")";
      case 2:
      case 3:
        return "(assign " + fluent + " " + expression(scope, 1) + ")";
      case 4:
      case 5:
        return "(decrease " + fluent + " " + expression(scope, 1) + ")";
      default:
        return "(increase " + fluent + " " + expression(scope, 1) + ")";
    }
  }

  std::string effect(Scope scope, int depth) {
    const int choice = pick(depth > 2 ? 5 : 8);
    if (choice < 2) return atom(scope, false);
    if (choice == 2) return "(not " + atom(scope, false) + ")";
    if (choice < 5) return change(scope);
    if (choice == 5) return "(when " + condition(scope, 2) + " " + effect(scope, depth + 1) + ")";
    if (choice == 6) return "(and " + effect(scope, depth + 1) + " " + effect(scope, depth + 1) + ")";
    const Variable bound = variable();
    scope.push_back(bound);
    return "(forall (" + bound.name + " - " + bound.type + ") (when " + condition(scope, 2) + " " +
           effect(scope, depth + 1) + "))";
  }

  std::string action(int index) {
    const Scope scope = {{"?v", "vehicle"}, {"?p", "place"}, {"?c", "thing"}};
    std::string precondition = chance(2) ? "(at ?v ?p)" : "(ok ?v)";
    if (!chance(3)) precondition += " " + condition(scope, 1);
    std::string effects = effect(scope, 0);
    if (!chance(4)) effects += " " + effect(scope, 1);
    if (!chance(3)) effects += " (increase (spent) " + (chance(3) ? expression(scope, 1) : number()) + ")";
    const char* cargo = chance(3) ? "(either box thing)" : "thing";
    // A box has no place: conditions on ?c as a thing would be type errors.
    const bool boxed = cargo[0] == '(';
    const std::string type =
        boxed && effects.find("?c") == std::string::npos && precondition.find("?c") == std::string::npos
            ? cargo
            : "thing";
    return "  (:action a" + std::to_string(index) + " :parameters (?v - vehicle ?p - place ?c - " + type +
           ")\n    :precondition (and " + precondition + ")\n    :effect (and " + effects + "))\n";
  }

  std::string problem() {
    std::string init = "(= (price) " + number() + ") (= (spent) 0)";
    for (const std::string vehicle : {"spare", "b1"}) {
      init += " (at " + vehicle + (chance(2) ? " home)" : " x)");
      if (!chance(4) || vehicle == "b1") init += " (= (fuel " + vehicle + ") " + number() + ")";
      if (!chance(3)) init += " (= (room " + vehicle + ") " + number() + ")";
      if (!chance(3)) init += " (ok " + vehicle + ")";
    }
    if (chance(2)) init += " (link home x)";
    if (chance(2)) init += " (link x home)";
    if (chance(2)) init += " (lit)";
    if (chance(2)) init += " (in c1 b1)";
    if (!chance(3)) init += " (= (weight c1) 2)";
    init += " (= (weight x1) 3) (= (dist home x) 4)";
    if (chance(2)) init += " (= (dist x home) 0)";
    std::string metric;
    if (!chance(4)) {
      static const char* metrics[] = {"(spent)", "(+ (spent) (price))", "(- (* 2 (spent)) (fuel b1))",
                                      "(+ (* (price) (price)) (spent))", "(* 3 (price))"};
      metric = std::string(" (:metric ") + (chance(3) ? "maximize " : "minimize ") + metrics[pick(5)] + ")";
    }
    return "(define (problem random) (:domain features)\n  (:objects x - place b1 - boat c1 - crate x1 - "
           "box)\n  (:init " +
           init + ")\n  (:goal (and " + condition({}, 1) + " " + condition({}, 2) + "))" + metric + ")";
  }

  std::mt19937 random_;
  int names_ = 0;
};

}  // namespace

TaskText feature_task(std::uint32_t seed) {
  return Generator(seed).run();
}

}  // namespace stepwright::pddl::testing
