#include "supervisor/executive/what_if.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "supervisor/executive/goal_form.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "tests/support/given_time.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

Outlook at_the_beginning() {
  Outlook outlook;
  outlook.state = pddl::to_named(bench_planning().task().initial());
  return outlook;
}

// What has come of it once it is no longer being planned.
json answer_of(const WhatIf& what_if) {
  for (int i = 0; i < 1'000; ++i) {
    json told = json::parse(what_if.answer());
    if (told.is_object() && told["state"] != "planning") return told;
    std::this_thread::sleep_for(milliseconds(20));
  }
  return json::parse(what_if.answer());
}

TEST(WhatIf, WhenNobodyHasAsked_ThenThereIsNothing) {
  WhatIf what_if(bench_planning(), {});
  EXPECT_EQ(what_if.answer(), "null");
  EXPECT_EQ(what_if.cancel("").error().front().code, "X0008");
}

TEST(WhatIf, WhenAGoalIsGiven_ThenItsPlanIsToldWithCostTimeAndTheSameOfWhatIsLeft) {
  WhatIf what_if(bench_planning(), {});
  Outlook outlook = at_the_beginning();
  const auto running = bench_planning().prepare({.start = {.planning = outlook.state}});
  outlook.remaining = running->prepared.plan.actions;
  ASSERT_TRUE(what_if.ask({"7f", "(and (is-at v1 f1) (= (level a1) 3))", outlook}));
  const json told = answer_of(what_if);
  EXPECT_EQ(told["id"], "7f");
  EXPECT_EQ(told["state"], "planned") << told;
  EXPECT_GT(told["wall_ms"], 0.0);
  const json& plan = told["plan"];
  EXPECT_EQ(plan["steps"], plan["actions"].size());
  EXPECT_LT(plan["steps"], 6);
  EXPECT_TRUE(plan["proved_optimal"]);
  EXPECT_GT(plan["makespan_s"], 0.0);
  EXPECT_EQ(plan["actions"][0]["planned_start_s"].is_number(), true);
  EXPECT_EQ(told["running"]["steps"], 17);
  EXPECT_DOUBLE_EQ(told["running"]["cost"], running->prepared.plan.cost);
  EXPECT_NEAR(told["running"]["makespan_s"].get<double>(), running->prepared.episode.planned_makespan_s,
              1e-6);
  EXPECT_LT(plan["cost_ahead"], told["running"]["cost_ahead"]);
}

TEST(WhatIf, WhenTheMetricHasRunUpAlready_ThenTheCostAheadCountsFromHere) {
  WhatIf what_if(bench_planning(), {});
  Outlook outlook = at_the_beginning();
  outlook.state.fluents["(distance-travelled)"] = 100.0;
  ASSERT_TRUE(what_if.ask({"a", "(is-at v1 a1)", outlook}));
  const json told = answer_of(what_if);
  EXPECT_DOUBLE_EQ(told["plan"]["cost"], 101.0) << told;
  EXPECT_DOUBLE_EQ(told["plan"]["cost_ahead"], 1.0);
  EXPECT_TRUE(told["running"].is_null());
}

TEST(WhatIf, WhenTheGoalIsEmpty_ThenItIsTheOneThatThereIs) {
  WhatIf what_if(bench_planning(), {});
  Outlook outlook = at_the_beginning();
  outlook.goal = "(is-at v1 f1)";
  ASSERT_TRUE(what_if.ask({"a", "", outlook}));
  const json told = answer_of(what_if);
  EXPECT_EQ(told["goal"], "(is-at v1 f1)");
  EXPECT_EQ(told["plan"]["steps"], 0);
}

TEST(WhatIf, WhenNoPlanExists_ThenItIsSaidWhy) {
  WhatIf what_if(bench_planning(), {});
  ASSERT_TRUE(what_if.ask({"a", "(= (level a1) 11)", at_the_beginning()}));
  const json told = answer_of(what_if);
  EXPECT_EQ(told["state"], "no_plan") << told;
  EXPECT_NE(told["reason"], "");
  EXPECT_FALSE(told.contains("plan"));
}

TEST(WhatIf, WhenTheGoalIsNone_ThenItIsRefusedWithItsPlace) {
  WhatIf what_if(bench_planning(), {});
  const auto refused = what_if.ask({"a", "(and\n  (is-at v1 f1)\n  (= (level a9) 3))", at_the_beginning()});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().where.line, 3u);
  EXPECT_EQ(what_if.answer(), "null");
  EXPECT_EQ(what_if.ask({std::string(65, 'x'), "", at_the_beginning()}).error().front().code, "X0005");
}

// The bench with so much to be brought that no proof of the best plan ends while a test waits.
const PlanningService& slow_planning() {
  static const PlanningService planning = [] {
    const support::TemporaryFolder folder;
    PlanningOptions options = bench_planning_options();
    std::stringstream text;
    text << std::ifstream(options.problem).rdbuf();
    std::string problem = text.str();
    for (const auto& [usual, much] :
         {std::pair{"(demand c1) 7", "(demand c1) 77"}, std::pair{"(demand c2) 10", "(demand c2) 95"}}) {
      const std::size_t at = problem.find(usual);
      if (at == std::string::npos) throw std::runtime_error("the bench's problem is another one");
      problem.replace(at, std::strlen(usual), much);
    }
    options.problem = folder / "problem.pddl";
    std::ofstream(options.problem) << problem;
    auto opened = PlanningService::open(options);
    if (!opened) throw std::runtime_error(result::to_string(opened.error()));
    return std::move(*opened);
  }();
  return planning;
}

TEST(WhatIf, WhenOneIsPlannedFor_ThenAnotherIsRefusedUntilItIsCancelled) {
  WhatIf what_if(slow_planning(), {.time = std::chrono::minutes(5)});
  Outlook outlook;
  outlook.state = pddl::to_named(slow_planning().task().initial());
  ASSERT_TRUE(what_if.ask({"one", "", outlook}));
  EXPECT_EQ(what_if.ask({"two", "", outlook}).error().front().code, "X0008");
  EXPECT_EQ(what_if.cancel("two").error().front().code, "X0008") << "that is somebody else's";
  EXPECT_TRUE(what_if.cancel("one"));
  const json told = answer_of(what_if);
  EXPECT_EQ(told["id"], "one");
  EXPECT_EQ(told["state"], "cancelled") << told;
}

TEST(WhatIf, WhenTheBudgetEndsFirst_ThenItSaysSoAndTheNextMayAsk) {
  WhatIf what_if(slow_planning(), {.time = milliseconds(1)});
  Outlook outlook;
  outlook.state = pddl::to_named(slow_planning().task().initial());
  const support::GivenTime given;
  for (const char* id : {"one", "two"}) {
    const double asked_ms = given.ms();
    ASSERT_TRUE(what_if.ask({id, "", outlook}));
    const json told = answer_of(what_if);
    EXPECT_EQ(told["id"], id);
    // A first plan may have been quicker; it is no proved one.
    const bool early = told["state"] == "planned" && told["plan"]["proved_optimal"] == false;
    EXPECT_TRUE(early || (told["state"] == "exhausted" && told["reason"] != "")) << told;
    EXPECT_GT(told["wall_ms"], 0.0);
    EXPECT_LT(given.ms() - asked_ms, 10'000.0);
  }
}

TEST(GoalForm, WhenTheBenchIsDescribed_ThenItHasWordsObjectsAndWhatTheBindingKnows) {
  const json form = json::parse(goal_form_json(bench_planning()));
  EXPECT_EQ(form["available"], true);
  EXPECT_EQ(form["objects"]["place"], json({"f1", "a1", "a2"}));
  EXPECT_EQ(form["predicates"][0]["name"], "is-at");
  EXPECT_EQ(form["labels"]["(is-at v1 a1)"], "vehicle at a1");
  bool found = false;
  for (const json& sensor : form["sensors"]) {
    if (sensor["fluent"] != "(level a1)") continue;
    found = true;
    EXPECT_EQ(sensor["range"], json({0.0, 10.0}));
    EXPECT_EQ(sensor["step"], 1.0);
    EXPECT_EQ(sensor["unit"], "tenths");
  }
  EXPECT_TRUE(found);
}

TEST(GoalForm, WhenTheOutlookIsTold_ThenItHasWhatGoalsCanSpeakOfAndTheWhatIf) {
  const json told = json::parse(OutlookWriter(bench_planning()).json(at_the_beginning(), R"({"id": "7f"})"));
  EXPECT_EQ(told["facts"], json({"(is-at v1 f1)"}));
  EXPECT_EQ(told["fluents"]["(level a1)"], 2.0);
  EXPECT_EQ(told["what_if"]["id"], "7f");
  EXPECT_TRUE(bench_planning().check_goal(told["goal"]));
  EXPECT_TRUE(told["goal"].get<std::string>().starts_with("(and\n  "));
  EXPECT_EQ(json::parse(run::no_goal_form_json("a fleet"))["available"], false);
}

}  // namespace
}  // namespace stepwright::executive
