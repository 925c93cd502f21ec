// The parts of bench_planner that its figures rest on: the baseline solves what it should and its plans are
// valid, best known costs hold for exact texts only, and a child that fails is noticed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <thread>

#include "tests/bench/planner/baseline/hill_climbing.h"
#include "tests/bench/planner/baseline/uniform_cost.h"
#include "tests/bench/planner/measure/child.h"
#include "tests/bench/planner/measure/judge.h"
#include "tests/bench/planner/report/best_known.h"
#include "tests/bench/planner/report/curve_svg.h"
#include "tests/bench/planner/suite.h"

namespace stepwright::bench {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Instance smallest(const std::string& name) {
  for (const Generator& generator : generators()) {
    if (generator.name == name) return make_instance(generator, generator.sizes.front(), 1);
  }
  throw std::invalid_argument(name);
}

class Baselines : public testing::TestWithParam<std::string> {};

TEST_P(Baselines, HillClimbing_OnTheSmallestSize_FindsAValidPlan) {
  const Instance instance = smallest(GetParam());
  const auto task = task_of(instance);
  ASSERT_TRUE(task);
  const Baseline result = hill_climbing(*task, {20s, 2048});
  ASSERT_TRUE(result.found) << result.reason;
  const Judgement judged = judge(*task, result.actions);
  EXPECT_THAT(judged.wrong, IsEmpty());
  EXPECT_GE(judged.cost, instance.lower_bound);
}

INSTANTIATE_TEST_SUITE_P(All, Baselines,
                         testing::Values("logistics", "depots", "blocks", "courier", "rovers", "satellites",
                                         "zeno", "sailing", "counters", "warehouse_tanks", "job_shop",
                                         "sorting_line", "tank_bench_1"),
                         [](const auto& each) { return each.param; });

TEST(UniformCost, Counters_WhereTheGeneratorKnowsTheLeastCost_FindsIt) {
  const Instance instance = smallest("counters");
  const auto task = task_of(instance);
  const UniformCost result = uniform_cost(*task);
  EXPECT_TRUE(result.found);
  EXPECT_EQ(result.steps, instance.lower_bound);
}

TEST(Judge, PlanThatLacksAStep_IsWrongAndSaysWhere) {
  Instance instance = smallest("blocks");
  const auto task = task_of(instance);
  EXPECT_THAT(judge(*task, instance.reference).wrong, IsEmpty());
  instance.reference.erase(instance.reference.begin());
  EXPECT_THAT(judge(*task, instance.reference).wrong, HasSubstr("step 1"));
  instance.reference.clear();
  EXPECT_THAT(judge(*task, instance.reference).wrong, HasSubstr("goal"));
}

// What a planner says is not believed: the bench stops at each of these.
TEST(Measurement, PlannerThatLies_IsFoundOut) {
  const Instance instance = smallest("blocks");
  const auto task = task_of(instance);
  std::string plan;
  for (const auto& action : instance.reference) plan += model::to_string(action) + "\\n";
  const auto said = [&](const std::string& line) {
    ChildResult child;
    child.end = ChildEnd::Done;
    child.lines = {line};
    return measurement_of(child, *task);
  };
  const std::string times = R"({"wall_ms": 1, "cpu_ms": 1, "expanded": 1, )";
  const Measurement good = said(times + R"("plan": ")" + plan + "\"}");
  EXPECT_THAT(good.wrong, IsEmpty());
  ASSERT_TRUE(good.solved());
  EXPECT_EQ(good.last().steps, instance.reference.size());
  EXPECT_THAT(said(times + R"("plan": ")" + plan + R"(", "cost": 1})").wrong,
              HasSubstr("says that it costs"));
  EXPECT_THAT(said(times + R"("plan": ""})").wrong, HasSubstr("goal"));
  EXPECT_THAT(said(times + R"("infeasible": true, "reason": "no"})").wrong, HasSubstr("no plan"));
}

TEST(BestKnown, Offers_AreKeptWhereTheyAreBetterAndForTheSameTextsOnly) {
  const std::string path = testing::TempDir() + "best_known_test.json";
  std::filesystem::remove(path);
  auto best = BestKnown::load(path);
  ASSERT_TRUE(best);
  Instance instance = smallest("logistics");
  best->offer(instance, 12, 3, "generator");
  best->offer(instance, 10, 2, "planner");
  best->offer(instance, 11, 5, "baseline");
  ASSERT_TRUE(best->save(path));
  const auto again = BestKnown::load(path);
  ASSERT_TRUE(again);
  const auto known = again->find(instance);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->cost, 10);
  EXPECT_EQ(known->bound, 5);
  EXPECT_EQ(known->found_by, "planner");
  EXPECT_FALSE(known->proved());
  instance.problem += " ";
  EXPECT_FALSE(again->find(instance));
}

TEST(BestKnown, BrokenFile_IsRefusedWithItsName) {
  const std::string path = testing::TempDir() + "best_known_broken.json";
  std::ofstream(path) << R"({"blocks-2-1": {"cost": 3}})";
  const auto best = BestKnown::load(path);
  ASSERT_FALSE(best);
  EXPECT_THAT(result::to_string(best.error()), HasSubstr(path));
}

// What the file beside the program says must be about the instances that the generators make today, and the
// costs must be at least what the generators prove.
TEST(BestKnown, FileOfTheRepository_MatchesTheGenerators) {
  const auto best = BestKnown::load(STEPWRIGHT_SOURCE_DIR "/tests/bench/planner/best_known.json");
  ASSERT_TRUE(best);
  int known = 0;
  for (const Generator& generator : generators()) {
    for (const int size : generator.sizes) {
      const Instance instance = make_instance(generator, size, 1);
      const auto entry = best->find(instance);
      ASSERT_TRUE(entry) << instance.name() << ": run scripts/bench planner --update-best";
      EXPECT_GE(entry->cost, instance.lower_bound) << instance.name();
      EXPECT_GE(entry->cost, entry->bound - 1e-6) << instance.name();
      ++known;
    }
  }
  EXPECT_GE(known, 60);
}

TEST(Child, LinesAndEnd_OfWorkThatIsDone_Arrive) {
  const ChildResult result = run_child({10s, 0}, [](const Send& send) {
    send("one");
    send("two");
  });
  EXPECT_EQ(result.end, ChildEnd::Done);
  EXPECT_THAT(result.lines, ElementsAre("one", "two"));
  EXPECT_GT(result.peak_mb, 0.0);
}

TEST(Child, WorkThatHangs_IsEndedAndKeepsItsLines) {
  const ChildResult result = run_child({200ms, 0}, [](const Send& send) {
    send("before");
    std::this_thread::sleep_for(1h);
  });
  EXPECT_EQ(result.end, ChildEnd::OutOfTime);
  EXPECT_THAT(result.lines, ElementsAre("before"));
  EXPECT_LT(result.wall_ms, 5000.0);
}

TEST(Child, WorkThatTakesTooMuchMemoryOrCrashes_IsTold) {
  EXPECT_EQ(run_child({10s, 0}, [](const Send&) { throw std::bad_alloc(); }).end, ChildEnd::OutOfMemory);
  EXPECT_EQ(run_child({10s, 0}, [](const Send&) { _exit(3); }).end, ChildEnd::Crashed);
}

TEST(Child, CommandThatHangs_IsEndedWithAllItStarted) {
  const ChildResult result = run_command({200ms, 0}, "sleep 3600 & sleep 3600");
  EXPECT_EQ(result.end, ChildEnd::OutOfTime);
  EXPECT_LT(result.wall_ms, 5000.0);
}

TEST(Outside, PlannerThatWritesTheReferencePlan_IsCountedAndAWrongOneIsNot) {
  const Instance instance = smallest("blocks");
  const auto task = task_of(instance);
  const std::string path = testing::TempDir() + "outside.plan";
  std::ofstream file(path);
  for (const auto& action : instance.reference) file << model::to_string(action) << "\n";
  file.close();
  const Measurement good = measure_outside({"copy", "cp '" + path + "' {plan}", true}, instance, *task, {});
  ASSERT_TRUE(good.solved());
  EXPECT_EQ(good.last().steps, instance.reference.size());
  const Measurement empty = measure_outside({"empty", ": > {plan}", true}, instance, *task, {});
  EXPECT_FALSE(empty.solved());
  EXPECT_THAT(empty.outcome, HasSubstr("wrong plan"));
  EXPECT_EQ(measure_outside({"none", "true", true}, instance, *task, {}).outcome, "none");
}

TEST(CurveSvg, CurveOfTwoPoints_HasALineForThePlannerAndItsEnd) {
  Curve curve{.domain = "blocks",
              .points = {},
              .ours_ended = "size 4: out of time",
              .baseline_ended = "size 2: time"};
  for (const int size : {1, 2}) {
    ScalePoint point;
    point.size = size;
    point.ours.profile.push_back({10.0 * size, 1.0, 3.0, 3});
    point.ours.peak_mb = 20;
    curve.points.push_back(point);
  }
  const std::string svg = to_svg(curve);
  EXPECT_THAT(svg, HasSubstr("size 4: out of time"));
  EXPECT_THAT(svg, HasSubstr("polyline class=\"ours\""));
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
}

}  // namespace
}  // namespace stepwright::bench
