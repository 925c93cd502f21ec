// Rovers with batteries take samples and pictures and send them to a lander.

#include <deque>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Everything a rover does takes energy; the sun refills its battery at some waypoints.
(define (domain rovers)
  (:requirements :typing :numeric-fluents)
  (:types rover waypoint rock target)
  (:predicates
    (at ?r - rover ?w - waypoint)
    (path ?a ?b - waypoint)
    (sunny ?w - waypoint)
    (hears-lander ?w - waypoint)
    (has-drill ?r - rover)
    (has-camera ?r - rover)
    (lies ?s - rock ?w - waypoint)
    (sees ?w - waypoint ?t - target)
    (sample ?r - rover ?s - rock)
    (picture ?r - rover ?t - target)
    (aligned ?r - rover ?t - target)
    (analysed ?s - rock)
    (received ?t - target))
  (:functions
    (energy ?r - rover)
    (capacity ?r - rover)
    (hold ?r - rover)        ; free places for samples
    (slope ?a ?b - waypoint) ; energy of a way
    (spent))
  (:action go
    :parameters (?r - rover ?a ?b - waypoint)
    :precondition (and (at ?r ?a) (path ?a ?b) (>= (energy ?r) (slope ?a ?b)))
    :effect (and (not (at ?r ?a)) (at ?r ?b)
                 (decrease (energy ?r) (slope ?a ?b)) (increase (spent) (slope ?a ?b))))
  (:action recharge
    :parameters (?r - rover ?w - waypoint)
    :precondition (and (at ?r ?w) (sunny ?w) (< (energy ?r) (capacity ?r)))
    :effect (and (assign (energy ?r) (capacity ?r)) (increase (spent) 3)))
  (:action drill
    :parameters (?r - rover ?s - rock ?w - waypoint)
    :precondition (and (at ?r ?w) (lies ?s ?w) (has-drill ?r) (>= (energy ?r) 5) (>= (hold ?r) 1))
    :effect (and (not (lies ?s ?w)) (sample ?r ?s) (decrease (hold ?r) 1)
                 (decrease (energy ?r) 5) (increase (spent) 5)))
  (:action align
    :parameters (?r - rover ?t - target ?w - waypoint)
    :precondition (and (at ?r ?w) (sees ?w ?t) (has-camera ?r) (>= (energy ?r) 2))
    :effect (and (aligned ?r ?t) (decrease (energy ?r) 2) (increase (spent) 2)))
  (:action photograph
    :parameters (?r - rover ?t - target ?w - waypoint)
    :precondition (and (at ?r ?w) (sees ?w ?t) (aligned ?r ?t) (>= (energy ?r) 1))
    :effect (and (not (aligned ?r ?t)) (picture ?r ?t)
                 (decrease (energy ?r) 1) (increase (spent) 1)))
  (:action send-analysis
    :parameters (?r - rover ?s - rock ?w - waypoint)
    :precondition (and (at ?r ?w) (hears-lander ?w) (sample ?r ?s) (>= (energy ?r) 4))
    :effect (and (not (sample ?r ?s)) (analysed ?s) (increase (hold ?r) 1)
                 (decrease (energy ?r) 4) (increase (spent) 4)))
  (:action send-picture
    :parameters (?r - rover ?t - target ?w - waypoint)
    :precondition (and (at ?r ?w) (hears-lander ?w) (picture ?r ?t) (>= (energy ?r) 6))
    :effect (and (received ?t) (decrease (energy ?r) 6) (increase (spent) 6))))
)";

constexpr int kCapacity = 50;
constexpr int kReserve = 36;  // two ways of 9 and one job of 6 fit between two sunny waypoints

// A ring of waypoints with chords; the even ones are sunny and chords join only those, so that every second
// waypoint of any way is sunny.
struct Map {
  int count = 0;
  std::vector<std::vector<int>> slope;  // 0: no path

  std::vector<int> way(int from, int to) const {
    std::vector<int> before(static_cast<std::size_t>(count), -1);
    std::deque<int> open = {to};
    before[static_cast<std::size_t>(to)] = to;
    while (before[static_cast<std::size_t>(from)] < 0) {
      const int at = open.front();
      open.pop_front();
      for (int next = 0; next < count; ++next) {
        if (slope[static_cast<std::size_t>(at)][static_cast<std::size_t>(next)] == 0) continue;
        if (before[static_cast<std::size_t>(next)] >= 0) continue;
        before[static_cast<std::size_t>(next)] = at;
        open.push_back(next);
      }
    }
    std::vector<int> stops;
    for (int at = from; at != to; at = before[static_cast<std::size_t>(at)]) {
      stops.push_back(before[static_cast<std::size_t>(at)]);
    }
    return stops;
  }
};

Map random_map(int count, Random& random) {
  Map map{count, std::vector<std::vector<int>>(static_cast<std::size_t>(count),
                                               std::vector<int>(static_cast<std::size_t>(count), 0))};
  const auto join = [&](int a, int b) {
    const int slope = random.between(4, 9);
    map.slope[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = slope;
    map.slope[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)] = slope;
  };
  for (int w = 0; w < count; ++w) join(w, (w + 1) % count);
  for (int i = 0; i < count / 3; ++i) {
    const int a = 2 * random.below(count / 2), b = 2 * random.below(count / 2);
    if (a != b) join(a, b);
  }
  return map;
}

// The first rover can do everything and does it.
struct Rover {
  const Map& map;
  int at;
  int energy = kCapacity;
  std::vector<std::string> plan;

  void charge() {
    if (at % 2 != 0 || energy >= kReserve) return;
    plan.push_back(fmt::format("recharge rover1 w{}", at));
    energy = kCapacity;
  }
  void go(int to) {
    charge();
    for (const int next : map.way(at, to)) {
      plan.push_back(fmt::format("go rover1 w{} w{}", at, next));
      energy -= map.slope[static_cast<std::size_t>(at)][static_cast<std::size_t>(next)];
      at = next;
      charge();
    }
  }
  void act(const std::string& what, int cost) {
    plan.push_back(fmt::format("{} w{}", what, at));
    energy -= cost;
    charge();
  }
};

Draft draft(int size, Random& random) {
  const int rovers = 1 + size / 2, waypoints = 4 + 2 * size, rocks = 1 + size, targets = 1 + size;
  ProblemText problem(fmt::format("rovers-{}", size), "rovers");
  std::vector<std::string> names;
  for (int w = 0; w < waypoints; ++w) names.push_back(fmt::format("w{}", w));
  problem.objects("waypoint", names);
  problem.objects("rover", numbered("rover", rovers));
  problem.objects("rock", numbered("rock", rocks));
  problem.objects("target", numbered("target", targets));
  problem.init("(= (spent) 0)");
  const Map map = random_map(waypoints, random);
  for (int a = 0; a < waypoints; ++a) {
    if (a % 2 == 0) problem.init("(sunny w{})", a);
    for (int b = 0; b < waypoints; ++b) {
      const int slope = map.slope[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
      if (slope > 0) problem.init("(path w{0} w{1}) (= (slope w{0} w{1}) {2})", a, b, slope);
    }
  }
  const int lander = 2 * random.below(waypoints / 2);
  problem.init("(hears-lander w{})", lander);
  Rover rover{map, 2 * random.below(waypoints / 2), kCapacity, {}};
  for (int r = 1; r <= rovers; ++r) {
    const int at = r == 1 ? rover.at : random.below(waypoints);
    const int skill = r == 1 ? 3 : random.between(1, 3);
    problem.init(
        "(at rover{0} w{1}) (= (energy rover{0}) {2}) (= (capacity rover{0}) {2}) (= (hold rover{0}) 2)", r,
        at, kCapacity);
    if (skill & 1) problem.init("(has-drill rover{})", r);
    if (skill & 2) problem.init("(has-camera rover{})", r);
  }
  for (int s = 1; s <= rocks; ++s) {
    const int at = random.below(waypoints);
    problem.init("(lies rock{} w{})", s, at);
    problem.goal("(analysed rock{})", s);
    rover.go(at);
    rover.act(fmt::format("drill rover1 rock{}", s), 5);
    rover.go(lander);
    rover.act(fmt::format("send-analysis rover1 rock{}", s), 4);
  }
  for (int t = 1; t <= targets; ++t) {
    const int at = random.below(waypoints), also = random.below(waypoints);
    problem.init("(sees w{} target{})", at, t);
    if (also != at) problem.init("(sees w{} target{})", also, t);
    problem.goal("(received target{})", t);
    rover.go(at);
    rover.act(fmt::format("align rover1 target{}", t), 2);
    rover.act(fmt::format("photograph rover1 target{}", t), 1);
    rover.go(lander);
    rover.act(fmt::format("send-picture rover1 target{}", t), 6);
  }
  problem.metric("minimize (spent)");
  return {problem.text(), rover.plan, 0.0};
}

}  // namespace

Generator rovers() {
  return {"rovers", "energy, sunny waypoints, a small hold", kDomain, {1, 2, 3, 4, 6}, 60, false, draft};
}

}  // namespace stepwright::bench
