// Planes carry people between cities; they burn fuel with the distance and may fly fast with few on board.

#include <algorithm>
#include <cmath>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain = R"(; A slow flight burns little fuel, a fast one much but takes half the time.
(define (domain zeno)
  (:requirements :typing :numeric-fluents)
  (:types plane person city)
  (:predicates
    (at ?a - plane ?c - city)
    (waits ?p - person ?c - city)
    (inside ?p - person ?a - plane))
  (:functions
    (fuel ?a - plane)
    (tank ?a - plane)
    (slow-burn ?a - plane)
    (fast-burn ?a - plane)
    (seated ?a - plane)
    (seats ?a - plane)
    (fast-limit ?a - plane)
    (distance ?a ?b - city)
    (fuel-used)
    (hours))
  (:action board
    :parameters (?p - person ?a - plane ?c - city)
    :precondition (and (waits ?p ?c) (at ?a ?c) (< (seated ?a) (seats ?a)))
    :effect (and (not (waits ?p ?c)) (inside ?p ?a) (increase (seated ?a) 1)))
  (:action leave
    :parameters (?p - person ?a - plane ?c - city)
    :precondition (and (inside ?p ?a) (at ?a ?c))
    :effect (and (not (inside ?p ?a)) (waits ?p ?c) (decrease (seated ?a) 1)))
  (:action fly-slow
    :parameters (?a - plane ?from ?to - city)
    :precondition (and (at ?a ?from) (>= (fuel ?a) (* (distance ?from ?to) (slow-burn ?a))))
    :effect (and (not (at ?a ?from)) (at ?a ?to)
                 (decrease (fuel ?a) (* (distance ?from ?to) (slow-burn ?a)))
                 (increase (fuel-used) (* (distance ?from ?to) (slow-burn ?a)))
                 (increase (hours) (* 2 (distance ?from ?to)))))
  (:action fly-fast
    :parameters (?a - plane ?from ?to - city)
    :precondition (and (at ?a ?from) (<= (seated ?a) (fast-limit ?a))
                       (>= (fuel ?a) (* (distance ?from ?to) (fast-burn ?a))))
    :effect (and (not (at ?a ?from)) (at ?a ?to)
                 (decrease (fuel ?a) (* (distance ?from ?to) (fast-burn ?a)))
                 (increase (fuel-used) (* (distance ?from ?to) (fast-burn ?a)))
                 (increase (hours) (distance ?from ?to))))
  (:action refuel
    :parameters (?a - plane ?c - city)
    :precondition (and (at ?a ?c) (> (tank ?a) (fuel ?a)))
    :effect (and (assign (fuel ?a) (tank ?a)) (increase (hours) 5))))
)";

// The first plane carries one person after the other, slowly, with a full tank.
struct Flight {
  const std::vector<std::vector<int>>& distance;
  int at = 0;
  bool full = false;
  std::vector<std::string> plan = {};

  void fly(int to) {
    if (at == to) return;
    if (!full) plan.push_back(fmt::format("refuel plane1 city{}", at + 1));
    plan.push_back(fmt::format("fly-slow plane1 city{} city{}", at + 1, to + 1));
    full = false;
    at = to;
  }
};

Draft draft(int size, Random& random) {
  const int planes = 1 + size / 2, cities = 3 + size, people = 2 * size;
  ProblemText problem(fmt::format("zeno-{}", size), "zeno");
  problem.objects("plane", numbered("plane", planes));
  problem.objects("city", numbered("city", cities));
  problem.objects("person", numbered("person", people));
  problem.init("(= (fuel-used) 0) (= (hours) 0)");
  std::vector<std::pair<int, int>> map;
  for (int c = 0; c < cities; ++c) {
    const int x = random.below(30), y = random.below(30);
    map.emplace_back(x, y);
  }
  std::vector<std::vector<int>> distance;
  int longest = 1;
  for (int a = 0; a < cities; ++a) {
    auto& row = distance.emplace_back();
    for (int b = 0; b < cities; ++b) {
      const auto [ax, ay] = map[static_cast<std::size_t>(a)];
      const auto [bx, by] = map[static_cast<std::size_t>(b)];
      row.push_back(a == b ? 0 : 2 + static_cast<int>(std::lround(std::hypot(ax - bx, ay - by))));
      longest = std::max(longest, row.back());
      if (a != b) problem.init("(= (distance city{} city{}) {})", a + 1, b + 1, row.back());
    }
  }
  Flight flight{distance};
  for (int p = 1; p <= planes; ++p) {
    const int at = random.below(cities), burn = random.between(2, 4), tank = burn * longest * 5 / 2;
    const int fuel = random.below(tank);
    if (p == 1) flight.at = at;
    problem.init(
        "(at plane{0} city{1}) (= (slow-burn plane{0}) {2}) (= (fast-burn plane{0}) {3}) (= (tank plane{0}) "
        "{4}) "
        "(= (fuel plane{0}) {5}) (= (seated plane{0}) 0) (= (seats plane{0}) {6}) (= (fast-limit plane{0}) "
        "{7})",
        p, at + 1, burn, 2 * burn, tank, fuel, 3 + p % 2, 1 + p % 2);
  }
  for (int p = 1; p <= people; ++p) {
    const int from = random.below(cities), to = random.below(cities);
    problem.init("(waits person{} city{})", p, from + 1);
    problem.goal("(waits person{} city{})", p, to + 1);
    if (from == to) continue;
    flight.fly(from);
    flight.plan.push_back(fmt::format("board person{} plane1 city{}", p, from + 1));
    flight.fly(to);
    flight.plan.push_back(fmt::format("leave person{} plane1 city{}", p, to + 1));
  }
  problem.metric("minimize (+ (fuel-used) (* 2 (hours)))");
  return {problem.text(), flight.plan, 0.0};
}

}  // namespace

Generator zeno() {
  return {"zeno", "people by plane, slow or fast, with fuel", kDomain, {1, 2, 3, 4, 6}, 5000, false, draft};
}

}  // namespace stepwright::bench
