// Counters that shall stand in ascending order; the least number of steps is known.

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain = R"(; Every counter shall be at least one below the next.
(define (domain counters)
  (:requirements :typing :numeric-fluents)
  (:types counter)
  (:functions (value ?c - counter) (limit))
  (:action up
    :parameters (?c - counter)
    :precondition (<= (+ (value ?c) 1) (limit))
    :effect (increase (value ?c) 1))
  (:action down
    :parameters (?c - counter)
    :precondition (>= (value ?c) 1)
    :effect (decrease (value ?c) 1)))
)";

// The ascending values 0 .. limit that are nearest to `start` in the sum of differences: exact, counter by
// counter over all last values. Every step changes the sum by one, so this is the least number of steps.
std::vector<int> nearest_ascending(const std::vector<int>& start, int limit) {
  constexpr long kFar = std::numeric_limits<long>::max() / 4;
  const auto values = static_cast<std::size_t>(limit) + 1;
  std::vector<std::vector<std::size_t>> choice;
  std::vector<long> best(values, 0);
  for (std::size_t i = 0; i < start.size(); ++i) {
    std::vector<long> next(values, kFar);
    auto& chosen = choice.emplace_back(values, 0);
    long least = i == 0 ? 0 : kFar;
    std::size_t least_at = 0;
    for (std::size_t v = 0; v < values; ++v) {
      if (i > 0 && v > 0 && best[v - 1] < least) least = best[v - 1], least_at = v - 1;
      chosen[v] = least_at;
      if (least < kFar) next[v] = least + std::abs(static_cast<long>(v) - start[i]);
    }
    best = std::move(next);
  }
  std::vector<int> target(start.size());
  auto at = static_cast<std::size_t>(std::min_element(best.begin(), best.end()) - best.begin());
  for (std::size_t i = start.size(); i-- > 0; at = choice[i][at]) target[i] = static_cast<int>(at);
  return target;
}

Draft draft(int size, Random& random) {
  const int counters = 2 + 2 * size, limit = 4 * counters;
  ProblemText problem(fmt::format("counters-{}", size), "counters");
  problem.objects("counter", numbered("c", counters));
  problem.init("(= (limit) {})", limit);
  std::vector<int> start;
  for (int c = 1; c <= counters; ++c) {
    start.push_back(random.between(0, limit));
    problem.init("(= (value c{}) {})", c, start.back());
    if (c > 1) problem.goal("(<= (+ (value c{}) 1) (value c{}))", c - 1, c);
  }
  const std::vector<int> target = nearest_ascending(start, limit);
  std::vector<std::string> plan;
  for (std::size_t c = 0; c < start.size(); ++c) {
    for (int v = start[c]; v < target[c]; ++v) plan.push_back(fmt::format("up c{}", c + 1));
    for (int v = start[c]; v > target[c]; --v) plan.push_back(fmt::format("down c{}", c + 1));
  }
  const auto least = static_cast<double>(plan.size());
  return {problem.text(), std::move(plan), least};
}

}  // namespace

Generator counters() {
  return {"counters", "numbers into ascending order", kDomain, {1, 2, 4, 7, 11}, 5000, false, draft};
}

}  // namespace stepwright::bench
