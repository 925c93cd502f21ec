#include "supervisor/ltl/search/shortener.h"

#include <gtest/gtest.h>

#include <atomic>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/search/train_search.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using testing::Rectangle;

// A yard of 20 x 20 m with a block in the middle, two places, and a train in its south-west that looks north.
struct BlockYard {
  explicit BlockYard(std::size_t trailers) : model{.trailers = trailers} {
    floor.border = Rectangle{0, 0, 20, 20}.area("border");
    floor.obstacles = {Rectangle{7, 5, 13, 13}.area("block")};
    floor.propositions = {Rectangle{16, 14, 19, 19}.area("press"), Rectangle{15, 1, 19, 4}.area("rack")};
    map.emplace(make_regions(floor).value());
    places.emplace(floor.propositions);
    task.emplace(read_task("visit press then visit rack", {"press", "rack"}).value());
    start = standing_at(model, {3.0, 8.0, 1.57});
    ground = std::make_unique<SearchGround>(floor, *map, *places, model, &task->automaton);
  }
  std::string refused(const DrivenRoute& driven) const {
    return judge_plan(floor, model, start, task->formula, driven.plan()).reason;
  }

  Floor floor;
  TrainModel model;
  std::optional<RegionMap> map;
  std::optional<Places> places;
  std::optional<Task> task;
  TrainState start{};
  std::unique_ptr<SearchGround> ground;
};

TEST(Shortener, WhenItGoesOnFromRoundToRound_ThenPlansGetShorterAndThePlanCheckerAcceptsThem) {
  for (const std::size_t trailers : {0, 2}) {
    const BlockYard yard(trailers);
    Shortener shortener(*yard.ground, TaskStates(yard.task->automaton));
    auto best = shortener.round({.start = yard.start, .seed = 1, .plain = true});
    ASSERT_TRUE(best);
    EXPECT_FALSE(shortener.was_cut());
    EXPECT_EQ(yard.refused(*best), "");
    const double first_m = best->length_m();
    int shorter = 0;
    for (std::uint64_t seed = 2; seed < 8; ++seed) {
      const auto next = shortener.round({.start = yard.start, .seed = seed, .best = &*best});
      if (!next) continue;
      ++shorter;
      EXPECT_LT(next->length_m(), best->length_m());
      EXPECT_EQ(yard.refused(*next), "") << trailers << " trailers, seed " << seed;
      EXPECT_EQ(next->plan().start, yard.start);
      EXPECT_EQ(next->drive.marks.back().pieces, next->drive.pieces.size());
      best = next;
    }
    EXPECT_GE(shorter, 2);
    EXPECT_LT(best->length_m(), first_m);
    // Around the block by the shorter side, at least: from the start to the press and from there to the rack.
    EXPECT_GT(best->length_m(), 20.0);
  }
}

// Of a tree that had to leave routes and to turn back, too.
TEST(Shortener, WhenItBeginsWithASearchsPlan_ThenItGoesOnFromThatOne) {
  BlockYard yard(2);
  yard.start = standing_at(yard.model, {4.2, 9.0, 0.0});  // the block is 2 m ahead
  TrainSearch search(*yard.ground, TaskStates(yard.task->automaton));
  Shortener shortener(*yard.ground, TaskStates(yard.task->automaton));
  int tried = 0, shorter = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const SearchAnswer found = search.first(
        {.start = yard.start, .seed = seed, .most_s = 600.0, .most_rounds = 300, .by_chance = true});
    if (!found.plan) continue;
    ASSERT_TRUE(found.driven);
    const DrivenRoute& first = *found.driven;
    const TrainPlan plan = first.plan();
    EXPECT_EQ(plan.pieces.size(), found.plan->pieces.size());
    EXPECT_EQ(plan.end, found.plan->end);
    EXPECT_NEAR(plan.length_m, found.plan->length_m, 1e-9);
    for (const DriveMark& mark : first.drive.marks) EXPECT_LE(mark.next, first.route.size());
    ++tried;
    for (const bool other : {true, false}) {
      const auto next =
          shortener.round({.start = yard.start, .seed = seed, .best = &first, .other_routes = other});
      if (!next) continue;
      ++shorter;
      EXPECT_LT(next->length_m(), first.length_m());
      EXPECT_EQ(yard.refused(*next), "") << seed;
    }
  }
  EXPECT_GE(tried, 3);
  EXPECT_GE(shorter, 3);
}

// Whatever it was asked before, and whichever of several Shorteners is asked.
TEST(Shortener, WhenTheSeedIsTheSame_ThenTheRoundIs) {
  const BlockYard yard(1);
  Shortener one(*yard.ground, TaskStates(yard.task->automaton));
  Shortener other(*yard.ground, TaskStates(yard.task->automaton));
  (void)other.round({.start = yard.start, .seed = 77, .clearance = Clearance::Least});
  const auto a = one.round({.start = yard.start, .seed = 3}),
             b = other.round({.start = yard.start, .seed = 3});
  ASSERT_EQ(a.has_value(), b.has_value());
  const auto base = one.round({.start = yard.start, .seed = 1, .plain = true});
  ASSERT_TRUE(base);
  const auto c = other.round({.start = yard.start, .seed = 5, .best = &*base});
  const auto d = one.round({.start = yard.start, .seed = 5, .best = &*base});
  ASSERT_TRUE(c && d);
  EXPECT_EQ(c->plan().end, d->plan().end);
  EXPECT_EQ(c->drive.pieces.size(), d->drive.pieces.size());
  EXPECT_EQ(c->length_m(), d->length_m());
  EXPECT_EQ(a ? a->length_m() : 0.0, b ? b->length_m() : 0.0);
}

TEST(Shortener, WhenItIsStopped_ThenItSaysSo) {
  const BlockYard yard(1);
  Shortener shortener(*yard.ground, TaskStates(yard.task->automaton));
  const std::atomic<bool> cancel{true};
  EXPECT_FALSE(shortener.round({.start = yard.start, .stop = {.cancel = &cancel}}));
  EXPECT_TRUE(shortener.was_cut());
  // What was not made then can be made now.
  EXPECT_TRUE(shortener.round({.start = yard.start, .plain = true}));
  EXPECT_FALSE(shortener.was_cut());
}

}  // namespace
}  // namespace stepwright::ltl
