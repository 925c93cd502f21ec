// Who starts a run, and what the next one begins with.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using support::SimulatedController;

constexpr const char* kFewer = "(and (is-at v1 f1) (= (level a1) 3))";

// The code of a refusal; empty: accepted.
std::string code(const result::Result<void>& asked) {
  return asked ? std::string() : asked.error().front().code;
}

// A bench with an operator who acts on what the document says.
struct StartedBench {
  explicit StartedBench(ExecutiveOptions options_in = {}) : controller({}), options(std::move(options_in)) {
    options.cell = "bench";
    again();
  }
  // Another supervisor.
  void again() {
    phases.clear();
    executive.emplace(bench_planning(), controller, options, [this](const run::RunRecord& now) {
      if (phases.empty() || phases.back() != to_string(now.phase)) phases.emplace_back(to_string(now.phase));
      if (on_news) on_news(now);
    });
  }
  run::RunRecord run() {
    const run::RunRecord record = executive->run();
    EXPECT_TRUE(executive->over());
    return record;
  }

  SimulatedController controller;
  ExecutiveOptions options;
  std::optional<Executive> executive;
  std::function<void(const run::RunRecord&)> on_news;
  std::vector<std::string> phases;
};

ExecutiveOptions by_operator() {
  ExecutiveOptions options;
  options.operator_starts = true;
  return options;
}

ExecutiveOptions with_journal(const char* name, ExecutiveOptions options = {}) {
  options.journal = testing::TempDir() + name;
  std::filesystem::remove(options.journal);
  return options;
}

// a1 stands at 4 and no sensor is tared: it is believed.
run::RunRecord run_from_four(bool believes_sensors) {
  const support::TemporaryFolder folder;
  const PlanningService planning = bench_planning_without("tare = true\n", folder.path());
  assemblies::BenchParameters parameters = exact_bench();
  parameters.tanks[2].initial_percent = 40.0;
  SimulatedController controller(parameters);
  ExecutiveOptions options;
  options.believes_sensors = believes_sensors;
  const run::RunRecord record = run_bench(controller, options, planning);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_NEAR(controller.plant_value("level_a1_percent"), 50.0, 2.0);
  return record;
}

TEST(ExecutiveStart, WhenThePlantIsNotAsTheProblemSays_ThenThatIsWhereTheFirstPlanStartsOrAnIncident) {
  const run::RunRecord believed = run_from_four(true);
  ASSERT_EQ(believed.incidents.size(), 1u) << story(believed);
  EXPECT_EQ(believed.incidents[0].kind, run::IncidentKind::Operator);
  EXPECT_EQ(believed.incidents[0].evidence.front().rfind(
                "the plan starts where the plant is: level of a1 is 4.", 0),
            0u)
      << believed.incidents[0].evidence.front();
  EXPECT_TRUE(believed.replans.empty()) << story(believed);
  const run::RunRecord doubted = run_from_four(false);
  ASSERT_EQ(doubted.incidents.size(), 1u) << story(doubted);
  EXPECT_EQ(doubted.incidents[0].kind, run::IncidentKind::Level);
}

// The planner counts 4.7 as 5.
TEST(ExecutiveStart, WhenALevelOnlyRoundsToTheGoal_ThenTheGoalIsNotCalledMet) {
  const support::TemporaryFolder folder;
  const PlanningService planning = bench_planning_without("tare = true\n", folder.path());
  assemblies::BenchParameters parameters = exact_bench();
  parameters.tanks[2].initial_percent = 47.0;
  SimulatedController controller(parameters);
  bool seen = false;
  ExecutiveOptions options;
  options.cell = "bench";
  (void)Executive(planning, controller, options, [&](const run::RunRecord& now) {
    for (const run::GoalRecord& goal : now.goal) {
      const double level = now.observed.contains("(level a1)") ? now.observed.at("(level a1)") : 0.0;
      if (goal.text.find("(level a1)") == std::string::npos || std::abs(level - 4.7) > 0.1) continue;
      seen = true;
      EXPECT_FALSE(goal.met) << level;
    }
  }).run();
  EXPECT_TRUE(seen);
}

TEST(ExecutiveStart, WhenAnOperatorStartsRuns_ThenThePlanIsShownAndNothingIsDownloadedBefore) {
  StartedBench bench(by_operator());
  bool asked = false;
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase != run::Phase::Ready) return;
    asked = true;
    ASSERT_EQ(now.episodes.size(), 1u);
    EXPECT_EQ(now.episodes[0].actions.size(), 17u);
    EXPECT_GT(now.episodes[0].planned_makespan_s, 0.0);
    EXPECT_FALSE(bench.controller.status()->scan > 0) << "nothing has run";
    EXPECT_EQ(code(bench.executive->request_hold()), "X0008");
    EXPECT_EQ(code(bench.executive->request_start("(= (level a9) 3)")).substr(0, 1), "P");
    EXPECT_EQ(code(bench.executive->request_start("")), "");
    EXPECT_EQ(code(bench.executive->request_start("")), "X0008") << "it is under way";
  };
  const run::RunRecord record = bench.run();
  EXPECT_TRUE(asked);
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  EXPECT_EQ(record.episodes.size(), 1u);
  EXPECT_EQ(bench.phases,
            (std::vector<std::string>{"planning", "ready", "planning", "observing", "executing", "done"}));
}

TEST(ExecutiveStart, WhenItIsStartedWithAnotherGoal_ThenThatOneIsPlannedForFirst) {
  StartedBench bench(by_operator());
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase == run::Phase::Ready) {
      EXPECT_TRUE(bench.executive->request_start(kFewer));
    }
  };
  const run::RunRecord record = bench.run();
  EXPECT_EQ(record.phase, run::Phase::Done) << story(record);
  ASSERT_EQ(record.episodes.size(), 1u);
  EXPECT_LT(record.episodes[0].actions.size(), 6u);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 30.0, 2.0);
}

TEST(ExecutiveStart, WhenTheGoalChangesWhileItWaits_ThenAnotherPlanIsShownAndStillNothingMoves) {
  StartedBench bench(by_operator());
  int shown = 0;
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase != run::Phase::Ready) return;
    if (++shown == 1) {
      EXPECT_TRUE(bench.executive->request_goal(kFewer));
      return;
    }
    EXPECT_LT(now.episodes.at(0).actions.size(), 6u);
    bench.executive->request_abort();
  };
  const run::RunRecord record = bench.run();
  EXPECT_EQ(shown, 2);
  EXPECT_EQ(record.phase, run::Phase::Safe);
  EXPECT_EQ(record.message, "aborted by the operator");
  EXPECT_EQ(bench.controller.stops(), 0);
}

// Whoever wants to start with a goal that cannot be planned does not get the plan before started.
TEST(ExecutiveStart, WhenThereIsNoPlanForWhatIsWantedWhileItWaits_ThenThatIsRefusedAndThePlanBeforeWaits) {
  for (const bool with_start : {false, true}) {
    StartedBench bench(by_operator());
    int shown = 0;
    bench.on_news = [&](const run::RunRecord& now) {
      if (now.phase != run::Phase::Ready) return;
      EXPECT_EQ(now.episodes.at(0).actions.size(), 17u);
      const std::string never = "(and (is-at v1 f1) (= (level a1) 99))";
      if (++shown == 1) {
        EXPECT_EQ(
            code(with_start ? bench.executive->request_start(never) : bench.executive->request_goal(never)),
            "");
      } else {
        EXPECT_FALSE(bench.controller.status()->scan > 0) << "nothing has run";
        EXPECT_EQ(code(bench.executive->request_start("")), "");
      }
    };
    const run::RunRecord record = bench.run();
    SCOPED_TRACE(story(record));
    EXPECT_EQ(shown, 2);
    EXPECT_EQ(record.phase, run::Phase::Done);
    ASSERT_EQ(record.incidents.size(), 1u);
    EXPECT_EQ(record.incidents[0].kind, run::IncidentKind::NewGoal);
    EXPECT_EQ(record.incidents[0].response, run::Response::GoOn);
    ASSERT_EQ(record.incidents[0].evidence.size(), 2u);
    EXPECT_TRUE(record.incidents[0].evidence[1].starts_with("that is refused, there is no plan for it: "))
        << record.incidents[0].evidence[1];
    EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 50.0, 2.0);
  }
}

TEST(ExecutiveStart, WhenARunHasReachedItsGoal_ThenAnotherOneBeginsWhereThePlantIs) {
  StartedBench bench;
  EXPECT_EQ(code(bench.executive->request_start("")), "X0008") << "the first one is about to run";
  const run::RunRecord first = bench.run();
  ASSERT_EQ(first.phase, run::Phase::Done) << story(first);
  EXPECT_FALSE(bench.executive->wait_start(std::chrono::milliseconds(0)));
  ASSERT_EQ(code(bench.executive->request_start("(and (is-at v1 a2) (= (level a1) 6))")), "");
  EXPECT_FALSE(bench.executive->over());
  EXPECT_TRUE(bench.executive->wait_start(std::chrono::milliseconds(0)));
  bench.phases.clear();
  const run::RunRecord second = bench.run();
  SCOPED_TRACE(story(second));
  EXPECT_EQ(second.phase, run::Phase::Done);
  EXPECT_EQ(bench.phases, (std::vector<std::string>{"planning", "observing", "executing", "done"}));
  EXPECT_EQ(second.episodes.size(), 1u) << "it knows nothing of the run before";
  EXPECT_TRUE(second.replans.empty());
  ASSERT_EQ(second.incidents.size(), 1u);
  EXPECT_EQ(second.incidents[0].evidence.front(), "started by the operator");
  EXPECT_EQ(second.tare, first.tare);
  EXPECT_GE(second.started_s, first.finished_s);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 60.0, 2.0);
  EXPECT_FALSE(bench.controller.any_output());
}

TEST(ExecutiveStart, WhenARunTellsItsEnd_ThenItIsOverForWhoeverHearsOfIt) {
  StartedBench bench;
  std::string aborted = "not asked";
  std::string started = "not asked";
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase != run::Phase::Done || aborted != "not asked") return;
    aborted = code(bench.executive->obey(*run::Request::parse(R"({"request": "abort"})")));
    started = code(bench.executive->request_start("(and (is-at v1 a2) (= (level a1) 6))"));
  };
  ASSERT_EQ(bench.executive->run().phase, run::Phase::Done);
  EXPECT_EQ(aborted, "X0008");
  EXPECT_EQ(started, "");
  EXPECT_TRUE(bench.executive->wait_start(std::chrono::milliseconds(0)));
  EXPECT_EQ(bench.run().phase, run::Phase::Done);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 60.0, 2.0);
}

TEST(ExecutiveStart, WhenTheGoalIsMetAlready_ThenTheNextRunEndsAtOnce) {
  StartedBench bench;
  ASSERT_EQ(bench.run().phase, run::Phase::Done);
  ASSERT_TRUE(bench.executive->request_start(""));
  const run::RunRecord again = bench.run();
  EXPECT_EQ(again.phase, run::Phase::Done) << story(again);
  EXPECT_TRUE(again.episodes.empty());
}

TEST(ExecutiveStart, WhenARunWasAbortedHalfWay_ThenAnotherOneReachesTheGoal) {
  StartedBench bench;
  bench.on_news = [&](const run::RunRecord& now) {
    const bool moves = now.phase == run::Phase::Executing && !now.episodes.empty() &&
                       std::ranges::any_of(now.episodes[0].actions, [](const run::ActionRecord& action) {
                         return action.text.starts_with("(move") && action.state == run::ActionState::Active;
                       });
    if (moves) bench.executive->request_abort();
  };
  const run::RunRecord first = bench.run();
  ASSERT_EQ(first.phase, run::Phase::Safe);
  bench.on_news = {};
  ASSERT_TRUE(bench.executive->request_start(""));
  const run::RunRecord second = bench.run();
  EXPECT_EQ(second.phase, run::Phase::Done) << story(second);
  EXPECT_NEAR(bench.controller.plant_value("level_a1_percent"), 50.0, 2.0);
  EXPECT_NEAR(bench.controller.plant_value("level_a2_percent"), 50.0, 2.0);
}

TEST(ExecutiveStart, WhenNoRuntimeAnswers_ThenNothingIsStarted) {
  StartedBench bench;
  ASSERT_EQ(bench.run().phase, run::Phase::Done);
  bench.controller.kill_runtime();
  EXPECT_EQ(code(bench.executive->request_start("")), "X0008");
  EXPECT_TRUE(bench.executive->over());
}

TEST(ExecutiveStart, WhenTheSupervisorIsRestartedAfterARun_ThenTheNextOneWaitsForAnOperator) {
  StartedBench bench(with_journal("over_executive.json", by_operator()));
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase == run::Phase::Ready) {
      EXPECT_TRUE(bench.executive->request_start(""));
    }
  };
  ASSERT_EQ(bench.run().phase, run::Phase::Done);
  bench.on_news = {};
  bench.again();
  const run::RunRecord known = bench.run();
  EXPECT_EQ(known.phase, run::Phase::Done);
  EXPECT_EQ(known.episodes.size(), 1u) << "viewers still see what has been";
  ASSERT_TRUE(bench.executive->request_start("(and (is-at v1 f1) (= (level a2) 6))"));
  const run::RunRecord next = bench.run();
  EXPECT_EQ(next.phase, run::Phase::Done) << story(next);
  EXPECT_NEAR(bench.controller.plant_value("level_a2_percent"), 60.0, 2.0);
}

// The plan of such a run is empty, which makes no episode.
TEST(ExecutiveStart, WhenTheSupervisorIsRestartedAfterAGoalThatWasMetAlready_ThenItsJournalCanBeRead) {
  StartedBench bench(with_journal("met_executive.json"));
  bool asked = false;
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase != run::Phase::Executing || asked) return;
    asked = true;
    EXPECT_TRUE(bench.executive->request_goal("(is-at v1 f1)"));
  };
  ASSERT_EQ(bench.run().phase, run::Phase::Done);
  bench.on_news = {};
  bench.options.operator_starts = true;
  bench.again();
  const run::RunRecord known = bench.run();
  EXPECT_EQ(known.phase, run::Phase::Done) << story(known);
}

TEST(ExecutiveStart, WhenHeldBeforeTheFirstPlanAndTheSupervisorIsRestarted_ThenItIsStillHeld) {
  struct Killed {};
  StartedBench bench(with_journal("early_hold_executive.json"));
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase == run::Phase::Planning && bench.phases.size() == 1) (void)bench.executive->request_hold();
    if (now.phase == run::Phase::Observing) throw Killed{};
  };
  EXPECT_THROW((void)bench.executive->run(), Killed);
  bench.on_news = [&](const run::RunRecord& now) {
    if (now.phase == run::Phase::Held) bench.executive->request_abort();
  };
  bench.again();
  const run::RunRecord record = bench.run();
  EXPECT_EQ(record.message, "aborted by the operator") << story(record);
  EXPECT_NE(std::ranges::find(bench.phases, "held"), bench.phases.end());
  EXPECT_EQ(std::ranges::find(bench.phases, "executing"), bench.phases.end());
}

TEST(ExecutiveStart, WhenAPlanIsFollowed_ThenTheOutlookIsWhereItsActionsWillHaveLed) {
  StartedBench bench;
  bool looked = false;
  bench.on_news = [&](const run::RunRecord& now) {
    const Outlook outlook = bench.executive->outlook();
    EXPECT_EQ(outlook.revision, bench.executive->outlook_revision());
    if (now.phase != run::Phase::Executing || now.episodes.empty()) return;
    const std::vector<run::ActionRecord>& actions = now.episodes[0].actions;
    const auto active = std::ranges::find(actions, run::ActionState::Active, &run::ActionRecord::state);
    if (active == actions.end() || !active->text.starts_with("(move")) return;
    looked = true;
    EXPECT_TRUE(outlook.ahead);
    // Between two places; the plan will have brought it to one.
    const auto places = std::ranges::count_if(
        outlook.state.facts, [](const std::string& fact) { return fact.starts_with("(is-at v1"); });
    EXPECT_EQ(places, 1) << active->text;
    const auto pending = std::ranges::count(actions, run::ActionState::Pending, &run::ActionRecord::state);
    EXPECT_EQ(outlook.remaining.size(), static_cast<std::size_t>(pending));
    for (const char* level : {"(lev v1)", "(level a1)", "(level a2)"})
      EXPECT_DOUBLE_EQ(outlook.state.fluents.at(level), std::round(outlook.state.fluents.at(level)));
    EXPECT_TRUE(bench_planning().worth_of({.planning = outlook.state}, outlook.remaining)) << active->text;
  };
  ASSERT_EQ(bench.run().phase, run::Phase::Done);
  EXPECT_TRUE(looked);
  EXPECT_TRUE(bench.executive->outlook().remaining.empty());
}

}  // namespace
}  // namespace stepwright::executive
