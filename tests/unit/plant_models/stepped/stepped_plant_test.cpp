#include "plant_models/stepped/stepped_plant.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>

#include "tests/support/malloc_guard.h"

namespace stepwright::stepped {
namespace {

using namespace std::chrono_literals;
using core::PlantStatus;

const core::ActuatorId kInflow{0};
const core::SensorId kLevel{0};
const core::SensorId kHigh{1};

SteppedDescription tank() {
  SteppedDescription about{.name = "tank"};
  about.actuators = {{"inflow", core::PortKind::Count, 0.0, 0.001}};  // 1000 counts are 1 m/s
  about.sensors = {{"level", core::PortKind::Count, -1.0, 0.01, "m"}, {"high"}};
  about.values = {{"volume", "l", ""}};
  about.faults = {{"leak", "m/s", ""}};
  return about;
}

StepCommand command(std::vector<std::string> how, std::chrono::milliseconds patience = 60s) {
  how.insert(how.begin(), STEPPED_PEER);
  StepCommand made;
  made.arguments = std::move(how);
  made.patience = patience;
  made.beginning = 120s;
  made.where = {"cell.toml", 4, 1};
  return made;
}

std::unique_ptr<SteppedPlant> started(std::vector<std::string> how = {},
                                      std::chrono::milliseconds patience = 60s) {
  auto plant = std::make_unique<SteppedPlant>(tank(), command(std::move(how), patience));
  const auto done = plant->start();
  EXPECT_TRUE(done) << result::to_string(done.error());
  return plant;
}

result::Diagnostic refusal(const StepCommand& how) {
  SteppedPlant plant(tank(), how);
  auto done = plant.start();
  return done ? result::Diagnostic{} : done.error().front();
}

// What the plant says after it was stepped until it was lost.
std::string loss(std::vector<std::string> how, std::chrono::milliseconds patience = 60s) {
  auto plant = started(std::move(how), patience);
  for (int i = 0; i < 100 && plant->advance(10ms) == PlantStatus::Good; ++i) continue;
  EXPECT_TRUE(plant->failed());
  EXPECT_EQ(plant->advance(10ms), PlantStatus::Failed);
  return plant->trouble();
}

TEST(SteppedPlant, WhenItRuns_ThenTheProcessIsStepped) {
  auto plant = started();
  plant->set_actuator(kInflow, 1000);
  ASSERT_EQ(plant->advance_to(600ms), PlantStatus::Good);
  EXPECT_EQ(plant->now(), 600ms);
  EXPECT_EQ(plant->sensor(kLevel), 160);  // (0.6 + 1) / 0.01
  EXPECT_EQ(plant->sensor(kHigh), 1);
  EXPECT_NEAR(plant->truth(core::TruthId(0)), 6.0, 1e-9);
  EXPECT_NEAR(plant->truth(core::TruthId(1)), 0.6, 1e-9);
  EXPECT_EQ(plant->trouble(), "");
}

TEST(SteppedPlant, WhenTimeIsNotAWholeStep_ThenItStandsAtTheStepBefore) {
  auto plant = started();
  ASSERT_EQ(plant->advance_to(19ms), PlantStatus::Good);
  EXPECT_EQ(plant->now(), 10ms);
  ASSERT_EQ(plant->advance_to(5ms), PlantStatus::Good);
  EXPECT_EQ(plant->now(), 10ms);
}

TEST(SteppedPlant, WhenAQuantityIsBeyondItsCounts_ThenTheyStayAtTheirEnd) {
  auto plant = started();
  plant->set_actuator(kInflow, 32'767);
  ASSERT_EQ(plant->advance_to(20s), PlantStatus::Good);
  EXPECT_EQ(plant->sensor(kLevel), 32'767);
}

TEST(SteppedPlant, WhenAFaultIsThere_ThenTheProcessKnowsItUntilItIsCleared) {
  auto plant = started();
  ASSERT_TRUE(plant->inject_fault("LEAK", -2.0));
  ASSERT_EQ(plant->advance_to(100ms), PlantStatus::Good);
  EXPECT_EQ(plant->sensor(kLevel), 80);
  ASSERT_TRUE(plant->clear_fault("leak"));
  ASSERT_EQ(plant->advance_to(200ms), PlantStatus::Good);
  EXPECT_EQ(plant->sensor(kLevel), 80);
  const auto unknown = plant->inject_fault("leek", 1.0);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().hint, "known: leak");
}

TEST(SteppedPlant, WhenItIsStepped_ThenTheScanTakesNoHeap) {
  auto plant = started();
  const support::GuardCounts before = support::guard_counts();
  plant->set_actuator(kInflow, 5);
  const PlantStatus status = plant->advance_to(50ms);
  EXPECT_EQ(support::guard_counts(), before);
  EXPECT_EQ(status, PlantStatus::Good);
}

TEST(SteppedPlant, WhenNothingWasStarted_ThenItHasItsTerminalsAndNothingMoves) {
  SteppedPlant plant(tank());
  plant.set_actuator(kInflow, 1000);
  EXPECT_EQ(plant.advance_to(1s), PlantStatus::Good);
  EXPECT_EQ(plant.sensor(kLevel), 0);
  EXPECT_EQ(plant.sensors().size(), 2u);
  EXPECT_TRUE(plant.inject_fault("leak", 1.0));
}

TEST(SteppedPlant, WhenTheProcessIsKilledInTheMiddle_ThenOnlyThePlantIsLost) {
  EXPECT_EQ(loss({"crashes", "3"}),
            "the plant is lost at 0.030 s: its process was killed by signal 6 (Aborted)");
}

// The child holds the socket: without its end the plant would count as silent.
TEST(SteppedPlant, WhenTheProcessLeavesAChild_ThenThatEndsWithIt) {
  EXPECT_EQ(loss({"crashes_with_a_child", "3"}),
            "the plant is lost at 0.030 s: its process was killed by signal 6 (Aborted)");
}

TEST(SteppedPlant, WhenTheProcessClosesItsSocketAndGoesOn_ThenThatIsTheReason) {
  auto plant = started({"closes", "2"});
  EXPECT_EQ(plant->advance(20ms), PlantStatus::Failed);
  const std::string reason = "the plant is lost at 0.020 s: it has closed its socket; its process was ended";
  EXPECT_EQ(plant->trouble(), reason);
  EXPECT_EQ(plant->trouble(), reason) << "whoever asks again";
}

TEST(SteppedPlant, WhenTheProcessHangs_ThenTheWaitIsBounded) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(loss({"hangs", "2"}, 200ms),
            "the plant is lost at 0.020 s: no answer to a step within 200 ms; its process was killed");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 200ms);
}

TEST(SteppedPlant, WhenAHangingProcessIgnoresSignals_ThenItIsKilled) {
  auto plant = started({"ignores_signals", "1"}, 200ms);
  EXPECT_EQ(plant->advance(10ms), PlantStatus::Failed);
  EXPECT_NE(plant->trouble().find("was killed"), std::string::npos);
}

TEST(SteppedPlant, WhenTheProcessSaysThatItHasFailed_ThenItsWordsAreTold) {
  EXPECT_EQ(loss({"says_no", "2"}), "the plant is lost at 0.020 s: the pump is dry");
}

TEST(SteppedPlant, WhenASensorIsNoNumber_ThenThePlantIsLostWithItsName) {
  EXPECT_EQ(loss({"no_number", "2"}), "the plant is lost at 0.020 s: 'level' is no finite number");
}

TEST(SteppedPlant, WhenTheProcessAnswersBeforeItsStepIsDone_ThenThePlantIsLost) {
  EXPECT_NE(loss({"answers_early", "2"}).find("before its step was done"), std::string::npos);
}

TEST(SteppedPlant, WhenTheProcessDestroysTheHeader_ThenTheRuntimeGoesOnWithWhatItKnows) {
  auto plant = started({"scribbles", "2"});
  plant->set_actuator(kInflow, 1000);
  EXPECT_EQ(plant->advance_to(500ms), PlantStatus::Good);
  EXPECT_EQ(plant->sensor(kLevel), 150);
}

TEST(SteppedPlant, WhenTheProcessWouldMakeTheAreaSmaller_ThenItCannot) {
  auto plant = started({"shrinks", "1"});
  EXPECT_EQ(plant->advance_to(50ms), PlantStatus::Good);
}

TEST(SteppedPlant, WhenItCannotBeginAtAll_ThenTheStartSaysWhy) {
  const auto ended = refusal(command({"ends_at_once"}));
  EXPECT_EQ(ended.code, "R0153");
  EXPECT_NE(ended.message.find("exit code 7"), std::string::npos);
  EXPECT_EQ(ended.where.line, 4);

  const auto closed = refusal(command({"closes_at_once"}));
  EXPECT_EQ(closed.code, "R0153");
  EXPECT_EQ(closed.message, "the plant was not ready: it has closed its socket; its process was ended");

  const auto refused = refusal(command({"refuses"}));
  EXPECT_EQ(refused.code, "R0155");
  EXPECT_NE(refused.message.find("the water is cut off"), std::string::npos);

  const auto other = refusal(command({"other_version"}));
  EXPECT_EQ(other.code, "R0154");
  EXPECT_NE(other.message.find("version 2"), std::string::npos);

  StepCommand silent = command({"never_ready"});
  silent.beginning = 200ms;
  EXPECT_NE(refusal(silent).message.find("within 200 ms"), std::string::npos);

  StepCommand missing = command({});
  missing.arguments = {"no-such-program"};
  EXPECT_NE(refusal(missing).message.find("no-such-program"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::stepped
