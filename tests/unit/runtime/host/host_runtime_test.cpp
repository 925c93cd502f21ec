#include "runtime/host/host_runtime.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

using support::step_program;
using Layout = support::StepProgramLayout;

template <typename T>
T at(const std::vector<std::byte>& image, std::uint32_t address) {
  T value{};
  std::memcpy(&value, image.data() + address, sizeof value);
  return value;
}

TEST(HostRuntime, WhenNothingIsLoaded_ThenItIsEmptyAndRefusesCommands) {
  Harness harness;
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Empty);
  EXPECT_EQ(harness.start(), Outcome::NoProgram);
  EXPECT_EQ(harness.stop(), Outcome::NoProgram);
  EXPECT_EQ(harness.bits(CommandKind::Write, {0, 1, 1}), Outcome::NoProgram);
  EXPECT_TRUE(harness.runtime->program().empty());
}

TEST(HostRuntime, WhenAProgramRuns_ThenEveryStepChangeIsAnEventWithTheImageOfItsScan) {
  Harness harness;
  ASSERT_EQ(harness.load(step_program(), "abc"), Outcome::Done);
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Stopped);
  ASSERT_EQ(harness.start(), Outcome::Done);
  const StepEvent started = harness.event();
  EXPECT_EQ(started.kind, EventKind::Started);
  EXPECT_EQ(started.sequence, 1u);
  for (std::uint32_t step = 0; step < 3; ++step) {
    const StepEvent event = harness.event();
    EXPECT_EQ(event.kind, EventKind::StepChange);
    EXPECT_EQ(event.sequence, step + 2);
    EXPECT_EQ(event.scan, 10u * step + 1);
    EXPECT_EQ(event.time_ns, 100'000'000 * step);
    EXPECT_EQ(event.program_digest, "abc");
    EXPECT_EQ(at<std::int32_t>(event.image, Layout::kCount), static_cast<std::int32_t>(10 * step + 1));
    for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(at<bool>(event.image, Layout::kSteps + k), k == step);
    EXPECT_EQ(at<std::uint8_t>(event.image, 0), 0x5A);
    EXPECT_EQ(event.plant, (std::vector<NamedValue>{{"faults", 0.0}}));
  }
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
  EXPECT_EQ(harness.start(), Outcome::AlreadyRunning);
}

TEST(HostRuntime, WhenABarrierHolds_ThenTheClockStandsUntilTheEventIsAcknowledged) {
  Harness harness;
  harness.load(step_program());
  harness.start(true);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  for (const std::uint64_t scan : {1u, 11u, 21u}) {
    const StepEvent event = harness.event();
    EXPECT_EQ(event.scan, scan);
    EXPECT_EQ(harness.acknowledge(event.sequence - 1), Outcome::Done);  // an older one releases nothing
    const RuntimeStatus status = harness.runtime->status();
    EXPECT_TRUE(status.waiting_for_supervisor);
    EXPECT_EQ(status.scan, scan);
    EXPECT_FALSE(harness.runtime->take_event());
    EXPECT_EQ(harness.acknowledge(event.sequence), Outcome::Done);
  }
  EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan > 100; }));
}

// Runs to the second step, has it replaced by another program there, and gives the hash and scan at its
// second step.
std::pair<std::uint64_t, std::uint64_t> trace_of_two_programs(bool slow_supervisor) {
  Harness harness;
  const auto pause = [&] {
    if (slow_supervisor) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  };
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.acknowledge(harness.event().sequence);
  harness.event();
  pause();
  harness.load(step_program({.steps = 2, .scans_per_step = 7}));
  pause();
  harness.start(true);
  EXPECT_EQ(harness.event().kind, EventKind::Stopped);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  const StepEvent first = harness.event();
  EXPECT_EQ(first.scan, 12u);
  EXPECT_EQ(first.time_ns, 110'000'000);
  pause();
  harness.acknowledge(first.sequence);
  EXPECT_EQ(harness.event().scan, 19u);
  const RuntimeStatus status = harness.runtime->status();
  return {status.trace_hash, status.scan};
}

TEST(HostRuntime, WhenProgramsFollowEachOther_ThenTimeScansAndTraceGoOnWhateverTheSupervisorsSpeed) {
  const auto fast = trace_of_two_programs(false);
  EXPECT_EQ(fast, trace_of_two_programs(true));
  EXPECT_NE(fast.first, 0u);
}

TEST(HostRuntime, WhenStopped_ThenOutputsAreSafeAndTheReasonIsReported) {
  HostConfig config;
  config.safety.safe_state = SafeTable::of_all_causes({{0, 0x80, scan::SafeMode::Value, 0x80}});
  Harness harness(config);
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.event();
  EXPECT_EQ(harness.driver.output, 0x01);
  EXPECT_EQ(harness.stop("enough"), Outcome::Done);
  EXPECT_EQ(harness.driver.output, 0x80);
  const StepEvent stopped = harness.event();
  EXPECT_EQ(stopped.kind, EventKind::Stopped);
  EXPECT_EQ(stopped.detail, "enough");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(harness.runtime->status().detail, "enough");
  EXPECT_EQ(harness.stop(), Outcome::Done);
  EXPECT_FALSE(harness.runtime->take_event());
}

TEST(HostRuntime, WhenTheRuntimeEnds_ThenOutputsAreSafe) {
  Harness harness;
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.event();
  EXPECT_EQ(harness.driver.output, 0x01);
  harness.runtime.reset();
  EXPECT_EQ(harness.driver.output, 0x00);
}

TEST(HostRuntime, WhenTheProgramTraps_ThenItIsInFaultWithThePlaceAndCanBeStartedAgain) {
  Harness harness;
  harness.load(step_program({.steps = 1, .scans_per_step = 5, .trap_at_end = true}));
  harness.start();
  harness.event();
  harness.event();
  const StepEvent trap = harness.event();
  EXPECT_EQ(trap.kind, EventKind::Trap);
  EXPECT_EQ(trap.scan, 6u);
  EXPECT_NE(trap.detail.find("steps.st:2"), std::string::npos) << trap.detail;
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Fault);
  EXPECT_EQ(harness.driver.output, 0x00);
  EXPECT_EQ(harness.start(), Outcome::Done);
  EXPECT_EQ(harness.event().scan, 6u);
  EXPECT_EQ(harness.event().scan, 7u);
}

TEST(HostRuntime, WhenInputOutputIsLost_ThenItIsInFault) {
  Harness harness;
  harness.load(step_program());
  harness.start(true);
  harness.event();
  const StepEvent first = harness.event();
  harness.driver.lost = true;
  harness.acknowledge(first.sequence);
  const StepEvent lost = harness.event();
  EXPECT_EQ(lost.kind, EventKind::Trap);
  EXPECT_EQ(lost.detail, "the I/O driver does not answer");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Fault);
}

TEST(HostRuntime, WhenInputsAreHeld_ThenTheStatusSaysHowOften) {
  Harness harness;
  EXPECT_EQ(harness.runtime->status().detail.find("held"), std::string::npos);
  harness.driver.held = 3;
  EXPECT_NE(harness.runtime->status().detail.find("inputs were held in 3 reads"), std::string::npos);
}

TEST(HostRuntime, WhenTheSupervisorIsLostAndPolicyIsContinue_ThenBarriersNoLongerHold) {
  HostConfig config;
  config.speed = 10'000.0;
  Harness harness(config);
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.event();
  EXPECT_EQ(harness.command(CommandKind::SupervisorLost), Outcome::Done);
  EXPECT_EQ(harness.event().scan, 11u);
  EXPECT_EQ(harness.event().scan, 21u);
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
}

// How long a supervisor is held up by its machine is nothing that a trace may depend on.
TEST(HostRuntime, WhenTheSupervisorIsLostAndTheSimulationHasNoSpeed_ThenTheClockStandsUntilOneIsThere) {
  Harness harness;
  harness.load(step_program());
  harness.start(true);
  harness.event();
  const StepEvent first = harness.event();
  EXPECT_EQ(harness.command(CommandKind::SupervisorLost), Outcome::Done);
  EXPECT_TRUE(harness.runtime->status().waiting_for_supervisor);
  EXPECT_EQ(harness.runtime->status().scan, first.scan);
  Command acknowledge;
  acknowledge.kind = CommandKind::Acknowledge;
  acknowledge.event = first.sequence;
  EXPECT_EQ(harness.command(acknowledge).outcome, Outcome::Done);
  EXPECT_EQ(harness.event().scan, 11u);
  EXPECT_TRUE(harness.runtime->status().waiting_for_supervisor);
  EXPECT_EQ(harness.command(CommandKind::Stop), Outcome::Done);
  EXPECT_EQ(harness.event().kind, EventKind::Stopped);
}

TEST(HostRuntime, WhenTheSupervisorComesBack_ThenBarriersHoldAgain) {
  Harness harness;
  harness.command(CommandKind::SupervisorLost);
  harness.command(CommandKind::SupervisorAlive);
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.event();
  EXPECT_TRUE(harness.runtime->status().waiting_for_supervisor);
}

TEST(HostRuntime, WhenTheSupervisorIsLostAndPolicyIsSafe_ThenTheProgramIsStopped) {
  HostConfig config;
  config.on_lost_supervisor = LostSupervisor::Safe;
  Harness harness(config);
  harness.load(step_program());
  harness.start(true);
  harness.event();
  harness.event();
  harness.command(CommandKind::SupervisorLost);
  const StepEvent stopped = harness.event();
  EXPECT_EQ(stopped.kind, EventKind::Stopped);
  EXPECT_EQ(stopped.detail, "the supervisor was lost");
  EXPECT_EQ(stopped.scan, 1u);
  EXPECT_EQ(harness.driver.output, 0x00);
}

TEST(HostRuntime, WhenAContainerIsRefused_ThenWhatRunsGoesOn) {
  Harness harness;
  harness.load(step_program(), "good");
  harness.start(true);
  harness.event();
  harness.event();
  std::vector<std::byte> damaged = step_program();
  damaged[damaged.size() / 2] ^= std::byte{0x10};
  const Completion refused = harness.download(damaged, "bad");
  EXPECT_EQ(refused.outcome, Outcome::Refused);
  EXPECT_EQ(refused.problems.front().code.substr(0, 1), "B");
  damaged.resize(damaged.size() / 2);
  EXPECT_EQ(harness.download(damaged, "cut").outcome, Outcome::Refused);
  const Completion too_large = harness.download(step_program({.input_bytes = 65}), "large");
  EXPECT_EQ(too_large.outcome, Outcome::Refused);
  EXPECT_EQ(too_large.problems.front().code, "R0080");
  EXPECT_EQ(harness.runtime->status().program_digest, "good");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
  EXPECT_FALSE(harness.runtime->take_event());
}

TEST(HostRuntime, WhenBitsAreForcedAndWritten_ThenTheImageShowsThem) {
  Harness harness;
  harness.load(step_program());
  EXPECT_EQ(harness.bits(CommandKind::Force, {Layout::kOutput, 0x04, 0x04}), Outcome::Done);
  harness.start(true);
  harness.event();
  StepEvent event = harness.event();
  EXPECT_EQ(at<std::uint8_t>(event.image, Layout::kOutput), 0x05);
  EXPECT_EQ(harness.driver.output, 0x05);
  EXPECT_EQ(harness.bits(CommandKind::Unforce, {Layout::kOutput, 0x04, 0}), Outcome::Done);
  EXPECT_EQ(harness.bits(CommandKind::Unforce, {Layout::kOutput, 0x04, 0}), Outcome::NotForced);
  EXPECT_EQ(harness.bits(CommandKind::Write, {Layout::kOutput, 0x04, 0}), Outcome::Done);
  EXPECT_EQ(harness.bits(CommandKind::Write, {Layout::kFree, ~0ull, 0x1122334455667788}), Outcome::Done);
  EXPECT_EQ(harness.bits(CommandKind::Write, {Layout::kFree, 0xFF00, 0}), Outcome::Done);
  harness.acknowledge(event.sequence);
  event = harness.event();
  EXPECT_EQ(at<std::uint8_t>(event.image, Layout::kOutput), 0x02);
  EXPECT_EQ(at<std::uint64_t>(event.image, Layout::kFree), 0x1122334455660088u);
}

TEST(HostRuntime, WhenABlockIsWritten_ThenAllOfItIsThereWithTheAnswer) {
  Harness harness;
  harness.load(step_program());
  const auto reader = *SnapshotReader::open(harness.runtime->snapshot_descriptor());
  for (std::uint64_t round = 1; round <= 200; ++round) {
    const std::uint64_t value = round * 0x0101010101010101;
    ASSERT_EQ(harness.block({"program", {{Layout::kFree, ~0ull, value}, {Layout::kFree, 0xFF, 7}}}),
              Outcome::Done);
    const std::uint64_t expected = (value & ~0xFFull) | 7;
    ASSERT_EQ(at<std::uint64_t>(reader->read()->image, Layout::kFree), expected);
  }
}

TEST(HostRuntime, WhenAPartOfABlockIsRefused_ThenNothingIsWritten) {
  Harness harness;
  EXPECT_EQ(harness.block({"", {{0, 1, 1}}}), Outcome::NoProgram);
  harness.load(step_program());
  const auto before = harness.image();
  const auto size = static_cast<std::uint32_t>(Layout::kSteps + 3);
  EXPECT_EQ(harness.block({"program", {{Layout::kFree, 0xFF, 0x55}, {size, 1, 1}}}), Outcome::OutOfBounds);
  EXPECT_EQ(harness.block({"program", {{Layout::kFree, 0xFF, 0x55}, {0, 0, 1}}}), Outcome::OutOfBounds);
  EXPECT_EQ(harness.block({"other", {{Layout::kFree, 0xFF, 0x55}}}), Outcome::ProgramDiffers);
  EXPECT_EQ(harness.block({"", {{Layout::kFree, 0xFF, 0x55}}}), Outcome::ProgramDiffers);
  EXPECT_EQ(harness.image(), before);
  EXPECT_EQ(harness.block({"program", {{Layout::kFree, 0xFF, 0x55}}}), Outcome::Done);
  EXPECT_NE(harness.image(), before);
}

TEST(HostRuntime, WhenBitsAreOutOfBounds_ThenTheyAreRefused) {
  Harness harness;
  harness.load(step_program());
  const auto size = static_cast<std::uint32_t>(Layout::kSteps + 3);
  const CommandKind kinds[] = {CommandKind::Force, CommandKind::Write, CommandKind::Unforce};
  for (const CommandKind kind : kinds) {
    EXPECT_EQ(harness.bits(kind, {size, 1, 1}), Outcome::OutOfBounds);
    EXPECT_EQ(harness.bits(kind, {size - 1, 0xFFFF, 1}), Outcome::OutOfBounds);
    EXPECT_EQ(harness.bits(kind, {0xFFFFFFFF, 0xFF, 1}), Outcome::OutOfBounds);
    EXPECT_EQ(harness.bits(kind, {0xFFFFFFFF, 1ull << 63, 1}), Outcome::OutOfBounds);
    EXPECT_EQ(harness.bits(kind, {0, 0, 1}), Outcome::OutOfBounds);
    EXPECT_EQ(harness.bits(kind, {size - 1, 0x80, 0}), Outcome::Done);
  }
  EXPECT_EQ(harness.bits(CommandKind::Force, {0, 0x0300, 0}), Outcome::OutOfBounds);
}

TEST(HostRuntime, WhenAFaultIsInjected_ThenThePlantDecides) {
  Harness harness;
  Command fault;
  fault.kind = CommandKind::InjectFault;
  fault.text = FixedText<kMaxReasonBytes>("leak");
  EXPECT_EQ(harness.command(fault).outcome, Outcome::Done);
  fault.text = FixedText<kMaxReasonBytes>("lake");
  const Completion refused = harness.command(fault);
  EXPECT_EQ(refused.outcome, Outcome::PlantRefused);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems.front().code, "C0311");
  Harness without({}, false);
  EXPECT_EQ(without.command(fault).outcome, Outcome::NoPlant);
}

TEST(HostRuntime, WhenAFaultIsScheduled_ThenItHoldsFromTheFirstScanAtItsTime) {
  HostConfig config;
  config.faults = {{105'000'000, "leak", 1.0}, {0, "leak", 1.0}};
  Harness harness(config);
  harness.load(step_program());
  harness.start();
  EXPECT_EQ(harness.event().plant.front().value, 0.0);
  EXPECT_EQ(harness.event().plant.front().value, 1.0);
  EXPECT_EQ(harness.event().plant.front().value, 1.0);  // scan 11 at 100 ms
  EXPECT_EQ(harness.event().plant.front().value, 2.0);
}

TEST(HostRuntime, WhenManyEventsWait_ThenNoneIsLostInSimulatedTime) {
  Harness harness;
  harness.load(step_program({.steps = 1'000, .scans_per_step = 1}));
  harness.start();
  for (std::uint64_t sequence = 1; sequence <= 1'001; ++sequence)
    ASSERT_EQ(harness.event().sequence, sequence);
  EXPECT_EQ(harness.runtime->status().detail, "");
}

// In real time nobody waits for whoever takes the events; why the program stopped is told all the same.
TEST(HostRuntime, WhenEventsAreLost_ThenTheTrapIsNot) {
  HostConfig config;
  config.clock = ClockMode::Real;
  Harness harness(config);
  harness.load(step_program({.steps = 600, .scans_per_step = 1, .trap_at_end = true, .interval_us = 100}));
  ASSERT_EQ(harness.start(), Outcome::Done);
  ASSERT_TRUE(harness.wait([&] { return harness.runtime->status().state == RuntimeState::Fault; }));
  EXPECT_GT(harness.runtime->status().process.lost_events, 0u);
  StepEvent event;
  while (event.kind != EventKind::Trap) {
    auto next = harness.runtime->take_event();
    ASSERT_TRUE(next) << "the trap was lost";
    event = std::move(*next);
  }
  EXPECT_EQ(event.sequence, harness.runtime->status().last_event);
  EXPECT_FALSE(event.detail.empty());
  EXPECT_EQ(harness.runtime->status().process.traps, 1u);
  EXPECT_NE(harness.runtime->status().detail.find(event.detail), std::string::npos);
}

TEST(HostRuntime, WhenATrappedProgramIsLoadedReplacedOrStartedAgain_ThenItsFaultIsToldNoMore) {
  const auto trapping = step_program({.steps = 1, .scans_per_step = 5, .trap_at_end = true});
  for (const char* next : {"the same", "another", "none"}) {
    Harness harness;
    harness.load(trapping);
    harness.start();
    for (int i = 0; i < 3; ++i) harness.event();
    EXPECT_NE(harness.runtime->status().detail.find("steps.st:2"), std::string::npos);
    if (next != std::string("none")) harness.load(next == std::string("another") ? step_program() : trapping);
    if (next == std::string("none")) {
      harness.start();
      harness.event();  // that it has started
    }
    EXPECT_EQ(harness.runtime->status().detail, "") << next;
  }
}

TEST(HostRuntime, WhenASpeedIsSet_ThenSimulatedTimeDoesNotRunAhead) {
  HostConfig config;
  config.speed = 10.0;
  Harness harness(config);
  harness.load(step_program());
  const auto begin = std::chrono::steady_clock::now();
  harness.start();
  harness.event();
  harness.event();
  harness.event();
  const StepEvent last = harness.event();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(wall.count() * 10.0, static_cast<double>(last.time_ns) / 1e9);
}

}  // namespace
}  // namespace stepwright::host
