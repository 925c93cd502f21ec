// A hand rebuilds towers of blocks.

#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr const char* kDomain = R"(; One hand, a table without limits, blocks in towers.
(define (domain blocks)
  (:requirements :typing)
  (:types block)
  (:predicates
    (on ?x ?y - block)
    (on-table ?x - block)
    (clear ?x - block)
    (holding ?x - block)
    (hand-free))
  (:action pick-up
    :parameters (?x - block)
    :precondition (and (hand-free) (clear ?x) (on-table ?x))
    :effect (and (holding ?x) (not (hand-free)) (not (clear ?x)) (not (on-table ?x))))
  (:action put-down
    :parameters (?x - block)
    :precondition (holding ?x)
    :effect (and (not (holding ?x)) (hand-free) (clear ?x) (on-table ?x)))
  (:action unstack
    :parameters (?x ?y - block)
    :precondition (and (hand-free) (clear ?x) (on ?x ?y))
    :effect (and (holding ?x) (clear ?y) (not (hand-free)) (not (clear ?x)) (not (on ?x ?y))))
  (:action stack
    :parameters (?x ?y - block)
    :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (hand-free) (clear ?x) (on ?x ?y))))
)";

using Towers = std::vector<std::vector<int>>;  // lowest block first

Towers random_towers(int blocks, Random& random) {
  std::vector<int> order;
  for (int b = 1; b <= blocks; ++b) order.push_back(b);
  random.shuffle(order);
  Towers towers;
  for (const int b : order) {
    const auto choice = static_cast<std::size_t>(random.below(static_cast<int>(towers.size()) + 1));
    if (choice == towers.size() || random.below(4) == 0) {
      towers.push_back({b});
    } else {
      towers[choice].push_back(b);
    }
  }
  return towers;
}

// The block below each one, 0 for the table.
std::vector<int> supports(const Towers& towers, int blocks) {
  std::vector<int> below(static_cast<std::size_t>(blocks) + 1, 0);
  for (const auto& tower : towers) {
    for (std::size_t i = 1; i < tower.size(); ++i) below[static_cast<std::size_t>(tower[i])] = tower[i - 1];
  }
  return below;
}

// Blocks that must move: they, or something below them, do not stand where they shall.
int misplaced(const Towers& from, const std::vector<int>& wanted) {
  int count = 0;
  for (const auto& tower : from) {
    bool moves = false;
    for (std::size_t i = 0; i < tower.size(); ++i) {
      const int below = i == 0 ? 0 : tower[i - 1];
      moves = moves || below != wanted[static_cast<std::size_t>(tower[i])];
      count += moves ? 1 : 0;
    }
  }
  return count;
}

// Everything on the table, then the towers from below.
std::vector<std::string> reference(const Towers& from, const Towers& to) {
  std::vector<std::string> plan;
  for (const auto& tower : from) {
    for (std::size_t i = tower.size(); i-- > 1;) {
      plan.push_back(fmt::format("unstack b{} b{}", tower[i], tower[i - 1]));
      plan.push_back(fmt::format("put-down b{}", tower[i]));
    }
  }
  for (const auto& tower : to) {
    for (std::size_t i = 1; i < tower.size(); ++i) {
      plan.push_back(fmt::format("pick-up b{}", tower[i]));
      plan.push_back(fmt::format("stack b{} b{}", tower[i], tower[i - 1]));
    }
  }
  return plan;
}

Draft draft(int size, Random& random) {
  const int blocks = 2 + 2 * size;
  const Towers from = random_towers(blocks, random), to = random_towers(blocks, random);
  ProblemText problem(fmt::format("blocks-{}", size), "blocks");
  problem.objects("block", numbered("b", blocks));
  problem.init("(hand-free)");
  for (const auto& tower : from) {
    problem.init("(on-table b{}) (clear b{})", tower.front(), tower.back());
    for (std::size_t i = 1; i < tower.size(); ++i) problem.init("(on b{} b{})", tower[i], tower[i - 1]);
  }
  for (const auto& tower : to) {
    problem.goal("(on-table b{})", tower.front());
    for (std::size_t i = 1; i < tower.size(); ++i) problem.goal("(on b{} b{})", tower[i], tower[i - 1]);
  }
  // A block that moves is taken and put at least once.
  return {problem.text(), reference(from, to), 2.0 * misplaced(from, supports(to, blocks))};
}

}  // namespace

Generator blocks() {
  return {"blocks", "towers of blocks, one hand", kDomain, {2, 4, 8, 12, 18}, 200, true, draft};
}

}  // namespace stepwright::bench
