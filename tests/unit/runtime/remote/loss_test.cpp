// A line that is cut, loses answers or lies; a controller that is restarted.

#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

using host::EventKind;
using host::Outcome;
using host::RuntimeState;
using support::step_program;

// Running and past the first barrier, with %QX0.1 driven.
void bring_to_run(Bench& bench) {
  ASSERT_EQ(bench.driver.load(step_program({.steps = 2, .scans_per_step = 5})).outcome, Outcome::Done);
  ASSERT_EQ(bench.driver.start(true).outcome, Outcome::Done);
  ASSERT_EQ(bench.driver.event().kind, EventKind::Started);
  for (int i = 0; i < 2; ++i) bench.driver.acknowledge(bench.driver.event().sequence);
  ASSERT_TRUE(bench.driver.await([&] { return bench.runtime->status().scan > 10; }));
  ASSERT_EQ(bench.plant.output.load(), std::byte{2});
}

TEST(Loss_WhenAnswersAndRequestsGetLost, ThenTheTraceIsTheSame) {
  std::vector<std::uint64_t> traces;
  for (const int faults : {0, 3}) {
    Bench bench;
    bench.driver.load(step_program({.steps = 4, .scans_per_step = 50}));
    bench.driver.start(true);
    bench.driver.event();
    for (int i = 0; i < 3; ++i) {
      bench.world->lose_answers = faults;
      bench.world->lose_requests = faults;
      bench.driver.acknowledge(bench.driver.event().sequence);
    }
    EXPECT_EQ(bench.driver.event().scan, 151u);  // and there it stands
    traces.push_back(bench.runtime->status().trace_hash);
    EXPECT_EQ(bench.runtime->status().detail.find("were repeated") != std::string::npos, faults > 0);
  }
  EXPECT_EQ(traces[0], traces[1]);
}

TEST(Loss_WhenATurnsAnswerGetsLost, ThenNoScanRunsTwice) {
  Bench bench;
  bench.driver.load(step_program({.steps = 2, .scans_per_step = 100}));
  host::Command step;
  step.kind = host::CommandKind::Step;
  bench.driver.run(step);
  bench.driver.start(false);
  bench.world->lose_answers = 20;
  step.count = 30;
  bench.driver.run(step);
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->status().scan == 30; }));
  const std::lock_guard lock(bench.world->mutex);
  EXPECT_EQ(bench.world->board.machine().figures().scan, 30u);
  EXPECT_EQ(bench.world->lose_answers.load(), 0);
}

TEST(Loss_WhenTheLineIsCut, ThenThePlantHasSafeOutputsAndOnlyAStartLeavesTheFault) {
  RemoteConfig config = quick_config();
  config.host.safety.safe_state = host::SafeTable::of_all_causes(
      {{.byte = 0, .mask = 0x80, .mode = scan::SafeMode::Value, .value = 0x80}});
  Bench bench(config);
  bring_to_run(bench);
  bench.world->cut = true;
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("R0141"), std::string::npos) << event.detail;
  EXPECT_EQ(bench.plant.output.load(), std::byte{0x80});  // the cell's matrix
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Fault);
  const host::Completion refused = bench.driver.start(false);
  EXPECT_EQ(refused.outcome, Outcome::Refused);
  ASSERT_FALSE(refused.problems.empty());
  EXPECT_EQ(refused.problems[0].code, "R0141");
  const std::uint64_t scan = bench.runtime->status().scan;

  bench.world->cut = false;
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->contact(); }));
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Fault);
  {
    const std::lock_guard lock(bench.world->mutex);
    EXPECT_EQ(bench.world->board.machine().state(),
              control::State::Stopped);  // it was told when it was found
  }
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);
  const host::StepEvent again = bench.driver.event();
  EXPECT_EQ(again.kind, EventKind::Started);
  EXPECT_GE(again.scan, scan);
  EXPECT_EQ(again.sequence, event.sequence + 1);
}

// The cell has more outputs than the controller's program.
TEST(Loss_WhenTheProgramLacksOutputs, ThenTheyAreInTheirSafeStateAllTheTime) {
  RemoteConfig config = quick_config();
  const auto last = static_cast<std::uint32_t>(config.host.output_bytes - 1);
  for (const scan::SafeCause cause : {scan::SafeCause::Stop, scan::SafeCause::IoLost}) {
    const std::uint8_t value = cause == scan::SafeCause::Stop ? 85 : 86;
    config.host.safety.safe_state.of(cause).outputs = {{last, 0xFF, scan::SafeMode::Value, value}};
  }
  Bench bench(config);
  bring_to_run(bench);
  EXPECT_EQ(bench.plant.last_output.load(), std::byte{85});
  bench.world->cut = true;
  EXPECT_EQ(bench.driver.event().kind, EventKind::Trap);
  EXPECT_EQ(bench.plant.last_output.load(), std::byte{86});
}

TEST(Loss_WhenItIsCutWhileStopped, ThenItIsSaidAndNothingElse) {
  Bench bench;
  bench.driver.load(step_program());
  bench.world->cut = true;
  // On a busy machine it may have been lost before for another reason, and found again. Soon the line cannot
  // be opened again, which has the same code.
  EXPECT_TRUE(bench.driver.await([&] {
    const host::RuntimeStatus status = bench.runtime->status();
    return !bench.runtime->contact() && status.detail.find("R0141") != std::string::npos;
  })) << bench.runtime->status().detail;
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  bench.world->cut = false;
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->contact(); }));
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);
}

TEST(Loss_WhenAnswersAreGarbled, ThenTheLineIsLost) {
  Bench bench;
  bring_to_run(bench);
  bench.world->garble = true;
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("garbled"), std::string::npos) << event.detail;
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
}

TEST(Loss_WhenTheControllerIsRestarted, ThenItIsNoticedAndItsProgramIsStillThere) {
  Bench bench;
  bring_to_run(bench);
  {
    const std::lock_guard lock(bench.world->mutex);
    bench.world->board.reset();
  }
  EXPECT_EQ(bench.driver.event().kind, EventKind::Trap);
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->contact(); }));
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);
  EXPECT_EQ(bench.driver.event().kind, EventKind::Started);
}

TEST(Loss_WhenTheControllerLiesAboutItsScan, ThenItIsNotBelieved) {
  auto world = std::make_shared<support::BoardWorld>();
  auto lie = std::make_shared<std::atomic<bool>>(false);
  world->lie = [lie](std::uint16_t first, std::span<std::uint16_t> words) {
    if (*lie && first == control::outputs::kFirst) words[control::outputs::kScan + 3] += 5;
  };
  Bench bench(quick_config(), world);
  bring_to_run(bench);
  *lie = true;
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("R0143"), std::string::npos) << event.detail;
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
}

TEST(Loss_WhenSomethingElseAnswers, ThenThereIsNoContactAndAReason) {
  auto world = std::make_shared<support::BoardWorld>();
  world->lie = [](std::uint16_t first, std::span<std::uint16_t> words) {
    if (first == control::status::kFirst) words[control::status::kMagicAt] = 0x1234;
  };
  TestPlant plant;
  auto runtime =
      RemoteRuntime::create(quick_config(), std::make_unique<support::FaultyLine>(world), plant, nullptr);
  EXPECT_FALSE((*runtime)->wait_for_controller(std::chrono::milliseconds(50)));
  EXPECT_NE((*runtime)->line_problem().find("R0142"), std::string::npos);
}

TEST(Loss_WhenAnotherVersionAnswers, ThenItIsNamed) {
  auto world = std::make_shared<support::BoardWorld>();
  world->lie = [](std::uint16_t first, std::span<std::uint16_t> words) {
    if (first == control::status::kFirst) words[control::status::kVersionAt] = 9;
  };
  TestPlant plant;
  auto runtime =
      RemoteRuntime::create(quick_config(), std::make_unique<support::FaultyLine>(world), plant, nullptr);
  EXPECT_FALSE((*runtime)->wait_for_controller(std::chrono::milliseconds(50)));
  EXPECT_NE((*runtime)->line_problem().find("version 9"), std::string::npos);
}

TEST(Loss_WhenThePlantDoesNotAnswer, ThenTheControllerIsStopped) {
  Bench bench;
  bring_to_run(bench);
  bench.plant.lost = true;
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_EQ(event.detail, host::kIoLost);
  const std::lock_guard lock(bench.world->mutex);
  EXPECT_EQ(bench.world->board.machine().state(), control::State::Stopped);
}

TEST(Loss_WhenTheGatewayEnds, ThenTheControllerIsStopped) {
  auto world = std::make_shared<support::BoardWorld>();
  {
    Bench bench(quick_config(), world);
    bring_to_run(bench);
  }
  EXPECT_EQ(world->board.machine().state(), control::State::Stopped);
}

}  // namespace
}  // namespace stepwright::remote
