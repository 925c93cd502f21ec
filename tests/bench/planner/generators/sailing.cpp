// Boats on an open sea pick up people: coordinates are numbers without bounds.

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; The wind comes from the north: a boat sails south, east and west cheaply, to windward dearly.
(define (domain sailing)
  (:requirements :typing :numeric-fluents :negative-preconditions)
  (:types boat person)
  (:predicates (rescued ?p - person))
  (:functions
    (x ?b - boat)
    (y ?b - boat)
    (px ?p - person)
    (py ?p - person)
    (reach)
    (effort))
  (:action run-south
    :parameters (?b - boat)
    :effect (and (decrease (y ?b) 3) (increase (effort) 1)))
  (:action reach-east
    :parameters (?b - boat)
    :effect (and (increase (x ?b) 3) (increase (effort) 2)))
  (:action reach-west
    :parameters (?b - boat)
    :effect (and (decrease (x ?b) 3) (increase (effort) 2)))
  (:action tack-north-east
    :parameters (?b - boat)
    :effect (and (increase (x ?b) 1.5) (increase (y ?b) 1.5) (increase (effort) 3)))
  (:action tack-north-west
    :parameters (?b - boat)
    :effect (and (decrease (x ?b) 1.5) (increase (y ?b) 1.5) (increase (effort) 3)))
  (:action rescue
    :parameters (?b - boat ?p - person)
    :precondition (and (not (rescued ?p))
                       (<= (+ (- (x ?b) (px ?p)) (- (y ?b) (py ?p))) (reach))
                       (<= (+ (- (x ?b) (px ?p)) (- (py ?p) (y ?b))) (reach))
                       (<= (+ (- (px ?p) (x ?b)) (- (y ?b) (py ?p))) (reach))
                       (<= (+ (- (px ?p) (x ?b)) (- (py ?p) (y ?b))) (reach)))
    :effect (and (rescued ?p) (increase (effort) 1))))
)";

constexpr double kReach = 3.5;

// The first boat: north by tacking to and fro, then east or west, each to within half a stroke.
struct Boat {
  double x = 0, y = 0;
  bool east = true;
  std::vector<std::string> plan = {};

  void sail(int to_x, int to_y) {
    while (y < to_y - 1.5) {
      plan.push_back(east ? "tack-north-east boat1" : "tack-north-west boat1");
      x += east ? 1.5 : -1.5;
      y += 1.5;
      east = !east;
    }
    for (; y > to_y + 1.5; y -= 3) plan.push_back("run-south boat1");
    for (; x < to_x - 1.5; x += 3) plan.push_back("reach-east boat1");
    for (; x > to_x + 1.5; x -= 3) plan.push_back("reach-west boat1");
  }
};

Draft draft(int size, Random& random) {
  const int boats = 1 + size / 3, people = 1 + size, sea = 10 + 8 * size;
  ProblemText problem(fmt::format("sailing-{}", size), "sailing");
  problem.objects("boat", numbered("boat", boats));
  problem.objects("person", numbered("person", people));
  problem.init("(= (effort) 0) (= (reach) {})", kReach);
  Boat boat;
  for (int b = 1; b <= boats; ++b) {
    const int x = random.between(-sea, sea), y = random.between(-sea, sea);
    if (b == 1) boat.x = x, boat.y = y;
    problem.init("(= (x boat{0}) {1}) (= (y boat{0}) {2})", b, x, y);
  }
  for (int p = 1; p <= people; ++p) {
    const int x = random.between(-sea, sea), y = random.between(-sea, sea);
    problem.init("(= (px person{0}) {1}) (= (py person{0}) {2})", p, x, y);
    problem.goal("(rescued person{})", p);
    boat.sail(x, y);
    boat.plan.push_back(fmt::format("rescue boat1 person{}", p));
  }
  problem.metric("minimize (effort)");
  return {problem.text(), boat.plan, static_cast<double>(people)};
}

}  // namespace

Generator sailing() {
  return {"sailing", "boats on an unbounded sea", kDomain, {1, 2, 3, 4, 6}, 60, false, draft};
}

}  // namespace stepwright::bench
