#include "supervisor/fleet/network/network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tests/unit/supervisor/fleet/network/all_pairs.h"

namespace stepwright::fleet {
namespace {

Constraint random_constraint(std::size_t timepoints, std::uint32_t label, std::mt19937& random) {
  std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(timepoints - 1));
  std::uniform_int_distribution<std::int32_t> shift(-60, 40);
  std::uniform_int_distribution<int> rare(0, 49);
  std::int32_t least = shift(random);
  if (rare(random) == 0) least = kHorizon_ms / 2;
  return {Timepoint(any(random)), Timepoint(any(random)), least, label};
}

std::vector<Constraint> labelled(std::span<const Constraint> all, std::span<const std::uint32_t> labels) {
  const std::set<std::uint32_t> wanted(labels.begin(), labels.end());
  std::vector<Constraint> chosen;
  std::ranges::copy_if(all, std::back_inserter(chosen),
                       [&](const Constraint& c) { return wanted.contains(c.label); });
  return chosen;
}

void expect_times(const Network& network, const AllPairs& oracle) {
  for (std::uint32_t t = 0; t < network.timepoints(); ++t) {
    ASSERT_EQ(network.earliest_ms(Timepoint(t)), oracle.earliest_ms(t)) << t;
    if (network.tracks_latest()) {
      ASSERT_EQ(network.latest_ms(Timepoint(t)), oracle.latest_ms(t)) << t;
    }
  }
}

// Whether constraints with these labels alone bring about the bounds that the network reports.
void expect_explained(const Network& network, std::span<const Constraint> posted, Timepoint t) {
  std::vector<std::uint32_t> labels;
  network.explain_earliest(t, labels);
  const AllPairs early(network.timepoints(), labelled(posted, labels));
  EXPECT_EQ(early.earliest_ms(t.value), network.earliest_ms(t));
  labels.clear();
  network.explain_latest(t, labels);
  const AllPairs late(network.timepoints(), labelled(posted, labels));
  EXPECT_EQ(late.latest_ms(t.value), network.latest_ms(t));
}

TEST(Network, Post_WhenConstraintsFormAChain_ThenTimesAreTheirSums) {
  Network network(4);
  const Timepoint a{1}, b{2}, c{3};
  network.track_latest();
  EXPECT_TRUE(network.post({a, b, 1000, 0}));
  EXPECT_TRUE(network.post({b, c, 500, 1}));
  EXPECT_TRUE(network.post({c, kOrigin, -4000, 2}));
  EXPECT_EQ(network.earliest_times(), (std::vector<std::int32_t>{0, 0, 1000, 1500}));
  EXPECT_EQ(network.latest_times(), (std::vector<std::int32_t>{0, 2500, 3500, 4000}));
}

TEST(Network, Post_WhenItContradicts_ThenTheCycleIsNamedAndNothingChanges) {
  Network network(4);
  const Timepoint a{1}, b{2}, c{3};
  ASSERT_TRUE(network.post({a, b, 1000, 10}));
  ASSERT_TRUE(network.post({b, c, 1000, 11}));
  ASSERT_TRUE(network.post({a, c, 100, 12}));
  EXPECT_FALSE(network.post({c, a, -1999, 13}));
  std::vector<std::uint32_t> cycle(network.conflict().begin(), network.conflict().end());
  std::ranges::sort(cycle);
  EXPECT_EQ(cycle, (std::vector<std::uint32_t>{10, 11, 13}));
  EXPECT_FALSE(network.beyond_horizon());
  EXPECT_EQ(network.constraints(), 3u);
  EXPECT_TRUE(network.post({c, a, -2000, 14}));
}

TEST(Network, Post_WhenTheHorizonIsPassed_ThenItSaysSo) {
  Network network(3);
  ASSERT_TRUE(network.post({kOrigin, Timepoint{1}, kHorizon_ms, 5}));
  EXPECT_FALSE(network.post({Timepoint{1}, Timepoint{2}, 1, 6}));
  EXPECT_TRUE(network.beyond_horizon());
  EXPECT_EQ(network.conflict().size(), 2u);
  EXPECT_FALSE(network.post({kOrigin, Timepoint{2}, kHorizon_ms + 1, 7}));
  EXPECT_TRUE(network.beyond_horizon());
}

TEST(Network, PostOfMany_WhenTheLastContradicts_ThenNoneIsKept) {
  Network network(3);
  const std::vector<Constraint> constraints = {{Timepoint{1}, Timepoint{2}, 10, 0},
                                               {Timepoint{2}, Timepoint{1}, 0, 1}};
  EXPECT_FALSE(network.post(constraints));
  EXPECT_EQ(network.constraints(), 0u);
  EXPECT_EQ(network.earliest_ms(Timepoint{2}), 0);
}

// Posts and undos at random; after each the network must hold what Floyd and Warshall compute afresh.
TEST(Network, PostAndUndo_WhenConstraintsAreRandom_ThenTimesAreThoseOfAllPairs) {
  std::mt19937 random(3);
  int conflicts = 0, undone = 0;
  for (int round = 0; round < 120; ++round) {
    const std::size_t size = 2 + random() % 9;
    Network network(size);
    if (round % 3 != 0) network.track_latest();
    std::vector<Constraint> posted;
    std::vector<std::pair<Network::Mark, std::size_t>> marks;
    for (std::uint32_t step = 0; step < 60; ++step) {
      if (!marks.empty() && random() % 5 == 0) {
        network.undo(marks.back().first);
        posted.resize(marks.back().second);
        marks.pop_back();
        ++undone;
      } else {
        marks.emplace_back(network.mark(), posted.size());
        posted.push_back(random_constraint(size, step, random));
        const AllPairs oracle(size, posted);
        ASSERT_EQ(network.post(posted.back()), oracle.consistent()) << round << " " << step;
        if (!oracle.consistent()) {
          ++conflicts;
          // The named constraints are enough for the contradiction.
          EXPECT_FALSE(AllPairs(size, labelled(posted, network.conflict())).consistent());
          posted.pop_back();
        }
      }
      ASSERT_NO_FATAL_FAILURE(expect_times(network, AllPairs(size, posted))) << round << " " << step;
      if (network.tracks_latest()) {
        expect_explained(network, posted, Timepoint(static_cast<std::uint32_t>(step % size)));
      }
    }
  }
  EXPECT_GT(conflicts, 500);
  EXPECT_GT(undone, 500);
}

TEST(Network, Post_WhenTheNetworkIsLarger_ThenEarliestTimesAreThoseOfBellmanAndFord) {
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round) {
    constexpr std::size_t kSize = 300;
    Network network(kSize);
    std::vector<Constraint> posted;
    for (std::uint32_t step = 0; step < 900; ++step) {
      posted.push_back(random_constraint(kSize, step, random));
      if (!network.post(posted.back())) posted.pop_back();
    }
    const auto times = earliest_by_rounds(kSize, posted);
    ASSERT_TRUE(times.has_value());
    for (std::uint32_t t = 0; t < kSize; ++t) ASSERT_EQ(network.earliest_ms(Timepoint(t)), (*times)[t]);
    network.track_latest();
    for (const Constraint& c : posted) {
      EXPECT_GE(network.latest_ms(c.to) - network.latest_ms(c.from), c.least_ms);
    }
  }
}

// Some posted first, the rest loaded at once, then more posted and taken back.
TEST(Network, Load_WhenConstraintsAreRandom_ThenVerdictTimesAndReasonsAreThoseOfPostingThem) {
  std::mt19937 random(7);
  int refused = 0, loaded = 0;
  for (int round = 0; round < 400; ++round) {
    const std::size_t size = 3 + static_cast<std::size_t>(round % 8);
    Network network(size);
    std::vector<Constraint> posted, more;
    std::uint32_t label = 0;
    for (; label < 4; ++label) {
      posted.push_back(random_constraint(size, label, random));
      if (!network.post(posted.back())) posted.pop_back();
    }
    for (; label < 4 + size / 2; ++label) more.push_back(random_constraint(size, label, random));
    std::vector<Constraint> all = posted;
    all.insert(all.end(), more.begin(), more.end());
    const bool consistent = AllPairs(size, all).consistent();
    ASSERT_EQ(network.load(more), consistent) << round;
    if (consistent) {
      ++loaded;
    } else {
      ++refused;
      EXPECT_FALSE(AllPairs(size, labelled(all, network.conflict())).consistent());
      all = posted;
    }
    ASSERT_NO_FATAL_FAILURE(expect_times(network, AllPairs(size, all))) << round;
    const Network::Mark mark = network.mark();
    const Constraint one = random_constraint(size, label, random);
    all.push_back(one);
    ASSERT_EQ(network.post(one), AllPairs(size, all).consistent());
    network.undo(mark);
    all.pop_back();
    network.track_latest();
    ASSERT_NO_FATAL_FAILURE(expect_times(network, AllPairs(size, all))) << round;
    expect_explained(network, all,
                     Timepoint(static_cast<std::uint32_t>(round) % static_cast<std::uint32_t>(size)));
  }
  EXPECT_GT(loaded, 100);
  EXPECT_GT(refused, 50);
}

// It would take a hundred million rounds to see by raising labels that there is no answer.
TEST(Network, Load_WhenACycleGrowsByAMillisecond_ThenItIsNamed) {
  Network network(4);
  const std::vector<Constraint> cycle = {{Timepoint(1), Timepoint(2), 1, 5},
                                         {Timepoint(2), Timepoint(3), 0, 6},
                                         {Timepoint(3), Timepoint(1), 0, 7}};
  EXPECT_FALSE(network.load(cycle));
  const std::set<std::uint32_t> named(network.conflict().begin(), network.conflict().end());
  EXPECT_EQ(named, (std::set<std::uint32_t>{5, 6, 7}));
  EXPECT_EQ(network.earliest_ms(Timepoint(2)), 0);
  EXPECT_EQ(network.constraints(), 0U);
}

TEST(Network, ConflictOfALargerNetwork_WhenNamed_ThenItIsOneByBellmanAndFord) {
  std::mt19937 random(6);
  constexpr std::size_t kSize = 200;
  Network network(kSize);
  std::vector<Constraint> all;
  int conflicts = 0;
  for (std::uint32_t step = 0; step < 3000; ++step) {
    all.push_back(random_constraint(kSize, step, random));
    if (network.post(all.back())) continue;
    ++conflicts;
    EXPECT_FALSE(earliest_by_rounds(kSize, labelled(all, network.conflict())).has_value());
  }
  EXPECT_GT(conflicts, 100);
}

}  // namespace
}  // namespace stepwright::fleet
