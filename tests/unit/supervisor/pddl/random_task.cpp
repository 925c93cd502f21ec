#include "tests/unit/supervisor/pddl/random_task.h"

#include <random>

#include "tests/unit/supervisor/pddl/sample_tasks.h"

namespace stepwright::pddl::testing {
namespace {

// Facts (p o) of three objects, fluents (x) and (y) that the actions keep between 0 and 6, costs that may
// depend on the state.
class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain d) (:requirements :adl :numeric-fluents) (:types thing)
      (:predicates (p ?o - thing) (q) (near ?a ?b - thing)) (:functions (x) (y) (cost))
)";
    const int count = 3 + pick(3);
    for (int i = 0; i < count; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string text =
        "(define (problem r) (:domain d) (:objects a b c - thing) (:init (near a b) (near b c) (near c a)";
    if (pick(2) != 0) text += " (p a)";
    if (pick(2) != 0) text += " (q)";
    text += " (= (x) " + number(3) + ") (= (y) " + number(3) + ") (= (cost) 0)) (:goal (and " +
            condition("b") + " " + condition("c") + " " + comparison() + ")) (:metric minimize " +
            (pick(3) == 0 ? "(+ (cost) (* 2 (y)))" : "(cost)") + "))";
    return text;
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
  std::string number(int most) { return std::to_string(pick(most + 1)); }
  std::string fluent() { return pick(2) != 0 ? "(x)" : "(y)"; }

  std::string comparison() {
    static const char* relations[] = {"<", "<=", "=", ">=", ">"};
    const std::string right = pick(4) == 0 ? "(+ (y) 1)" : number(6);
    return std::string("(") + relations[pick(5)] + " (x) " + right + ")";
  }

  std::string condition(const std::string& object) {
    switch (pick(8)) {
      case 0:
        return "(not (p " + object + "))";
      case 1:
        return "(or (q) (p " + object + "))";
      case 2:
        return "(q)";
      case 3:
        return "(exists (?e - thing) (and (p ?e) (not (= ?e " + object + "))))";
      case 4:
        return "(imply (q) " + comparison() + ")";
      case 5:
        return comparison();
      default:
        return "(p " + object + ")";
    }
  }

  // A change that stays between 0 and 6 because of the precondition that comes with it.
  std::string change(std::string& precondition) {
    const std::string f = fluent();
    const std::string amount = std::to_string(1 + pick(3));
    switch (pick(4)) {
      case 0:
        return "(assign " + f + " " + number(6) + ")";
      case 1:
        precondition += " (>= " + f + " " + amount + ")";
        return "(decrease " + f + " " + amount + ")";
      default:
        precondition += " (<= (+ " + f + " " + amount + ") 6)";
        return "(increase " + f + " " + amount + ")";
    }
  }

  std::string action(int index) {
    std::string precondition = "(near ?o ?u)";
    if (pick(2) != 0) precondition += " " + condition("?u");
    std::string effect = pick(3) != 0 ? change(precondition) : "";
    if (pick(2) != 0) effect += pick(3) == 0 ? " (not (p ?o))" : " (p ?o)";
    if (pick(3) == 0) effect += pick(2) != 0 ? " (q)" : " (not (q))";
    if (pick(3) == 0) effect += " (when " + condition("?o") + " (p ?u))";
    if (pick(4) == 0) effect += " (forall (?e - thing) (when (near ?e ?o) (not (p ?e))))";
    effect += " (increase (cost) " + (pick(3) == 0 ? "(* 2 " + fluent() + ")" : number(4)) + ")";
    return "(:action a" + std::to_string(index) + " :parameters (?o ?u - thing) :precondition (and " +
           precondition + ") :effect (and " + effect + "))\n";
  }

  std::mt19937 random_;
};

}  // namespace

RandomTask random_task(std::uint32_t seed) {
  Generator generator(seed);
  std::string domain = generator.domain();
  std::string problem = generator.problem();
  Task task = make_task(domain, problem);
  return {std::move(domain), std::move(problem), std::move(task)};
}

}  // namespace stepwright::pddl::testing
