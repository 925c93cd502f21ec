// A loop of belts with diverters: boxes leave it into lanes, in the order that is wanted.

#include <algorithm>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Boxes enter a loop of belt segments in a given order and leave it through diverters.
(define (domain sorting-line)
  (:requirements :typing :numeric-fluents :negative-preconditions)
  (:types box segment lane)
  (:predicates
    (waiting ?b - box)               ; first in front of the line
    (queued ?b ?next - box)          ; next waits behind b
    (on-belt ?b - box ?s - segment)
    (empty ?s - segment)
    (entry ?s - segment)
    (leads ?a ?b - segment)
    (diverter ?s - segment ?l - lane)
    (turned ?s - segment)            ; the diverter points into its lane
    (in-lane ?b - box ?l - lane)
    (newest ?b - box ?l - lane)      ; nothing came into the lane after it
    (behind ?b ?ahead - box)
    (unused ?l - lane))
  (:functions
    (filled ?l - lane)
    (places ?l - lane)
    (energy))
  (:action feed
    :parameters (?b ?next - box ?s - segment)
    :precondition (and (waiting ?b) (queued ?b ?next) (entry ?s) (empty ?s))
    :effect (and (not (waiting ?b)) (waiting ?next) (on-belt ?b ?s) (not (empty ?s))
                 (increase (energy) 1)))
  (:action advance
    :parameters (?b - box ?from ?to - segment)
    :precondition (and (on-belt ?b ?from) (leads ?from ?to) (empty ?to))
    :effect (and (not (on-belt ?b ?from)) (on-belt ?b ?to) (empty ?from) (not (empty ?to))
                 (increase (energy) 1)))
  (:action turn-in
    :parameters (?s - segment ?l - lane)
    :precondition (and (diverter ?s ?l) (not (turned ?s)))
    :effect (and (turned ?s) (increase (energy) 2)))
  (:action divert-first
    :parameters (?b - box ?s - segment ?l - lane)
    :precondition (and (on-belt ?b ?s) (diverter ?s ?l) (turned ?s) (unused ?l)
                       (<= (+ (filled ?l) 1) (places ?l)))
    :effect (and (not (on-belt ?b ?s)) (empty ?s) (not (turned ?s)) (not (unused ?l))
                 (in-lane ?b ?l) (newest ?b ?l) (increase (filled ?l) 1) (increase (energy) 1)))
  (:action divert
    :parameters (?b ?ahead - box ?s - segment ?l - lane)
    :precondition (and (on-belt ?b ?s) (diverter ?s ?l) (turned ?s) (newest ?ahead ?l)
                       (<= (+ (filled ?l) 1) (places ?l)))
    :effect (and (not (on-belt ?b ?s)) (empty ?s) (not (turned ?s)) (not (newest ?ahead ?l))
                 (in-lane ?b ?l) (newest ?b ?l) (behind ?b ?ahead)
                 (increase (filled ?l) 1) (increase (energy) 1))))
)";

// The loop as the reference plan moves it.
class Loop {
 public:
  explicit Loop(int segments) : belt_(static_cast<std::size_t>(segments), 0) {}

  std::vector<std::string> plan;

  bool holds(int box) const { return std::find(belt_.begin(), belt_.end(), box) != belt_.end(); }

  // Puts the next box on segment 0; there is an empty place.
  void feed(int box) {
    while (belt_[0] != 0) rotate();
    plan.push_back(fmt::format("feed box{} box{} s0", box, box + 1));
    belt_[0] = box;
  }

  // Carries the box to the diverter and out. `ahead` is the newest box of the lane, 0 if there is none.
  void divert(int box, int lane, std::size_t at, int ahead) {
    while (belt_[at] != box) rotate();
    plan.push_back(fmt::format("turn-in s{} lane{}", at, lane));
    plan.push_back(ahead == 0 ? fmt::format("divert-first box{} s{} lane{}", box, at, lane)
                              : fmt::format("divert box{} box{} s{} lane{}", box, ahead, at, lane));
    belt_[at] = 0;
  }

 private:
  // Every box one segment on, the one before the gap first.
  void rotate() {
    const std::size_t n = belt_.size();
    const auto gap = static_cast<std::size_t>(std::find(belt_.begin(), belt_.end(), 0) - belt_.begin());
    for (std::size_t k = 1; k < n; ++k) {
      const std::size_t from = (gap + n - k) % n, to = (from + 1) % n;
      if (belt_[from] == 0) continue;
      plan.push_back(fmt::format("advance box{} s{} s{}", belt_[from], from, to));
      std::swap(belt_[from], belt_[to]);
    }
  }

  std::vector<int> belt_;  // 0: empty
};

// Boxes 1 .. n wait in this order; a box may leave `window` places earlier than its place in the queue.
std::vector<int> leaving_order(int boxes, int window, Random& random) {
  std::vector<int> order, pool;
  for (int next = 1; next <= boxes || !pool.empty();) {
    while (next <= boxes && static_cast<int>(pool.size()) < window) pool.push_back(next++);
    const int pick = random.below(static_cast<int>(pool.size()));
    order.push_back(pool[static_cast<std::size_t>(pick)]);
    pool.erase(pool.begin() + pick);
  }
  return order;
}

Draft draft(int size, Random& random) {
  const int boxes = 1 + 2 * size, lanes = 1 + (size + 1) / 2, segments = lanes + 2 + size / 3;
  ProblemText problem(fmt::format("sorting-line-{}", size), "sorting-line");
  // The last box of the queue never enters: it only ends the queue.
  problem.objects("box", numbered("box", boxes + 1));
  problem.objects("lane", numbered("lane", lanes));
  std::vector<std::string> names;
  for (int s = 0; s < segments; ++s) {
    names.push_back(fmt::format("s{}", s));
    problem.init("(empty s{0}) (leads s{0} s{1})", s, (s + 1) % segments);
  }
  problem.objects("segment", names);
  problem.init("(entry s0) (waiting box1) (= (energy) 0)");
  for (int b = 1; b <= boxes; ++b) problem.init("(queued box{} box{})", b, b + 1);
  for (int l = 1; l <= lanes; ++l)
    problem.init("(diverter s{0} lane{0}) (unused lane{0}) (= (filled lane{0}) 0)", l);
  Loop loop(segments);
  std::vector<int> newest(static_cast<std::size_t>(lanes) + 1, 0), filled(newest);
  int fed = 0, advances = 0;
  for (const int box : leaving_order(boxes, segments - 1, random)) {
    const int lane = random.between(1, lanes);
    const auto l = static_cast<std::size_t>(lane);
    while (!loop.holds(box)) loop.feed(++fed);
    loop.divert(box, lane, l, newest[l]);
    problem.goal("(in-lane box{} lane{})", box, lane);
    if (newest[l] != 0 && random.below(2) == 0) problem.goal("(behind box{} box{})", box, newest[l]);
    newest[l] = box;
    advances += lane;
    ++filled[l];
  }
  for (int l = 1; l <= lanes; ++l) {
    problem.init("(= (places lane{}) {})", l, std::max(1, filled[static_cast<std::size_t>(l)]));
  }
  problem.metric("minimize (energy)");
  // Every box is fed, advances to its lane's segment at least, needs a turn of the diverter and leaves.
  return {problem.text(), loop.plan, 4.0 * boxes + advances};
}

}  // namespace

Generator sorting_line() {
  return {"sorting_line", "boxes from a belt into lanes, in order", kDomain, {1, 2, 3, 4, 6}, 60, false,
          draft};
}

}  // namespace stepwright::bench
