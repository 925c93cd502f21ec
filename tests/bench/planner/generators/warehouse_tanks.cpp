// Tanks of a warehouse joined by pipes: pumps move what is missing, in small or large batches.

#include <algorithm>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; One pipe of a tank is open at a time. Pumping uphill costs, a large batch less per unit.
(define (domain warehouse-tanks)
  (:requirements :typing :numeric-fluents :negative-preconditions)
  (:types tank)
  (:predicates
    (pipe ?a ?b - tank)
    (open ?a ?b - tank)
    (busy ?a - tank))
  (:functions
    (level ?a - tank)
    (capacity ?a - tank)
    (reserve ?a - tank)       ; a pump never empties a tank below this
    (lift ?a ?b - tank)       ; energy per unit
    (energy))
  (:action open-pipe
    :parameters (?a ?b - tank)
    :precondition (and (pipe ?a ?b) (not (busy ?a)) (not (busy ?b)))
    :effect (and (open ?a ?b) (busy ?a) (busy ?b) (increase (energy) 1)))
  (:action close-pipe
    :parameters (?a ?b - tank)
    :precondition (open ?a ?b)
    :effect (and (not (open ?a ?b)) (not (busy ?a)) (not (busy ?b))))
  (:action pump-unit
    :parameters (?a ?b - tank)
    :precondition (and (open ?a ?b) (>= (- (level ?a) 1) (reserve ?a))
                       (<= (+ (level ?b) 1) (capacity ?b)))
    :effect (and (decrease (level ?a) 1) (increase (level ?b) 1)
                 (increase (energy) (lift ?a ?b))))
  (:action pump-batch
    :parameters (?a ?b - tank)
    :precondition (and (open ?a ?b) (>= (- (level ?a) 5) (reserve ?a))
                       (<= (+ (level ?b) 5) (capacity ?b)))
    :effect (and (decrease (level ?a) 5) (increase (level ?b) 5)
                 (increase (energy) (* 3 (lift ?a ?b))))))
)";

constexpr int kReserve = 1;

struct Pipe {
  int from, to;
};

struct Plant {
  std::vector<int> level, capacity;
  std::vector<std::string> plan = {};

  int room(const Pipe& p) const {
    const int give = level[static_cast<std::size_t>(p.from)] - kReserve;
    const int take = capacity[static_cast<std::size_t>(p.to)] - level[static_cast<std::size_t>(p.to)];
    return std::min(give, take);
  }
  void pump(const Pipe& p, int amount) {
    const std::string tanks = fmt::format("t{} t{}", p.from, p.to);
    plan.push_back("open-pipe " + tanks);
    level[static_cast<std::size_t>(p.from)] -= amount;
    level[static_cast<std::size_t>(p.to)] += amount;
    for (; amount >= 5; amount -= 5) plan.push_back("pump-batch " + tanks);
    for (; amount >= 1; --amount) plan.push_back("pump-unit " + tanks);
    plan.push_back("close-pipe " + tanks);
  }
};

// The goal is what a random sequence of transfers leads to, within a tolerance for most tanks.
Draft draft(int size, Random& random) {
  const int tanks = 3 + size, transfers = 2 + 2 * size;
  ProblemText problem(fmt::format("warehouse-tanks-{}", size), "warehouse-tanks");
  std::vector<std::string> names;
  Plant plant;
  for (int t = 0; t < tanks; ++t) {
    names.push_back(fmt::format("t{}", t));
    const int capacity = random.between(10, 30);
    plant.capacity.push_back(capacity);
    plant.level.push_back(random.between(kReserve, capacity));
    problem.init("(= (level t{0}) {1}) (= (capacity t{0}) {2}) (= (reserve t{0}) {3})", t, plant.level.back(),
                 capacity, kReserve);
  }
  problem.objects("tank", names);
  problem.init("(= (energy) 0)");
  std::vector<Pipe> pipes;
  const auto join = [&](int a, int b) {
    if (a == b) return;
    for (const Pipe& known : pipes) {
      if (known.from == a && known.to == b) return;
    }
    pipes.push_back({a, b});
    problem.init("(pipe t{0} t{1}) (= (lift t{0} t{1}) {2})", a, b, random.between(1, 4));
  };
  for (int t = 0; t + 1 < tanks; ++t) {
    join(t, t + 1);
    join(t + 1, t);
  }
  for (int i = 0; i < size; ++i) {
    const int a = random.below(tanks), b = random.below(tanks);
    join(a, b);
  }
  const std::vector<int> first = plant.level;
  for (int i = 0; i < transfers || plant.level == first; ++i) {
    const Pipe pipe = pipes[static_cast<std::size_t>(random.below(static_cast<int>(pipes.size())))];
    const int room = plant.room(pipe);
    if (room > 0) plant.pump(pipe, random.between(1, room));
  }
  for (int t = 0; t < tanks; ++t) {
    const int level = plant.level[static_cast<std::size_t>(t)], slack = random.below(3);
    if (slack == 0) {
      problem.goal("(= (level t{}) {})", t, level);
    } else {
      problem.goal("(>= (level t{0}) {1}) (<= (level t{0}) {2})", t, level - slack, level + slack);
    }
    problem.goal("(not (busy t{}))", t);
  }
  problem.metric("minimize (energy)");
  return {problem.text(), plant.plan, 0.0};
}

}  // namespace

Generator warehouse_tanks() {
  return {"warehouse_tanks", "levels by pumps and pipes", kDomain, {1, 2, 3, 5, 8}, 80, false, draft};
}

}  // namespace stepwright::bench
