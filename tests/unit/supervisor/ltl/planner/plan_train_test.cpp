#include "supervisor/ltl/planner/plan_train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/scene/scene_reader.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using testing::Rectangle;

// No test ends by its time: rounds bound a search.
constexpr double kGenerous_s = 600.0;

// A hall of 30 x 30 m: a wall with a door of 4 m between the racks in the west and the press in the east; a
// vault without a door; a wash bay in the way to the press.
Problem hall(std::size_t trailers, const std::string& task) {
  Problem problem;
  Floor& floor = problem.floor;
  floor.border = Rectangle{0, 0, 30, 30}.area("border");
  floor.obstacles = {Rectangle{14, 0, 16, 12}.area("south wall"),
                     Rectangle{14, 16, 16, 30}.area("north wall"), Rectangle{24, 24, 25, 30}.area("vault w"),
                     Rectangle{25, 24, 30, 25}.area("vault s")};
  floor.propositions = {Rectangle{23, 13, 26, 16}.area("press"), Rectangle{2, 20, 5, 23}.area("rack"),
                        Rectangle{18, 12, 20, 15}.area("wash"), Rectangle{27, 27, 28, 28}.area("vault"),
                        Rectangle{14, 12, 16, 16}.area("door")};
  problem.train.trailers = trailers;
  problem.start = {8.0, 6.0, 1.57};
  problem.task = task;
  return problem;
}

std::string code_of(const result::Result<PlanAnswer>& answer) {
  return answer ? "" : answer.error().front().code;
}

void expect_solved(const Problem& problem, std::uint64_t seed) {
  const auto answer = plan_train(problem, {.seed = seed, .most_s = kGenerous_s, .most_rounds = 3000});
  ASSERT_TRUE(answer) << problem.task << ", " << problem.train.trailers << " trailers, seed " << seed << ": "
                      << to_string(answer.error());
  EXPECT_TRUE(answer->judgement.accepted());
  EXPECT_NEAR(answer->judgement.length_m, answer->plan.length_m, 0.01 * answer->plan.length_m + 0.01);
  EXPECT_NEAR(answer->judgement.duration_s, answer->plan.duration_s(), 1e-6);
}

TEST(PlanTrain, WhenATaskIsPossible_ThenAPlanIsFoundThatThePlanCheckerAccepts) {
  for (const std::size_t trailers : {0, 2, 5}) {
    for (const char* task : {"visit press", "visit rack then visit press", "visit press then visit rack",
                             "!wash U press", "visit rack, !wash U press"})
      expect_solved(hall(trailers, task), 1);
  }
}

TEST(PlanTrain, WhenPlacesHaveAnOrder_ThenTheWordHasIt) {
  const auto answer = plan_train(hall(3, "visit rack then visit press"), {.most_s = kGenerous_s});
  ASSERT_TRUE(answer);
  const auto& word = answer->judgement.word;
  const auto rack = std::ranges::find(word, Label{2}), press = std::ranges::find(word, Label{1});
  EXPECT_LT(rack - word.begin(), press - word.begin());
  EXPECT_EQ(word.back(), Label{1});
}

// A run that goes on: the rack was visited before.
TEST(PlanTrain, WhenLettersWereReadBefore_ThenThePlanGoesOnBehindThem) {
  Problem problem = hall(3, "visit rack then visit press");
  const auto whole = plan_train(problem, {.most_s = kGenerous_s});
  problem.read = {0, 2, 0};
  const auto rest = plan_train(problem, {.most_s = kGenerous_s});
  ASSERT_TRUE(whole && rest);
  EXPECT_LT(rest->plan.length_m, whole->plan.length_m);
  EXPECT_EQ(std::ranges::count(rest->judgement.word, Label{2}), 0);
  problem.read = {0, 4};
  problem.task = "visit press, !wash U press";
  const auto broken = plan_train(problem);
  ASSERT_EQ(code_of(broken), kImpossible);
  EXPECT_EQ(broken.error()[0].message, "'!wash U press' cannot be done: it fails where the way begins");
}

TEST(PlanTrain, WhenTrailersAreBent_ThenThePlanBeginsThere) {
  Problem problem = hall(2, "visit press");
  problem.trailers_rad = {1.2, 0.9};
  const auto answer = plan_train(problem, {.most_s = kGenerous_s});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->plan.start[kTrainTrailer], 1.2);
  EXPECT_EQ(answer->plan.start[kTrainTrailer + 1], 0.9);
}

TEST(PlanTrain, WhenSomethingStandsAcrossAPlace_ThenTheTrainGoesRoundIt) {
  Problem problem = hall(2, "visit press");
  problem.floor.blocked = {Rectangle{22, 10, 24, 14}.area("crate")};
  const auto answer = plan_train(problem, {.most_s = kGenerous_s});
  ASSERT_TRUE(answer) << to_string(answer.error());
  EXPECT_EQ(answer->judgement.word.back(), Label{1});
  problem.floor.blocked = {Rectangle{22, 12, 27, 17}.area("tarpaulin")};
  EXPECT_FALSE(plan_train(problem, {.most_s = kGenerous_s, .most_rounds = 50}));
}

TEST(PlanTrain, WhenNoPointCanDoIt_ThenThePartAndThePlaceAreNamed) {
  const auto walled = plan_train(hall(1, "visit press, visit vault"));
  ASSERT_EQ(code_of(walled), kImpossible);
  EXPECT_EQ(walled.error()[0].message, "'F vault' cannot be done: no way leads to 'vault'");
  EXPECT_EQ(walled.error()[0].where.column, 14u);
  const auto shut = plan_train(hall(0, "!door U press"));
  ASSERT_EQ(code_of(shut), kImpossible);
  EXPECT_EQ(shut.error()[0].message,
            "'!door U press' cannot be done: every way leads through 'door' to 'press'");
  const auto both = plan_train(hall(0, "!press U rack, !rack U press"));
  ASSERT_EQ(code_of(both), kImpossible);
  EXPECT_EQ(both.error().size(), 2u);
}

TEST(PlanTrain, WhenTheTrainDoesNotFit_ThenThatIsSaid) {
  Problem problem = hall(4, "visit press");
  problem.start = {8.0, 3.0, 1.57};  // the last trailer is outside
  EXPECT_EQ(code_of(plan_train(problem)), kStartDoesNotFit);
  problem.start = {15.0, 6.0, 0.0};  // within a wall
  problem.train.trailers = 0;
  EXPECT_EQ(code_of(plan_train(problem)), kStartDoesNotFit);
  problem.train.width_m = -1.0;
  EXPECT_EQ(code_of(plan_train(problem)), "L0301");
}

TEST(PlanTrain, WhenTheTaskIsWrong_ThenItsErrorsAreThoseOfTheFormula) {
  EXPECT_EQ(code_of(plan_train(hall(0, "visit pres"))), "L0311");
  EXPECT_EQ(code_of(plan_train(hall(0, "visit press, never wash"))), "L0011");
  EXPECT_EQ(code_of(plan_train(hall(0, "visit ("))), "L0002");
}

TEST(PlanTrain, WhenTheTaskIsDoneAtTheStart_ThenThePlanIsEmpty) {
  Problem problem = hall(1, "visit rack");
  problem.start = {3.5, 21.0, 0.0};
  const auto answer = plan_train(problem);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->plan.pieces.empty());
  EXPECT_EQ(answer->judgement.word, std::vector<Label>{2});
}

TEST(PlanTrain, WhenItIsCancelledOrHasNoTime_ThenItEndsAtOnce) {
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(code_of(plan_train(hall(2, "visit press"), {.cancel = &cancel})), kPlanCancelled);
  EXPECT_EQ(code_of(plan_train(hall(2, "visit press"), {.most_s = 0.0})), kNoPlan);
  EXPECT_EQ(code_of(plan_train(hall(2, "visit press"), {.most_rounds = 0})), kNoPlan);
}

TEST(PlanTrain, WhenTheDoorIsTooNarrow_ThenItSaysThatNoPlanWasFound) {
  Problem problem = hall(0, "visit press");
  problem.floor.obstacles[0] = {"south wall", {{14, 0}, {16, 0}, {16, 15.6}, {14, 15.6}}, {}};
  problem.floor.propositions.pop_back();  // the door
  EXPECT_EQ(code_of(plan_train(problem, {.most_s = kGenerous_s, .most_rounds = 20})), kNoPlan);
}

TEST(PlanTrain, WhenTheSeedIsTheSame_ThenThePlanIs) {
  const Problem problem = hall(4, "visit press then visit rack");
  const PlanOptions options{.seed = 5, .most_s = kGenerous_s};
  const auto one = plan_train(problem, options), other = plan_train(problem, options);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->plan.end, other->plan.end);
  EXPECT_EQ(one->plan.pieces.size(), other->plan.pieces.size());
  EXPECT_EQ(one->search.nodes, other->search.nodes);
}

void expect_same(const PlanAnswer& one, const PlanAnswer& other) {
  EXPECT_EQ(one.plan.end, other.plan.end);
  EXPECT_EQ(one.plan.length_m, other.plan.length_m);
  ASSERT_EQ(one.plan.pieces.size(), other.plan.pieces.size());
  for (std::size_t k = 0; k < one.plan.pieces.size(); ++k) {
    EXPECT_EQ(one.plan.pieces[k].control, other.plan.pieces[k].control);
    EXPECT_EQ(one.plan.pieces[k].duration_s, other.plan.pieces[k].duration_s);
  }
  EXPECT_EQ(one.tries, other.tries);
  EXPECT_EQ(one.search.nodes, other.search.nodes);
}

// Easy ones, and a door that is narrow for what is pulled, so that many tries are needed.
TEST(PlanTrain, WhenItWorksOnOneThreadOrOnTwo_ThenThePlanIsTheSame) {
  Problem narrow = hall(5, "visit rack then visit press");
  narrow.floor.obstacles[0] = Rectangle{14, 0, 16, 14}.area("south wall");
  narrow.floor.propositions.pop_back();  // the door
  for (const Problem& problem : {hall(4, "visit press then visit rack"), narrow}) {
    for (const std::uint64_t seed : {1, 2}) {
      PlanOptions options{.seed = seed, .most_s = kGenerous_s, .most_rounds = 400, .threads = 1};
      const auto one = plan_train(problem, options);
      options.threads = 2;
      const auto two = plan_train(problem, options);
      ASSERT_EQ(one.has_value(), two.has_value()) << seed;
      if (!one) continue;
      EXPECT_EQ(one->threads, 1u);
      EXPECT_EQ(two->threads, 2u);
      expect_same(*one, *two);
    }
  }
}

TEST(PlanTrain, WhenItShortensOnOneThreadOrOnTwo_ThenThePlanIsTheSame) {
  const Problem problem = hall(2, "visit press then visit rack");
  PlanOptions options{.most_s = kGenerous_s, .shorten_s = kGenerous_s, .shorten_rounds = 5, .threads = 1};
  const auto one = plan_train(problem, options);
  options.threads = 2;
  const auto two = plan_train(problem, options);
  ASSERT_TRUE(one && two);
  EXPECT_TRUE(one->shortened && two->shortened);
  expect_same(*one, *two);
}

TEST(PlanTrain, WhenTheTimeForShorterOnesIsShort_ThenThereIsAPlanAllTheSame) {
  const Problem problem = hall(1, "visit press");
  const auto answer = plan_train(problem, {.most_s = kGenerous_s, .shorten_s = 1e-3, .threads = 2});
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->judgement.accepted());
}

TEST(PlanTrain, WhenThereIsTimeForIt_ThenAShorterPlanIsJudgedToo) {
  const Problem problem = hall(2, "visit press then visit rack");
  const auto first = plan_train(problem, {.most_s = kGenerous_s});
  const auto shorter =
      plan_train(problem, {.most_s = kGenerous_s, .shorten_s = kGenerous_s, .shorten_rounds = 4});
  ASSERT_TRUE(first && shorter);
  EXPECT_LE(shorter->plan.length_m, first->plan.length_m);
  EXPECT_TRUE(shorter->judgement.accepted());
}

TEST(PlanTrain, WhenTheAutomatonWouldBeTooLarge_ThenItIsPlannedStepByStep) {
  // All sixteen places or the twelfth: more states than an automaton may have, and easily done.
  Problem problem = hall(0, "");
  problem.floor.propositions.clear();
  std::string task;
  for (int k = 0; k < 16; ++k) {
    const int x = 1 + 2 * (k % 4), y = 9 + 4 * (k / 4);
    const std::string name = "p" + std::to_string(k);
    problem.floor.propositions.push_back(Rectangle{x, y, x + 1, y + 1}.area(name));
    if (k != 12) task += (k == 0 ? "F " : " & F ") + name;
  }
  task = "(" + task + ") | F p12";
  problem.task = task;
  EXPECT_EQ(read_task(task, problem.places()).error()[0].code, "L0012");
  expect_solved(problem, 1);
}

TEST(PlanTrain, WhenManyPlacesAreToBeVisited_ThenThePlanVisitsThem) {
  for (const int side : {4, 5}) {
    Problem problem = hall(0, "");
    problem.floor.border = Rectangle{0, 0, 6 * side + 4, 6 * side + 4}.area("border");
    problem.floor.obstacles.clear();
    problem.floor.propositions.clear();
    for (int k = 0; k < side * side; ++k) {
      const int x = 4 + 6 * (k % side), y = 4 + 6 * (k / side);
      problem.floor.propositions.push_back(Rectangle{x, y, x + 2, y + 2}.area("p" + std::to_string(k)));
      problem.task += (k == 0 ? "visit p" : ", visit p") + std::to_string(k);
    }
    problem.start = {2.5, 2.0, 0.0};
    expect_solved(problem, 1);
  }
}

TEST(PlanTrain, WhenTheTimeIsOverOrItIsCancelled_ThenItEndsBeforeTheFloorIsRead) {
  EXPECT_EQ(code_of(plan_train(hall(1, "visit press"), {.most_s = 0.0})), kNoPlan);
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(code_of(plan_train(hall(1, "visit press"), {.most_s = kGenerous_s, .cancel = &cancel})),
            kPlanCancelled);
}

TEST(PlanTrain, WhenATaskIsPlannedByItsAutomaton_ThenTheAnswerSaysHowLargeItIs) {
  const auto answer = plan_train(hall(0, "visit press then visit rack"), {.most_s = kGenerous_s});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->states, 3u);
}

class Published : public ::testing::TestWithParam<const char*> {};

TEST_P(Published, WhenTheSceneIsRead_ThenTheTrainVisitsPlacesOfIt) {
  const std::string file = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/ltl/" + GetParam();
  std::ifstream in(file);
  const auto floor = read_scene(std::string(std::istreambuf_iterator<char>(in), {}), file);
  ASSERT_TRUE(floor) << to_string(floor.error());
  Problem problem{*floor, {.trailers = 5}, {-6.0, -22.0, 0.0}, "visit p1, visit p4"};
  if (std::string(GetParam()) == "walls.geojson") problem.start = {-11.0, 20.0, 3.14};
  expect_solved(problem, 3);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Published, ::testing::Values("blocks.geojson", "walls.geojson"));

}  // namespace
}  // namespace stepwright::ltl
