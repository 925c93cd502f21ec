// A drone inspects places in the air; its battery brings it back in time.

#include <algorithm>
#include <cstdlib>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; A hall with a grid of places; every move and every inspection takes one unit of charge.
(define (domain drone)
  (:requirements :typing :numeric-fluents :negative-preconditions)
  (:types spot)
  (:predicates (inspected ?s - spot))
  (:functions
    (x) (y) (z) (charge) (full-charge)
    (size-x) (size-y) (size-z)
    (xs ?s - spot) (ys ?s - spot) (zs ?s - spot))
  (:action east
    :parameters ()
    :precondition (and (>= (charge) 1) (<= (+ (x) 1) (size-x)))
    :effect (and (increase (x) 1) (decrease (charge) 1)))
  (:action west
    :parameters ()
    :precondition (and (>= (charge) 1) (>= (x) 1))
    :effect (and (decrease (x) 1) (decrease (charge) 1)))
  (:action north
    :parameters ()
    :precondition (and (>= (charge) 1) (<= (+ (y) 1) (size-y)))
    :effect (and (increase (y) 1) (decrease (charge) 1)))
  (:action south
    :parameters ()
    :precondition (and (>= (charge) 1) (>= (y) 1))
    :effect (and (decrease (y) 1) (decrease (charge) 1)))
  (:action climb
    :parameters ()
    :precondition (and (>= (charge) 1) (<= (+ (z) 1) (size-z)))
    :effect (and (increase (z) 1) (decrease (charge) 1)))
  (:action sink
    :parameters ()
    :precondition (and (>= (charge) 1) (>= (z) 1))
    :effect (and (decrease (z) 1) (decrease (charge) 1)))
  (:action inspect
    :parameters (?s - spot)
    :precondition (and (not (inspected ?s)) (>= (charge) 1)
                       (= (x) (xs ?s)) (= (y) (ys ?s)) (= (z) (zs ?s)))
    :effect (and (inspected ?s) (decrease (charge) 1)))
  (:action recharge
    :parameters ()
    :precondition (and (= (x) 0) (= (y) 0) (= (z) 0))
    :effect (assign (charge) (full-charge))))
)";

void fly(std::vector<std::string>& plan, const char* forth, const char* back, int distance) {
  for (int i = 0; i < std::abs(distance); ++i) plan.push_back(distance > 0 ? forth : back);
}

Draft draft(int size, Random& random) {
  const int spots = 1 + size, side = 2 + size / 2, height = 1 + size / 3;
  ProblemText problem(fmt::format("drone-{}", size), "drone");
  problem.objects("spot", numbered("spot", spots));
  problem.init("(= (x) 0) (= (y) 0) (= (z) 0) (= (size-x) {0}) (= (size-y) {0}) (= (size-z) {1})", side,
               height);
  std::vector<std::string> plan;
  int farthest = 0;
  for (int s = 1; s <= spots; ++s) {
    const int x = random.between(0, side), y = random.between(0, side), z = random.between(0, height);
    problem.init("(= (xs spot{0}) {1}) (= (ys spot{0}) {2}) (= (zs spot{0}) {3})", s, x, y, z);
    problem.goal("(inspected spot{})", s);
    farthest = std::max(farthest, x + y + z);
    fly(plan, "east", "west", x);
    fly(plan, "north", "south", y);
    fly(plan, "climb", "sink", z);
    plan.push_back(fmt::format("inspect spot{}", s));
    fly(plan, "east", "west", -x);
    fly(plan, "north", "south", -y);
    fly(plan, "climb", "sink", -z);
    plan.push_back("recharge");
  }
  problem.goal("(= (x) 0) (= (y) 0) (= (z) 0)");
  // There and back to the farthest place, and a little over.
  const int charge = 2 * farthest + 1 + size / 2;
  problem.init("(= (charge) {0}) (= (full-charge) {0})", charge);
  return {problem.text(), std::move(plan), 2.0 * farthest + spots};
}

}  // namespace

Generator drone() {
  return {"drone", "exact places in three dimensions, a battery", kDomain, {1, 2, 3, 4, 6}, 60, false, draft};
}

}  // namespace stepwright::bench
