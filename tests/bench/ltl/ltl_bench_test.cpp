#include <gtest/gtest.h>

#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "tests/bench/ltl/automata_sizes.h"
#include "tests/bench/ltl/ltl_planner.h"
#include "tests/bench/ltl/paper_literal.h"
#include "tests/bench/ltl/plan_check.h"
#include "tests/bench/ltl/train_problem.h"

namespace stepwright::bench {
namespace {

// The baseline has the same answers' judge: both searches solve the same problems, and the seed makes them.
TEST(LtlBench, WhenTheSeedIsTheSame_ThenTheProblemIsAndBothSearchesSolveIt) {
  for (const char* scene : {"blocks.geojson", "walls.geojson"}) {
    const auto floor = published_floor(scene);
    ASSERT_TRUE(floor) << scene;
    const ltl::Problem problem = train_problem(*floor, "visit p1", 2, 3);
    EXPECT_EQ(problem.start, train_problem(*floor, "visit p1", 2, 3).start);
    EXPECT_FALSE(problem.start == train_problem(*floor, "visit p1", 2, 4).start);
    for (const auto guide : {ltl::SearchGuide::OnTheRegions, ltl::SearchGuide::None})
      EXPECT_TRUE(ltl::plan_train(problem, {.most_s = 600.0, .most_rounds = 3000, .guide = guide})) << scene;
  }
}

// A place behind a wall.
ltl::Problem small_problem() {
  ltl::Problem problem;
  problem.floor.border = {"border", {{0, 0}, {12, 0}, {12, 12}, {0, 12}}, {}};
  problem.floor.obstacles = {{"wall", {{5, 0}, {6, 0}, {6, 6}, {5, 6}}, {}}};
  problem.floor.propositions = {{"press", {{7, 6}, {11, 6}, {11, 11}, {7, 11}}, {}}};
  problem.start = {3.0, 6.0, 0.0};
  problem.task = "visit press";
  return problem;
}

// And so has the planner of others.
TEST(LtlBench, WhenLtlPlannerHasTime_ThenThePlanCheckerAcceptsItsPlan) {
  seed_ompl(1);
  const ltl::Problem problem = small_problem();
  const OmplAnswer answer = plan_by_ltlplanner(problem, 0.05, 600.0);
  ASSERT_TRUE(answer.plan);
  EXPECT_TRUE(answer.judgement.accepted()) << answer.judgement.reason;
  EXPECT_EQ(answer.judgement.word.back(), ltl::Label{1});
}

// And the paper's algorithm as it is printed; the same seed has the same tree.
TEST(LtlBench, WhenThePapersAlgorithmHasTime_ThenThePlanCheckerAcceptsItsPlan) {
  const ltl::Problem problem = small_problem();
  for (const double shortest : {0.0, 0.9}) {
    const PaperOptions options{.iterations = 50, .shortest = shortest, .most_s = 600.0};
    const PaperAnswer answer = plan_by_paper(problem, options), again = plan_by_paper(problem, options);
    ASSERT_TRUE(answer.plan) << shortest;
    EXPECT_TRUE(answer.judgement.accepted());
    EXPECT_EQ(answer.judgement.word.back(), ltl::Label{1});
    EXPECT_EQ(answer.vertices, again.vertices);
    EXPECT_EQ(answer.plan->end, again.plan->end);
  }
  ltl::Problem none = problem;
  none.task = "!press U (press & X !press)";
  EXPECT_TRUE(plan_by_paper(none, {.most_s = 600.0}).plan) << "delta(z) - Gamma is empty now and then";
}

TEST(LtlBench, WhenAPlanIsTamperedWith_ThenItsCheckTells) {
  ltl::Problem problem = small_problem();
  problem.train.trailers = 2;
  const auto answer = ltl::plan_train(problem, {.most_s = 600.0});
  ASSERT_TRUE(answer);
  const auto formula = ltl::parse_formula(problem.task, "task", problem.places());
  const PlanCheck sound = check_plan(problem, *formula, answer->plan);
  EXPECT_TRUE(sound.word_holds && sound.clear);
  EXPECT_EQ(sound.word, answer->judgement.word);
  EXPECT_NEAR(sound.length_m, answer->judgement.length_m, 0.01);
  ltl::TrainPlan half = answer->plan;
  half.pieces.resize(half.pieces.size() / 2);
  EXPECT_FALSE(check_plan(problem, *formula, half).word_holds);
  ltl::TrainPlan ahead = answer->plan;
  ahead.pieces = {{{1.0, 0.0}, 2.0}};
  EXPECT_FALSE(check_plan(problem, *formula, ahead).clear) << "into the wall";
}

TEST(LtlBench, WhenFormulasAreKnown_ThenTheyHoldOnWordsAsThePlanCheckerSays) {
  const auto formula = ltl::parse_formula("!a U (b & X (a | F b))", "", {"a", "b"});
  ASSERT_TRUE(formula);
  int held = 0;
  for (std::uint32_t code = 0; code < 1024; ++code) {
    std::vector<ltl::Label> word;
    for (std::uint32_t k = 0; k < 5; ++k) word.push_back(code >> (2 * k) & 3);
    EXPECT_EQ(holds_on(*formula, word), ltl::satisfies(*formula, word)) << code;
    held += holds_on(*formula, word) ? 1 : 0;
  }
  EXPECT_GT(held, 100);
}

}  // namespace
}  // namespace stepwright::bench
