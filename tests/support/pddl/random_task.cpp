#include "tests/support/pddl/random_task.h"

#include <random>

#include "tests/support/pddl/sample_tasks.h"

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

// Fluents (x), (y), (z) between 0 and 8, facts (p o) of two objects, a fact (d o) derived from both.
class NumericGenerator {
 public:
  explicit NumericGenerator(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain n) (:requirements :adl :numeric-fluents :derived-predicates)
      (:types thing) (:predicates (p ?o - thing) (d ?o - thing)) (:functions (x) (y) (z) (cost))
)";
    text += "(:derived (d ?o - thing) (or " + std::string(pick(2) != 0 ? "(p ?o)" : "(not (p ?o))") +
            " (>= (x) " + number(4, 8) + ")))\n";
    const int count = 4 + pick(3);
    for (int i = 0; i < count; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string text = "(define (problem m) (:domain n) (:objects a b - thing) (:init";
    if (pick(2) != 0) text += " (p a)";
    text += " (= (x) " + number(0, 3) + ") (= (y) " + number(0, 8) + ") (= (z) " + number(0, 3) +
            ") (= (cost) 0)) (:goal (and " + comparison() + " " + comparison();
    if (pick(2) != 0) text += " (d b)";
    if (pick(4) == 0) text += " (not (d a))";
    if (pick(3) == 0) text += " (p a)";
    return text + "))" + (pick(4) == 0 ? "" : " (:metric minimize (cost))") + ")";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
  std::string number(int least, int most) { return std::to_string(least + pick(most - least + 1)); }
  std::string fluent() {
    static const char* names[] = {"(x)", "(y)", "(z)"};
    return names[pick(3)];
  }

  std::string comparison() {
    static const char* relations[] = {"<", "<=", "=", ">=", ">", ">="};
    const std::string relation = relations[pick(6)];
    switch (pick(4)) {
      case 0:
        return "(" + relation + " (+ (x) (y)) " + number(4, 12) + ")";
      case 1:
        return "(" + relation + " (+ (* 2 (x)) (z)) (y))";
      default:
        return "(" + relation + " " + fluent() + " " + number(3, 8) + ")";
    }
  }

  std::string increase(const std::string& f, const std::string& amount, std::string& precondition) {
    precondition += " (<= (+ " + f + " " + amount + ") 8)";
    return " (increase " + f + " " + amount + ")";
  }

  std::string decrease(const std::string& f, const std::string& amount, std::string& precondition) {
    precondition += " (>= " + f + " " + amount + ")";
    return " (decrease " + f + " " + amount + ")";
  }

  std::string change(std::string& precondition) {
    const std::string amount = number(1, 3);
    switch (pick(7)) {
      case 0:
        return " (assign " + fluent() + " " + number(0, 8) + ")";
      case 1:
        return decrease(fluent(), amount, precondition);
      case 2:  // from one to the other
        return decrease("(y)", amount, precondition) + increase("(x)", amount, precondition);
      case 3:
        return increase("(x)", "(z)", precondition);
      case 4:
        precondition += " (<= (+ (z) 3) 8)";
        return " (increase (z) 1) (when (p ?o) (increase (z) 2))";
      default:
        return increase(fluent(), amount, precondition);
    }
  }

  std::string action(int index) {
    std::string precondition;
    std::string effect = change(precondition);
    if (pick(3) == 0) precondition += pick(2) != 0 ? " (d ?o)" : " (not (d ?o))";
    if (pick(3) == 0) effect += pick(2) != 0 ? " (p ?o)" : " (not (p ?o))";
    effect += " (increase (cost) " + (pick(4) == 0 ? "(+ 1 (z))" : number(0, 4)) + ")";
    return "(:action a" + std::to_string(index) + " :parameters (?o - thing) :precondition (and" +
           precondition + ") :effect (and" + effect + "))\n";
  }

  std::mt19937 random_;
};

template <typename Source>
RandomTask generated(std::uint32_t seed) {
  Source generator(seed);
  std::string domain = generator.domain();
  std::string problem = generator.problem();
  Task task = make_task(domain, problem);
  return {std::move(domain), std::move(problem), std::move(task)};
}

}  // namespace

RandomTask random_task(std::uint32_t seed) {
  return generated<Generator>(seed);
}

RandomTask random_numeric_task(std::uint32_t seed) {
  return generated<NumericGenerator>(seed);
}

}  // namespace stepwright::pddl::testing
