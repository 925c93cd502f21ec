#include "supervisor/ltl/search/train_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using testing::Rectangle;

// No test ends by its time: rounds bound a search.
constexpr double kGenerous_s = 600.0;

// A yard of 20 x 20 m with two blocks and three places; a train in its south-west that looks north.
struct Yard {
  explicit Yard(const std::string& text, std::size_t trailers = 1) : model{.trailers = trailers} {
    floor.border = Rectangle{0, 0, 20, 20}.area("border");
    floor.obstacles = {Rectangle{6, 4, 8, 12}.area("west block"),
                       Rectangle{12, 8, 14, 16}.area("east block")};
    floor.propositions = {Rectangle{16, 16, 19, 19}.area("press"), Rectangle{16, 1, 19, 4}.area("rack"),
                          Rectangle{9, 9, 11, 11}.area("wash")};
    map.emplace(make_regions(floor).value());
    places.emplace(floor.propositions);
    task.emplace(read_task(text, {"press", "rack", "wash"}).value());
    start = standing_at(model, {3.0, 6.0, 1.57});
  }
  std::unique_ptr<SearchGround> ground(SearchGuide use = SearchGuide::OnTheRegions) const {
    return std::make_unique<SearchGround>(floor, *map, *places, model, &task->automaton, use);
  }
  TaskStates states() const { return TaskStates(task->automaton); }
  SearchAnswer first(std::uint64_t seed = 1, std::size_t rounds = 2000) const {
    const auto own = ground();
    TrainSearch each(*own, states());
    return each.first({.start = start, .seed = seed, .most_s = kGenerous_s, .most_rounds = rounds});
  }
  std::string refused(const TrainPlan& plan) const {
    return judge_plan(floor, model, start, task->formula, plan).reason;
  }

  Floor floor;
  TrainModel model;
  std::optional<RegionMap> map;
  std::optional<Places> places;
  std::optional<Task> task;
  TrainState start{};
};

TEST(TrainSearch, WhenTasksAreSmall_ThenEachHasAPlanThatThePlanCheckerAccepts) {
  for (const char* text : {"visit press", "visit press then visit rack", "!wash U press",
                           "visit wash then visit press", "visit rack, visit press, !press U wash"}) {
    for (const std::size_t trailers : {0, 1, 3}) {
      const Yard yard(text, trailers);
      const SearchAnswer answer = yard.first();
      ASSERT_EQ(answer.end, SearchEnd::Found) << text << ", " << trailers << " trailers";
      EXPECT_EQ(yard.refused(*answer.plan), "") << text << ", " << trailers << " trailers";
      EXPECT_EQ(answer.plan->start, yard.start);
    }
  }
}

TEST(TrainSearch, WhenThereIsNoGuide_ThenPlansAreFoundAllTheSame) {
  const Yard yard("visit press then visit rack");
  const auto ground = yard.ground(SearchGuide::None);
  TrainSearch search(*ground, yard.states());
  const SearchAnswer answer = search.first({.start = yard.start, .most_s = kGenerous_s, .most_rounds = 2000});
  ASSERT_EQ(answer.end, SearchEnd::Found);
  EXPECT_EQ(yard.refused(*answer.plan), "");
}

TEST(TrainSearch, WhenStatesAreThoseOfAProgression_ThenPlansAreFoundAllTheSame) {
  const Yard yard("visit press then visit rack");
  const SearchGround ground(yard.floor, *yard.map, *yard.places, yard.model, nullptr);
  TrainSearch search(ground, TaskStates(yard.task->formula));
  const SearchAnswer answer = search.first({.start = yard.start, .most_s = kGenerous_s, .most_rounds = 2000});
  ASSERT_EQ(answer.end, SearchEnd::Found);
  EXPECT_EQ(yard.refused(*answer.plan), "");
}

TEST(TrainSearch, WhenAPlanIsOfNoUse_ThenASearchByChanceFindsOthers) {
  const Yard yard("visit press", 3);
  const auto ground = yard.ground();
  TrainSearch search(*ground, yard.states());
  std::vector<double> lengths;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const SearchAnswer answer = search.first(
        {.start = yard.start, .seed = seed, .most_s = kGenerous_s, .most_rounds = 2000, .by_chance = true});
    ASSERT_TRUE(answer.plan);
    EXPECT_EQ(yard.refused(*answer.plan), "");
    lengths.push_back(answer.plan->length_m);
  }
  std::ranges::sort(lengths);
  EXPECT_GT(std::ranges::unique(lengths).begin() - lengths.begin(), 2);
}

TEST(TrainSearch, WhenTheSeedIsTheSame_ThenTheAnswerIs) {
  const Yard yard("visit wash then visit press", 3);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SearchAnswer one = yard.first(seed), other = yard.first(seed);
    ASSERT_TRUE(one.plan && other.plan);
    EXPECT_EQ(one.plan->end, other.plan->end);
    EXPECT_EQ(one.nodes, other.nodes);
    EXPECT_EQ(one.steps, other.steps);
  }
}

TEST(TrainSearch, WhenTheStartIsNone_ThenItEndsBeforeItBegins) {
  Yard yard("visit press", 1);
  const auto end_at = [&](const TrainState& start) {
    yard.start = start;
    return yard.first().end;
  };
  EXPECT_EQ(end_at(standing_at(yard.model, {6.1, 6.0, 0.0})), SearchEnd::BadStart);
  EXPECT_EQ(end_at(standing_at(yard.model, {-5.0, 6.0, 0.0})), SearchEnd::BadStart);
  EXPECT_EQ(end_at(standing_at(yard.model, {NAN, 6.0, 0.0})), SearchEnd::BadStart);
  TrainState fast = standing_at(yard.model, {3.0, 6.0, 1.57});
  fast[kTrainSpeed] = 5.0;
  EXPECT_EQ(end_at(fast), SearchEnd::BadStart);
  // Within a block as a whole, which has no side near to the train.
  Floor& floor = yard.floor;
  floor.obstacles = {Rectangle{1, 1, 8, 12}.area("block")};
  yard.map.emplace(make_regions(floor).value());
  EXPECT_EQ(end_at(standing_at(yard.model, {5.0, 6.0, 0.0})), SearchEnd::BadStart);
}

TEST(TrainSearch, WhenTheTaskIsOverAtTheStart_ThenItEndsBeforeItBegins) {
  Yard done("visit rack");
  done.start = standing_at(done.model, {17.5, 2.5, 0.0});
  const SearchAnswer answer = done.first();
  ASSERT_EQ(answer.end, SearchEnd::Found);
  EXPECT_TRUE(answer.plan->pieces.empty());
  EXPECT_EQ(done.refused(*answer.plan), "");
  Yard failed("!rack U press");
  failed.start = done.start;
  EXPECT_EQ(failed.first().end, SearchEnd::BadStart);
}

TEST(TrainSearch, WhenNoPointCanDoIt_ThenItEndsBeforeItBegins) {
  Yard yard("visit press");
  yard.floor.obstacles.push_back(Rectangle{0, 14, 20, 15}.area("wall"));
  yard.map.emplace(make_regions(yard.floor).value());
  EXPECT_EQ(yard.first().end, SearchEnd::NoWay);
}

TEST(TrainSearch, WhenItHasNoRoundsNoTimeOrIsCancelled_ThenItEnds) {
  const Yard yard("visit press");
  EXPECT_EQ(yard.first(1, 0).end, SearchEnd::Bound);
  const auto ground = yard.ground();
  TrainSearch search(*ground, yard.states());
  EXPECT_EQ(search.first({.start = yard.start, .most_s = 0.0}).end, SearchEnd::Bound);
  const std::atomic<bool> cancel{true};
  const SearchQuery query{.start = yard.start, .most_s = kGenerous_s, .cancel = &cancel};
  EXPECT_EQ(search.first(query).end, SearchEnd::Cancelled);
  const std::atomic<bool> enough{true};
  EXPECT_EQ(search.first({.start = yard.start, .most_s = kGenerous_s, .enough = &enough}).end,
            SearchEnd::Bound);
}

TEST(TrainSearch, WhenNoTrainCanDoIt_ThenItEndsWithItsRounds) {
  // A gap of 40 cm: a point gets through.
  Yard yard("visit press");
  yard.floor.obstacles = {{"w", {{0, 14}, {9, 14}, {9, 15}, {0, 15}}, {}},
                          {"e", {{9.4, 14}, {20, 14}, {20, 15}, {9.4, 15}}, {}}};
  yard.map.emplace(make_regions(yard.floor).value());
  const SearchAnswer answer = yard.first(1, 50);
  EXPECT_EQ(answer.end, SearchEnd::Bound);
  EXPECT_FALSE(answer.plan);
}

TEST(TrainSearch, WhenItIsAskedInParts_ThenTheAnswerIsTheSame) {
  const Yard yard("visit wash then visit press", 3);
  const auto ground = yard.ground();
  TrainSearch search(*ground, yard.states());
  for (const std::uint64_t seed : {2, 1}) {
    const SearchQuery query{.start = yard.start, .seed = seed, .most_s = kGenerous_s, .by_chance = true};
    const SearchAnswer whole = search.first(query);
    search.ask(query);
    while (!search.go_on(1)) {
    }
    ASSERT_TRUE(whole.plan && search.answer().plan);
    EXPECT_EQ(whole.plan->end, search.answer().plan->end);
    EXPECT_EQ(whole.steps, search.answer().steps);
    EXPECT_EQ(whole.nodes, search.answer().nodes);
  }
}

}  // namespace
}  // namespace stepwright::ltl
