#include "supervisor/fleet/schedule/internal/search.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "supervisor/fleet/schedule/internal/model.h"
#include "tests/unit/supervisor/fleet/schedule/exhaustive.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet::internal {
namespace {

// What large and hard problems alone would bring about: restarts, forgotten clauses, late latest times.
constexpr SearchTuning kImpatient{.few_sections = 0, .conflicts_per_restart = 1, .clauses_kept = 2};
// Nothing but clauses.
constexpr SearchTuning kPatient{.few_sections = 0, .conflicts_per_restart = 1'000'000, .clauses_kept = 2000};

struct Prepared {
  Motion motion;
  Sections sections;
  SearchModel model;
  SearchObjective objective;

  // Each pair a section of its own, so that the search has more to decide.
  Prepared(const Problem& problem, Mode mode)
      : motion(problem.envelopes, problem.constraints),
        sections(unmerged_sections(overlapping_pairs(problem.envelopes))) {
    const std::vector<char> kept(motion.labels().precedences(), 1);
    std::vector<std::uint32_t> all(sections.sections.size());
    std::iota(all.begin(), all.end(), 0U);
    model = make_model(motion, sections, mode, kept, all);
    objective = make_objective(motion, {.objective = Objective::Makespan});
  }
};

TEST(Search, Next_WhenItIsImpatientOrPatient_ThenItFindsTheBestOfAllOrders) {
  std::mt19937 random(41);
  std::uint64_t conflicts = 0, restarts = 0;
  int feasible = 0, infeasible = 0;
  for (int round = 0; round < 1500; ++round) {
    const Mode mode = round % 2 ? Mode::Strict : Mode::EarliestTimes;
    const Problem problem = random_problem(2 + round % 3, 5, random);
    const Exhaustive all = try_all_orders(problem, mode, 0);
    const Prepared prepared(problem, mode);
    for (const SearchTuning& tuning : {kImpatient, kPatient}) {
      Search search(prepared.model, prepared.objective, {}, tuning);
      Answer answer = search.next();
      ASSERT_EQ(answer == Answer::Yes, all.feasible) << round;
      while (answer == Answer::Yes) {
        // It holds long before anything is proved.
        EXPECT_LE(search.lower_bound_ms(), all.makespan_ms);
        answer = search.next();
      }
      EXPECT_EQ(answer, Answer::No);
      if (all.feasible) {
        ASSERT_EQ(search.objective_ms(), all.makespan_ms) << round;
      }
      conflicts += search.figures().conflicts;
      restarts += search.figures().restarts;
    }
    (all.feasible ? feasible : infeasible) += 1;
  }
  EXPECT_GT(conflicts, 1000u);
  EXPECT_GT(restarts, 500u);
  EXPECT_GT(feasible, 100);
  EXPECT_GT(infeasible, 100);
}

TEST(Search, Next_WhenTimeIsOver_ThenItSaysSo) {
  std::mt19937 random(42);
  const Problem problem{{lane("a", 0, 6, 0.0, std::chrono::seconds(9))}, {}};
  const Prepared prepared(problem, Mode::EarliestTimes);
  Search search(prepared.model, prepared.objective, {.until = std::chrono::steady_clock::time_point::min()});
  EXPECT_EQ(search.next(), Answer::OutOfTime);
}

}  // namespace
}  // namespace stepwright::fleet::internal
