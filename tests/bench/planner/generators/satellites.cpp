// Satellites turn, calibrate and take pictures; fuel and memory are numbers.

#include <algorithm>
#include <cmath>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain =
    R"(; Fuel is spent on turning, memory on pictures; one instrument has power at a time.
(define (domain satellites)
  (:requirements :typing :numeric-fluents :negative-preconditions)
  (:types satellite instrument mode direction)
  (:predicates
    (points ?s - satellite ?d - direction)
    (carries ?s - satellite ?i - instrument)
    (supports ?i - instrument ?m - mode)
    (reference ?i - instrument ?d - direction)
    (power-free ?s - satellite)
    (powered ?i - instrument)
    (calibrated ?i - instrument)
    (taken ?d - direction ?m - mode)
    (ground-station ?d - direction))
  (:functions
    (fuel ?s - satellite)
    (memory ?s - satellite)
    (memory-size ?s - satellite)
    (angle ?a ?b - direction)
    (volume ?d - direction ?m - mode)
    (fuel-used))
  (:action turn
    :parameters (?s - satellite ?from ?to - direction)
    :precondition (and (points ?s ?from) (not (points ?s ?to)) (>= (fuel ?s) (angle ?from ?to)))
    :effect (and (not (points ?s ?from)) (points ?s ?to)
                 (decrease (fuel ?s) (angle ?from ?to)) (increase (fuel-used) (angle ?from ?to))))
  (:action switch-on
    :parameters (?s - satellite ?i - instrument)
    :precondition (and (carries ?s ?i) (power-free ?s))
    :effect (and (powered ?i) (not (power-free ?s)) (not (calibrated ?i))))
  (:action switch-off
    :parameters (?s - satellite ?i - instrument)
    :precondition (and (carries ?s ?i) (powered ?i))
    :effect (and (not (powered ?i)) (power-free ?s)))
  (:action calibrate
    :parameters (?s - satellite ?i - instrument ?d - direction)
    :precondition (and (carries ?s ?i) (powered ?i) (points ?s ?d) (reference ?i ?d))
    :effect (calibrated ?i))
  (:action take
    :parameters (?s - satellite ?i - instrument ?d - direction ?m - mode)
    :precondition (and (carries ?s ?i) (powered ?i) (calibrated ?i) (supports ?i ?m) (points ?s ?d)
                       (>= (memory ?s) (volume ?d ?m)))
    :effect (and (taken ?d ?m) (decrease (memory ?s) (volume ?d ?m))))
  (:action downlink
    :parameters (?s - satellite ?d - direction)
    :precondition (and (points ?s ?d) (ground-station ?d) (< (memory ?s) (memory-size ?s)))
    :effect (and (assign (memory ?s) (memory-size ?s)) (increase (fuel-used) 1))))
)";

constexpr int kMemory = 40;

struct Direction {
  int x, y;
};

int angle(Direction a, Direction b) {
  return 1 + static_cast<int>(std::lround(std::hypot(a.x - b.x, a.y - b.y)));
}

// One satellite of the reference plan.
struct Satellite {
  int number;
  std::size_t points;
  int memory = kMemory;
  int used = 0;  // fuel
};

struct Reference {
  const std::vector<Direction>& sky;
  std::vector<std::string> plan = {};

  void turn(Satellite& s, std::size_t to) {
    if (s.points == to) return;
    plan.push_back(fmt::format("turn sat{} d{} d{}", s.number, s.points, to));
    s.used += angle(sky[s.points], sky[to]);
    s.points = to;
  }
  void take(Satellite& s, int instrument, std::size_t direction, int mode, int volume) {
    if (s.memory < volume) {
      turn(s, 0);
      plan.push_back(fmt::format("downlink sat{} d0", s.number));
      s.memory = kMemory;
    }
    turn(s, direction);
    plan.push_back(fmt::format("take sat{} inst{} d{} mode{}", s.number, instrument, direction, mode));
    s.memory -= volume;
  }
};

struct Picture {
  std::size_t direction;
  int mode;
  int volume;
};

// Instrument i belongs to satellite (i - 1) % satellites + 1, supports mode (i - 1) % modes + 1 and more, and
// its reference is direction references[i - 1].
Draft draft(int size, Random& random) {
  const int satellites = 1 + size / 2, modes = 2 + size / 3, directions = 4 + 2 * size;
  const int instruments = std::max(satellites, modes) + size / 2, pictures = 1 + 2 * size;
  ProblemText problem(fmt::format("satellites-{}", size), "satellites");
  problem.objects("satellite", numbered("sat", satellites));
  problem.objects("instrument", numbered("inst", instruments));
  problem.objects("mode", numbered("mode", modes));
  std::vector<Direction> sky;
  std::vector<std::string> names;
  for (int d = 0; d < directions; ++d) {
    const int x = random.below(40), y = random.below(40);
    sky.push_back({x, y});
    names.push_back(fmt::format("d{}", d));
  }
  problem.objects("direction", names);
  problem.init("(= (fuel-used) 0) (ground-station d0)");
  for (std::size_t a = 0; a < sky.size(); ++a) {
    for (std::size_t b = 0; b < sky.size(); ++b) {
      if (a != b) problem.init("(= (angle d{} d{}) {})", a, b, angle(sky[a], sky[b]));
    }
  }
  std::vector<Satellite> fleet;
  for (int s = 1; s <= satellites; ++s) {
    const auto points = static_cast<std::size_t>(random.below(directions));
    fleet.push_back({s, points});
    problem.init(
        "(points sat{0} d{1}) (power-free sat{0}) (= (memory sat{0}) {2}) (= (memory-size sat{0}) {2})", s,
        points, kMemory);
  }
  std::vector<std::size_t> references;
  for (int i = 1; i <= instruments; ++i) {
    references.push_back(static_cast<std::size_t>(random.below(directions)));
    problem.init("(carries sat{0} inst{1}) (supports inst{1} mode{2}) (reference inst{1} d{3})",
                 (i - 1) % satellites + 1, i, (i - 1) % modes + 1, references.back());
    const int also = random.between(1, modes);
    if (also != (i - 1) % modes + 1) problem.init("(supports inst{} mode{})", i, also);
  }
  std::vector<Picture> wanted;
  for (int p = 0; p < pictures; ++p) {
    const auto direction = static_cast<std::size_t>(random.below(directions));
    const int mode = random.between(1, modes), volume = random.between(5, 25);
    const bool again = std::any_of(wanted.begin(), wanted.end(), [&](const Picture& other) {
      return other.direction == direction && other.mode == mode;
    });
    if (again) continue;
    wanted.push_back({direction, mode, volume});
    problem.init("(= (volume d{} mode{}) {})", direction, mode, volume);
    problem.goal("(taken d{} mode{})", direction, mode);
  }
  Reference reference{sky};
  for (int m = 1; m <= modes; ++m) {
    const int i = m;  // the first instrument with the mode
    Satellite& s = fleet[static_cast<std::size_t>((i - 1) % satellites)];
    if (std::none_of(wanted.begin(), wanted.end(), [&](const Picture& p) { return p.mode == m; })) continue;
    reference.plan.push_back(fmt::format("switch-on sat{} inst{}", s.number, i));
    reference.turn(s, references[static_cast<std::size_t>(i - 1)]);
    reference.plan.push_back(fmt::format("calibrate sat{} inst{} d{}", s.number, i, s.points));
    for (const Picture& p : wanted) {
      if (p.mode == m) reference.take(s, i, p.direction, m, p.volume);
    }
    reference.plan.push_back(fmt::format("switch-off sat{} inst{}", s.number, i));
  }
  // Enough fuel for the reference plan and little more.
  for (const Satellite& s : fleet) problem.init("(= (fuel sat{}) {})", s.number, s.used + 20 + s.used / 5);
  problem.metric("minimize (fuel-used)");
  return {problem.text(), reference.plan, 0.0};
}

}  // namespace

Generator satellites() {
  return {"satellites", "fuel for turning, memory for pictures", kDomain, {1, 2, 3, 4, 6}, 60, false, draft};
}

}  // namespace stepwright::bench
