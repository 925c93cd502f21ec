#include "supervisor/pddl/search/landmarks/landmarks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/lifted_state.h"
#include "supervisor/pddl/planner/solve.h"
#include "supervisor/pddl/search/landmarks/landmark_count.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/random_walk.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

std::vector<int> operators_of(const GroundTask& ground, const model::Plan& plan) {
  std::vector<int> operators;
  for (const model::GroundAction& action : plan.actions) {
    for (std::size_t i = 0; i < ground.operators.size(); ++i) {
      if (action_of(ground, ground.operators[i]) == action) operators.push_back(static_cast<int>(i));
    }
  }
  return operators;
}

// Along a plan every landmark is reached, and at its end nothing is left to count.
void expect_on_every_plan(const Task& task) {
  Options options;
  options.first_only = true;
  const model::Outcome outcome = solve(task, options);
  if (!outcome.plan) return;
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  EXPECT_GE(landmarks.size(), relaxed.goal().size() > 0 && ground.goal.choices.empty() ? 1u : 0u);
  const LandmarkCount count(relaxed, landmarks, std::vector<int>(ground.operators.size(), 1));
  std::vector<Word> state = space.initial(), next(space.words()), reached(count.words() + 1, 0);
  count.progress(state.data(), reached.data());
  for (const int op : operators_of(ground, *outcome.plan)) {
    double cost = 0.0;
    ASSERT_TRUE(space.apply(op, state.data(), next.data(), cost));
    state = next;
    count.progress(state.data(), reached.data());
  }
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    EXPECT_TRUE(bit(reached.data(), static_cast<int>(l))) << l;
  }
  EXPECT_EQ(count.estimate(state.data(), reached.data()), 0);
}

TEST(Landmarks, WhenTheirOrdersHaveNoRoom_ThenThereAreNone) {
  const Task task = testing::logistics_task(6);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const auto never = [] { return false; };
  EXPECT_GT(Landmarks(relaxed, never).size(), 0u);
  EXPECT_EQ(Landmarks(relaxed, never, [](std::size_t) { return false; }).size(), 0u);
}

TEST(Landmarks, WhenAPlanIsExecuted_ThenItReachesThemAll) {
  expect_on_every_plan(testing::bench_task());
  expect_on_every_plan(testing::logistics_task(6));
  expect_on_every_plan(testing::lamps_task("(and (forall (?l - lamp) (on ?l)) (powered))"));
  for (std::uint32_t seed = 200; seed < 260; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    expect_on_every_plan(random.task);
  }
}

TEST(Landmarks, WhenATruckMustPassAPlace_ThenThePlaceIsOne) {
  const Task task = testing::logistics_task(4);
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  bool on_the_way = false, carried = false;
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    const int literal = relaxed.literal_of(static_cast<std::size_t>(landmarks.atom(l)));
    const std::string name =
        fact_name(task.definition(), ground.facts[static_cast<std::size_t>(literal / 2)]);
    on_the_way = on_the_way || name == "(at t p3)";
    carried = carried || name == "(in k1 t)";
  }
  EXPECT_TRUE(on_the_way);
  EXPECT_TRUE(carried);
}

constexpr const char* kBlocks = R"((define (domain blocks) (:requirements :strips)
  (:predicates (on ?x ?y) (table ?x) (clear ?x) (free) (held ?x))
  (:action pick :parameters (?x) :precondition (and (clear ?x) (table ?x) (free))
    :effect (and (not (table ?x)) (not (clear ?x)) (not (free)) (held ?x)))
  (:action put :parameters (?x) :precondition (held ?x)
    :effect (and (not (held ?x)) (clear ?x) (free) (table ?x)))
  (:action stack :parameters (?x ?y) :precondition (and (held ?x) (clear ?y))
    :effect (and (not (held ?x)) (not (clear ?y)) (clear ?x) (free) (on ?x ?y)))
  (:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (free))
    :effect (and (held ?x) (clear ?y) (not (clear ?x)) (not (free)) (not (on ?x ?y))))))";

// A tower of so many blocks that is to stand upside down.
Task tower_task(int blocks) {
  std::string objects, init = "(free) (table b1)", goal;
  for (int i = 1; i <= blocks; ++i) {
    const std::string block = "b" + std::to_string(i), next = "b" + std::to_string(i + 1);
    objects += " " + block;
    init += i == blocks ? " (clear " + block + ")" : " (on " + next + " " + block + ")";
    if (i < blocks) goal += " (on " + block + " " + next + ")";
  }
  return testing::make_task(kBlocks, "(define (problem tower) (:domain blocks) (:objects" + objects +
                                         ") (:init " + init + ") (:goal (and" + goal + ")))");
}

Task blocks_task() {
  return testing::make_task(kBlocks, R"((define (problem tower) (:domain blocks) (:objects a b c)
    (:init (table a) (table b) (table c) (clear a) (clear b) (clear c) (free))
    (:goal (and (on a b) (on b c)))))");
}

GroundTask arranged(const Task& task) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  return ground;
}

// A task with its landmarks, spoken of by names.
struct Marked {
  explicit Marked(const Task& task)
      : ground(arranged(task)), space(ground), relaxed(space), landmarks(relaxed, [] { return false; }) {}

  int landmark(const std::string& name) const {
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      const int literal = relaxed.literal_of(static_cast<std::size_t>(landmarks.atom(l)));
      const Atom& fact = ground.facts[static_cast<std::size_t>(literal / 2)];
      if (literal % 2 == 0 && fact_name(*ground.definition, fact) == name) return static_cast<int>(l);
    }
    return -1;
  }
  int op(const std::string& name) const {
    const auto found = std::find_if(ground.operators.begin(), ground.operators.end(), [&](const auto& o) {
      return model::to_string(action_of(ground, o)) == name;
    });
    return static_cast<int>(found - ground.operators.begin());
  }

  GroundTask ground;
  StateSpace space;
  RelaxedTask relaxed;
  Landmarks landmarks;
};

TEST(Landmarks, WhenABlockBelongsOnAnother_ThenTheLowerOneHadBetterBePlacedFirst) {
  const Task task = blocks_task();
  const Marked marked(task);
  const auto upper = marked.landmark("(on a b)"), lower = marked.landmark("(on b c)");
  ASSERT_GE(upper, 0);
  ASSERT_GE(lower, 0);
  const auto first = [&](int l) {
    const std::span<const int> list = marked.landmarks.better_first(static_cast<std::size_t>(l));
    return std::vector<int>(list.begin(), list.end());
  };
  EXPECT_EQ(first(upper), std::vector<int>{lower});
  EXPECT_EQ(first(lower), std::vector<int>{});
}

TEST(Landmarks, WhenALandmarkIsReachedTooEarly_ThenItIsNoProgress) {
  const Task task = blocks_task();
  const Marked marked(task);
  const LandmarkCount count(marked.relaxed, marked.landmarks,
                            std::vector<int>(marked.ground.operators.size(), 1));
  const auto after = [&](const std::vector<std::string>& names, const std::string& next_name) {
    std::vector<Word> state = marked.space.initial(), next(marked.space.words()), reached(count.words(), 0);
    count.progress(state.data(), reached.data());
    for (const std::string& name : names) {
      double cost = 0.0;
      EXPECT_TRUE(marked.space.apply(marked.op(name), state.data(), next.data(), cost)) << name;
      state = next;
      count.progress(state.data(), reached.data());
    }
    return std::pair(count.estimate(state.data(), reached.data()),
                     count.reaches_another(marked.op(next_name), reached.data()));
  };
  const auto [early, early_preferred] = after({"(pick a)"}, "(stack a b)");
  const auto [right, right_preferred] = after({"(pick b)"}, "(stack b c)");
  EXPECT_FALSE(early_preferred);
  EXPECT_TRUE(right_preferred);
  EXPECT_GT(after({"(pick a)", "(stack a b)"}, "(put a)").first,
            after({"(pick b)", "(stack b c)"}, "(put a)").first);
  EXPECT_EQ(after({"(pick b)", "(stack b c)", "(pick a)", "(stack a b)"}, "(put a)").first, 0);
}

// How many pairs are ordered. Whatever is better first is never reached for the first time while the other
// keeps holding.
std::size_t judge_order(const Task& task, std::uint32_t seed) {
  const Marked marked(task);
  const Landmarks& landmarks = marked.landmarks;
  const auto holds = [&](std::size_t l, const std::vector<Word>& state) {
    return marked.space.literal(state.data(),
                                marked.relaxed.literal_of(static_cast<std::size_t>(landmarks.atom(l))));
  };
  std::vector<bool> reached(landmarks.size(), false);
  std::vector<Word> last = marked.space.initial();
  std::size_t pairs = 0;
  for (std::size_t b = 0; b < landmarks.size(); ++b) pairs += landmarks.better_first(b).size();
  if (pairs == 0) return 0;
  testing::random_walk(marked.space, seed, 3000, [&](const std::vector<Word>& state) {
    if (state == marked.space.initial()) {
      reached.assign(landmarks.size(), false);
      last = state;
    }
    for (std::size_t b = 0; b < landmarks.size(); ++b) {
      for (const int a : landmarks.better_first(b)) {
        const auto first = static_cast<std::size_t>(a);
        if (reached[first] || !holds(first, state)) continue;
        EXPECT_FALSE(holds(b, last) && holds(b, state)) << first << " " << b;
      }
    }
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      if (marked.relaxed.literal_of(static_cast<std::size_t>(landmarks.atom(l))) >= 0 && holds(l, state)) {
        reached[l] = true;
      }
    }
    last = state;
  });
  return pairs;
}

TEST(Landmarks, WhenOneIsBetterFirst_ThenItIsOnlyReachedWhereTheOtherGoes) {
  EXPECT_GT(judge_order(blocks_task(), 1), 0u);
  EXPECT_GT(judge_order(testing::logistics_task(5), 1), 0u);
  EXPECT_GT(judge_order(tower_task(4), 1) + judge_order(tower_task(6), 2), 6u);
  judge_order(testing::bench_task(), 1);
  for (std::uint32_t seed = 200; seed < 280; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    judge_order(random.task, seed);
  }
}

}  // namespace
}  // namespace stepwright::pddl
