#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/translate/translation.h"
#include "tests/unit/supervisor/translate/bench_rig.h"
#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

using graphic::StepId;
using graphic::to_st;
using graphic::Transition;

class TranslateBench : public ::testing::Test {
 protected:
  Translation make(const std::vector<std::string>& plan, const TranslateOptions& options = {}) {
    auto made = translate(testing::bench_run(plan), binding_, options);
    if (!made) throw std::runtime_error(to_string(made.error()));
    return std::move(*made);
  }
  static std::string name(const Translation& translation, StepId step) {
    return translation.steps[step.value].name;
  }
  // Transitions that leave `step`, as "S01_LOAD -> R01_LOAD: condition".
  static std::vector<std::string> ways_out(const Translation& translation, const std::string& step) {
    std::vector<std::string> ways;
    for (const Transition& transition : translation.chart().transitions) {
      bool leaves = false;
      for (const StepId source : transition.sources) leaves = leaves || name(translation, source) == step;
      if (!leaves) continue;
      std::string text;
      for (const StepId target : transition.targets) text += name(translation, target) + " ";
      ways.push_back(text + "if " + to_st(transition.condition));
    }
    return ways;
  }

  Binding binding_ = testing::bench_binding();
};

TEST_F(TranslateBench, WhenPaperPlanIsSequential_ThenStepsFollowThePapersNumbers) {
  const Translation made = make(testing::metric_ff_plan(), {.sequential = true});
  const auto& steps = made.chart().steps;
  EXPECT_EQ(steps[0].name, "START");
  EXPECT_TRUE(steps[0].initial);
  EXPECT_EQ(steps[1].name, "S01_LOAD");
  EXPECT_EQ(steps[1].comment, "(load v1 f1 level8)");
  EXPECT_EQ(steps[19].name, "S19_FINAL_ORDER");
  EXPECT_EQ(std::count_if(steps.begin(), steps.end(), [](const auto& s) { return s.initial; }), 1);
  for (const Transition& transition : made.chart().transitions) {
    EXPECT_EQ(transition.sources.size(), 1U);
    EXPECT_EQ(transition.targets.size(), 1U);
  }
  EXPECT_TRUE(graphic::check(made.chart()).empty());
}

TEST_F(TranslateBench, WhenActionIsTranslated_ThenDrivesItsOutputOnlyInItsStep) {
  const Translation made = make({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  const auto& steps = made.chart().steps;
  ASSERT_EQ(steps[1].actions.size(), 1U);
  EXPECT_EQ(steps[1].actions[0].target, "B1");
  EXPECT_EQ(steps[1].actions[0].qualifier, graphic::Qualifier::N);
  EXPECT_EQ(steps[2].actions[0].target, "drive_left");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].actions.empty(), made.steps[i].kind != StepKind::Action) << steps[i].name;
  }
}

TEST_F(TranslateBench, WhenStartIsChecked_ThenComparesTable4WithinTolerance) {
  const Translation made = make({"(load v1 f1 level8)"});
  const auto ways = ways_out(made, "START");
  ASSERT_EQ(ways.size(), 2U);  // the guard of the first action is part of the snapshot
  EXPECT_EQ(
      ways[0],
      "S01_LOAD if (START.T >= T#1500ms) AND fc1 AND NOT fc2 AND NOT fc3 AND (S1_filtered >= 1260) AND "
      "(S1_filtered <= 1384) AND (S2_filtered >= 661) AND (S2_filtered <= 811) AND (S3_filtered >= 1014) "
      "AND (S3_filtered <= 1108)");
  EXPECT_THAT(ways[1], ::testing::StartsWith("FAILED_START if (START.T >= T#1500ms) AND (NOT fc1 OR fc2"));
}

TEST_F(TranslateBench, WhenPumpReachesItsLevel_ThenStopsEarlyByPreActAndRests) {
  const Translation made = make({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  // Level 10 - 0.24 of 307.75 counts each: 3784 - 73.86.
  EXPECT_THAT(ways_out(made, "S01_LOAD"),
              ::testing::ElementsAre("R01_LOAD if (S1_filtered >= 3710)",
                                     "FAILED_S01_LOAD if NOT fc1 OR (S01_LOAD.T >= T#40s)"));
  EXPECT_THAT(ways_out(made, "R01_LOAD"),
              ::testing::ElementsAre("S02_MOVE if (R01_LOAD.T >= T#1500ms) AND fc1",
                                     "FAILED_S02_MOVE if (R01_LOAD.T >= T#1500ms) AND NOT fc1"));
  EXPECT_THAT(ways_out(made, "S02_MOVE"),
              ::testing::ElementsAre("SETTLE if fc2", "FAILED_S02_MOVE if (S02_MOVE.T >= T#20s)"));
  EXPECT_THAT(ways_out(made, "SETTLE"), ::testing::ElementsAre("DONE if (SETTLE.T >= T#2s)"));
  EXPECT_TRUE(ways_out(made, "DONE").empty());
  EXPECT_TRUE(ways_out(made, "FAILED_S01_LOAD").empty());
}

TEST_F(TranslateBench, WhenLevelFalls_ThenCompletionLooksFromAbove) {
  const Translation made = make(testing::metric_ff_plan());
  // Order of 7 from 10: level 3 + 0.12 of 372.67 counts each, 1108.67 + 44.72.
  EXPECT_EQ(ways_out(made, "S09_COMPLETE_ORDER")[0], "R09_COMPLETE_ORDER if (S2_filtered <= 1153)");
}

TEST_F(TranslateBench, WhenCustomerPumpNeedsNoVehicle_ThenRunsBesideTheMoves) {
  const Translation made = make(testing::metric_ff_plan());
  // After the vehicle has filled a1 (action 3), the trip back and the order of c1 go on at the same time.
  EXPECT_THAT(made.orderings, ::testing::IsSupersetOf({model::Ordering{2, 3}, model::Ordering{2, 8}}));
  EXPECT_THAT(ways_out(made, "R03_UNLOAD"),
              ::testing::ElementsAre("W03_04 W03_09 if (R03_UNLOAD.T >= T#1500ms)"));
  EXPECT_THAT(ways_out(made, "W03_09"),
              ::testing::ElementsAre("S09_COMPLETE_ORDER if (S2_filtered >= 3270)",
                                     "FAILED_S09_COMPLETE_ORDER if (S2_filtered < 3270)"));
  EXPECT_TRUE(graphic::check(made.chart()).empty());
}

TEST_F(TranslateBench, WhenTheSamePlanRunsBothWays_ThenBothReachTheGoalAndParallelIsFaster) {
  double seconds[2] = {};
  for (const bool sequential : {false, true}) {
    const Translation made = make(testing::metric_ff_plan(), {.sequential = sequential});
    testing::BenchRig rig(made, binding_);
    ASSERT_EQ(rig.run(600), "DONE");
    seconds[sequential ? 1 : 0] = rig.time_s();
    EXPECT_NEAR(rig.levels["(level a1)"], 5.0, 0.05);
    EXPECT_NEAR(rig.levels["(level a2)"], 5.0, 0.05);
    EXPECT_NEAR(rig.position, 0.0, 0.05);
  }
  EXPECT_LT(seconds[0], 0.9 * seconds[1]);
}

TEST_F(TranslateBench, WhenSensorsAreBiased_ThenTheTareKeepsTheLevelsRight) {
  const Tare tare = {{"S1", 50.0}, {"S2", -120.0}, {"S3", 90.0}};
  const Translation made = make(testing::metric_ff_plan(), {.tare = tare});
  testing::BenchRig rig(made, binding_, tare);
  ASSERT_EQ(rig.run(600), "DONE");
  EXPECT_NEAR(rig.levels["(level a1)"], 5.0, 0.05);
  testing::BenchRig other(made, binding_);
  EXPECT_EQ(other.run(600), "FAILED_START");
}

TEST_F(TranslateBench, WhenSwitchIsStuckOrPumpDead_ThenTheStepTimesOutWithoutOutputs) {
  const Translation made = make(testing::metric_ff_plan());
  testing::BenchRig stuck(made, binding_);
  stuck.stuck["fc2"] = 0.0;
  EXPECT_EQ(stuck.run(600), "FAILED_S02_MOVE");
  EXPECT_FALSE(stuck.output("drive_left"));
  testing::BenchRig dead(made, binding_);
  dead.pump_speed = 0.0;
  EXPECT_EQ(dead.run(600), "FAILED_S01_LOAD");
  EXPECT_FALSE(dead.output("B1"));
  EXPECT_NEAR(dead.time_s(), 41.5, 0.1);
}

TEST_F(TranslateBench, WhenVehicleLeavesUnderThePump_ThenThePumpStopsAtOnce) {
  const Translation made = make(testing::metric_ff_plan());
  testing::BenchRig rig(made, binding_);
  while (!rig.output("B1")) rig.scan();
  rig.position = 0.5;
  rig.scan();
  EXPECT_TRUE(rig.active("FAILED_S01_LOAD"));
  EXPECT_FALSE(rig.output("B1"));
}

TEST_F(TranslateBench, WhenPreconditionIsNotObserved_ThenTheActionDoesNotStart) {
  const Translation made = make(testing::metric_ff_plan());
  testing::BenchRig rig(made, binding_);
  while (!rig.active("R01_LOAD")) rig.scan();
  rig.position = 0.5;
  EXPECT_EQ(rig.run(10), "FAILED_S02_MOVE");
}

TEST_F(TranslateBench, WhenStartWasMeasured_ThenSnapshotAndExpectationFollowTheMeasurement) {
  // 2.4 on board planned as 2, 1.7 in a1 planned as 2.
  const TranslateOptions options{.measured = {{"(lev v1)", 2.4}, {"(level a1)", 1.7}}};
  const Translation made = make(testing::metric_ff_plan(), options);
  testing::BenchRig rig(made, binding_);
  rig.levels["(lev v1)"] = 2.4;
  rig.levels["(level a1)"] = 1.7;
  std::vector<bool> done(19, false);
  EXPECT_DOUBLE_EQ(expected_state(made, done).fluents["(lev v1)"], 2.4);
  done[0] = done[1] = true;
  EXPECT_DOUBLE_EQ(expected_state(made, done).fluents["(lev v1)"], 10.0);
  done[2] = true;  // a1 is filled to 10, which takes 8.3 out of the vehicle
  EXPECT_DOUBLE_EQ(expected_state(made, done).fluents["(level a1)"], 10.0);
  EXPECT_DOUBLE_EQ(expected_state(made, done).fluents["(lev v1)"], 1.7);
  ASSERT_EQ(rig.run(600), "DONE");
  EXPECT_NEAR(rig.levels["(level a1)"], 5.0, 0.05);
}

TEST_F(TranslateBench, WhenProjectIsMade_ThenSensorsRunBeforeTheChart) {
  const Translation made = make(testing::metric_ff_plan(), {.interval_us = 5'000});
  const graphic::Project& project = made.project;
  ASSERT_EQ(project.instances.size(), 2U);
  EXPECT_EQ(project.instances[0].program, "sensors");
  EXPECT_EQ(project.instances[1].program, made.program);
  ASSERT_EQ(project.tasks.size(), 1U);
  EXPECT_EQ(project.tasks[0].interval_us, 5'000);
  EXPECT_EQ(project.globals.size(), 15U);
  EXPECT_EQ(project.globals[0].address, "%IX0.0");
  const std::string& text = std::get<graphic::StBody>(project.pous[0].body).text;
  // 1 - exp(-0.005 / 0.25)
  EXPECT_THAT(text,
              ::testing::HasSubstr("S1_state := S1_state + 0.0198013267 * (INT_TO_REAL(S1) - S1_state);"));
}

TEST_F(TranslateBench, WhenPlanIsEmpty_ThenOnlyChecksAndSettles) {
  const Translation made = make({});
  EXPECT_EQ(made.steps.size(), 4U);
  testing::BenchRig rig(made, binding_);
  EXPECT_EQ(rig.run(10), "DONE");
}

TEST_F(TranslateBench, WhenActionIsNotBound_ThenSaysWhich) {
  model::PlannedRun run = testing::bench_run({"(load v1 f1 level8)"});
  run.actions[0].action.name = "fly";
  const auto made = translate(run, binding_);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0001");
  EXPECT_THAT(made.error().front().message, ::testing::HasSubstr("(fly v1 f1 level8)"));
}

TEST_F(TranslateBench, WhenOrderingContradictsTheList_ThenFails) {
  model::PlannedRun run = testing::bench_run({"(load v1 f1 level8)", "(move v1 f1 a1)"});
  run.orderings->push_back({1, 0});
  EXPECT_EQ(translate(run, binding_).error().front().code, "T0002");
  run.orderings->back() = {1, 7};
  EXPECT_EQ(translate(run, binding_).error().front().code, "T0002");
}

TEST_F(TranslateBench, WhenCompletionCannotHappen_ThenFailsAtTheBindingsEntry) {
  model::PlannedRun run = testing::bench_run({"(load v1 f1 level8)"});
  run.actions[0].after.fluents["(lev v1)"] = 2.0;
  auto made = translate(run, binding_);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0004");
  EXPECT_THAT(made.error().front().where.file, ::testing::HasSubstr("binding.toml"));
  EXPECT_GT(made.error().front().where.line, 0U);
  run.actions[0].after.fluents["(lev v1)"] = 1'000.0;
  EXPECT_EQ(translate(run, binding_).error().front().code, "T0004");
  run.actions[0].after.fluents.erase("(lev v1)");
  EXPECT_EQ(translate(run, binding_).error().front().code, "T0003");
  run = testing::bench_run({"(move v1 f1 a1)"});
  run.actions[0].after.facts.erase("(is-at v1 a1)");
  EXPECT_EQ(translate(run, binding_).error().front().code, "T0004");
}

TEST_F(TranslateBench, WhenTagHasTheNameOfAStep_ThenFails) {
  binding_.tags[0].name = "S01_load";
  for (ObservedFact& fact : binding_.facts) fact.tag = fact.tag == "fc1" ? "S01_load" : fact.tag;
  const auto made = translate(testing::bench_run({"(load v1 f1 level8)"}), binding_);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0006");
}

}  // namespace
}  // namespace stepwright::translate
