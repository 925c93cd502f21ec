// Recordings of a whole runtime: what its scan thread does at its own pace, commands at any moment, and both
// engines when it is replayed.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/record/replay.h"
#include "tests/fuzz/st/extras/ladder.h"
#include "tests/fuzz/st/generator.h"
#include "tests/fuzz/st/st_writer.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

// Every third one plain ST, the others with charts, references, strings, several tasks.
std::vector<std::byte> random_program(std::uint64_t seed) {
  const auto language = seed % 3 == 0 ? st_fuzz::Language::Common : st_fuzz::Language::Whole;
  const auto program = st_fuzz::generate(seed, language);
  const graphic::Project ladder =
      program->ladder ? st_fuzz::random_ladder(program->seed) : graphic::Project{};
  driver::CompileInput input;
  if (program->ladder) input.projects.push_back(&ladder);
  input.texts.push_back({"fuzz.st", st_fuzz::write_st(*program, {})});
  auto output = driver::compile(input);
  EXPECT_TRUE(output) << (output ? "" : result::to_string(output.error()));
  return output ? std::move(output->container) : std::vector<std::byte>();
}

// All bits of a variable, or its one.
ImageBits random_bits(const reader::ProgramInfo& info, std::mt19937_64& random) {
  while (true) {
    const reader::Variable& variable = info.tags()[random() % info.tags().size()].variable;
    if (bytecode::is_string(variable.type)) continue;
    if (variable.bit != bytecode::kNoBit) {
      return {variable.address, std::uint64_t{1} << variable.bit, random()};
    }
    const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
    const std::uint64_t mask = size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << 8 * size) - 1;
    return {variable.address, mask, random() & mask & 0xFF};
  }
}

// A runtime that records into a folder of the test's own.
class RecordingHost : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("recording_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) +
               std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file() const { return (folder_ / "run").string(); }

  Outcome begin(Harness& harness) const { return harness.record({.file = file(), .keyframe_every = 64}); }

  // The same on both engines, up to the trace hash of the runtime when it ended.
  void expect_equal(std::uint64_t trace_hash, std::uint64_t scans) const {
    for (const EngineKind engine : {EngineKind::Vm, EngineKind::Native}) {
      record::ReplayOptions options;
      options.engine = [engine](const bytecode::Program& program) { return make_engine(engine, program); };
      const auto report = record::replay(file(), options);
      ASSERT_TRUE(report) << result::to_string(report.error());
      if (report->difference) {
        std::string what;
        for (const auto& variable : report->difference->variables) {
          what += variable.name + " " + variable.recorded + " " + variable.replayed + "\n";
        }
        ADD_FAILURE() << "scan " << report->difference->scan << " " << report->difference->what << "\n"
                      << what;
      }
      EXPECT_EQ(report->trace_hash, trace_hash);
      EXPECT_EQ(report->last_scan, scans);
      EXPECT_TRUE(report->problems.empty()) << result::to_string(report->problems);
      EXPECT_TRUE(report->ended);
    }
  }

  std::filesystem::path folder_;
};

TEST_F(RecordingHost, WhenItRunsFromStartToEnd_ThenTheReplayHasItsTraceHash) {
  auto harness = std::make_unique<Harness>();
  ASSERT_EQ(begin(*harness), Outcome::Done);
  harness->load(support::step_program({.steps = 5, .scans_per_step = 50}));
  harness->start();
  for (int i = 0; i < 6; ++i) harness->event();
  ASSERT_EQ(harness->stop(), Outcome::Done);
  const RuntimeStatus status = harness->runtime->status();
  harness.reset();
  expect_equal(status.trace_hash, status.scan);
}

TEST_F(RecordingHost, WhenItRunsInRealTime_ThenTheReplayHasItsTraceHash) {
  HostConfig config;
  config.clock = ClockMode::Real;
  auto harness = std::make_unique<Harness>(config);
  std::mt19937 random(5);
  harness->driver.fill = [&](std::span<std::byte> inputs) { inputs[1] = static_cast<std::byte>(random()); };
  harness->load(support::step_program({.steps = 20, .scans_per_step = 10, .interval_us = 1'000}));
  harness->start();
  for (int i = 0; i < 5; ++i) harness->event();
  ASSERT_EQ(begin(*harness), Outcome::Done);  // in the middle
  for (int i = 0; i < 10; ++i) harness->event();
  harness->stop();
  const RuntimeStatus status = harness->runtime->status();
  harness.reset();
  expect_equal(status.trace_hash, status.scan);
}

TEST_F(RecordingHost, WhenProgramsAndCommandsAreRandom_ThenBothEnginesReplayThem) {
  std::uint64_t scans = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto harness = std::make_unique<Harness>();
    std::mt19937_64 random(seed);
    std::mt19937 inputs_random(static_cast<unsigned>(seed));
    harness->driver.fill = [&](std::span<std::byte> inputs) {
      inputs[inputs_random() % 8] = static_cast<std::byte>(inputs_random());
    };
    std::filesystem::remove(file());
    ASSERT_EQ(begin(*harness), Outcome::Done);
    auto container = random_program(seed);
    auto info = reader::ProgramInfo::read(container);
    ASSERT_TRUE(info);
    harness->load(container, "a" + std::to_string(seed));
    harness->start();
    for (int i = 0; i < 60; ++i) {
      switch (random() % 8) {
        case 0:
          harness->stop();
          harness->start();
          break;
        case 1:
          harness->bits(CommandKind::Force, random_bits(*info, random));
          break;
        case 2:
          harness->bits(CommandKind::Unforce, random_bits(*info, random));
          break;
        case 3:
          if (random() % 8 == 0) {
            container = random_program(seed + 1'000);
            info = reader::ProgramInfo::read(container);
            harness->load(container, "b" + std::to_string(seed));
          }
          harness->start();
          break;
        case 4:
          harness->driver.lost = random() % 8 == 0;
          break;
        case 5:
          harness->block({harness->runtime->status().program_digest,
                          {random_bits(*info, random), random_bits(*info, random)}});
          break;
        default:
          harness->bits(CommandKind::Write, random_bits(*info, random));
      }
      while (harness->runtime->take_event()) {
      }
    }
    harness->stop();
    const RuntimeStatus status = harness->runtime->status();
    harness.reset();
    expect_equal(status.trace_hash, status.scan);
    scans += status.scan;
  }
  EXPECT_GT(scans, 1'000u);
  RecordProperty("scans", std::to_string(scans));
}

TEST_F(RecordingHost, WhenTheRingIsSmall_ThenSimulatedTimeWaitsAndNothingIsLost) {
  auto harness = std::make_unique<Harness>();
  ASSERT_EQ(harness->record({.file = file(), .keyframe_every = 1, .ring_bytes = 64u << 10}), Outcome::Done);
  harness->load(support::step_program({.steps = 40, .scans_per_step = 200}));
  harness->start();
  for (int i = 0; i < 40; ++i) harness->event();
  harness->stop();
  const RuntimeStatus status = harness->runtime->status();
  const auto recording = harness->runtime->recording();
  EXPECT_EQ(recording.gaps, 0u);
  harness.reset();
  expect_equal(status.trace_hash, status.scan);
}

TEST_F(RecordingHost, WhenItIsToldToEnd_ThenTheStatusSaysDoneAndAnotherMayBegin) {
  Harness harness;
  EXPECT_EQ(harness.runtime->recording().state, record::RecordingState::Off);
  ASSERT_EQ(begin(harness), Outcome::Done);
  EXPECT_FALSE(harness.runtime->record(99, {.file = file()}));
  EXPECT_EQ(harness.command(CommandKind::RecordEnd), Outcome::Done);
  EXPECT_TRUE(
      harness.wait([&] { return harness.runtime->recording().state == record::RecordingState::Done; }));
  EXPECT_EQ(begin(harness), Outcome::Done);
}

TEST(Stepping, WhenItIsStepped_ThenItStandsAfterEachAndLeavesTheSameTrace) {
  const auto hash_at = [](bool stepped) {
    Harness harness;
    std::mt19937 random(3);
    harness.driver.fill = [&](std::span<std::byte> inputs) { inputs[2] = static_cast<std::byte>(random()); };
    harness.load(support::step_program());
    if (!stepped) {
      Command command;
      command.kind = CommandKind::Step;
      command.count = 45;
      harness.command(command);
      harness.start();
      EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan == 45; }));
      return harness.runtime->status().trace_hash;
    }
    Command command;
    command.kind = CommandKind::Step;
    command.count = 0;
    EXPECT_EQ(harness.command(command).scan, 0u);
    harness.start();
    for (std::uint64_t scan = 0; scan < 45; scan += 5) {
      EXPECT_EQ(harness.runtime->status().scan, scan);
      command.count = 2;
      EXPECT_EQ(harness.command(command).scan, scan + 2);
      EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan == scan + 2; }));
      command.count = 3;
      harness.command(command);
      EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan == scan + 5; }));
    }
    return harness.runtime->status().trace_hash;
  };
  EXPECT_EQ(hash_at(true), hash_at(false));
}

TEST(Stepping, WhenItGoesOn_ThenItRunsFreely) {
  Harness harness;
  harness.load(support::step_program());
  Command command;
  command.kind = CommandKind::Step;
  harness.command(command);
  harness.start();
  EXPECT_EQ(harness.runtime->status().scan, 0u);
  EXPECT_EQ(harness.command(CommandKind::Continue), Outcome::Done);
  EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan > 1'000; }));
}

TEST(Stepping, WhenABarrierHolds_ThenTheStepsThatAreLeftRunAfterIt) {
  Harness harness;
  harness.load(support::step_program());
  Command command;
  command.kind = CommandKind::Step;
  command.count = 15;  // beyond the step change of scan 11
  harness.command(command);
  harness.start(true);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  for (const std::uint64_t scan : {1u, 11u}) {
    const StepEvent event = harness.event();
    EXPECT_EQ(event.scan, scan);
    EXPECT_TRUE(harness.runtime->status().waiting_for_supervisor);
    harness.acknowledge(event.sequence);
  }
  EXPECT_TRUE(harness.wait([&] { return harness.runtime->status().scan == 15; }));
  EXPECT_FALSE(harness.runtime->status().waiting_for_supervisor);
  // A barrier that is released while it stands does not set it off.
  EXPECT_FALSE(harness.runtime->take_event());
  EXPECT_EQ(harness.runtime->status().scan, 15u);
}

TEST(Stepping, WhenTheClockIsReal_ThenItIsRefused) {
  HostConfig config;
  config.clock = ClockMode::Real;
  Harness harness(config);
  harness.load(support::step_program());
  EXPECT_EQ(harness.command(CommandKind::Step), Outcome::NotSimulated);
}

TEST(Forces, WhenTheyChange_ThenTheListIsAsOfTheNewestCompletion) {
  Harness harness;
  EXPECT_TRUE(harness.runtime->forces().places.empty());
  harness.load(support::step_program());
  const ImageBits count{support::StepProgramLayout::kCount, 0xFFFFFFFF, 7};
  const ImageBits output{support::StepProgramLayout::kOutput, 2, 2};
  ASSERT_EQ(harness.bits(CommandKind::Force, count), Outcome::Done);
  ASSERT_EQ(harness.bits(CommandKind::Force, output), Outcome::Done);
  auto forces = harness.runtime->forces().places;
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_EQ(forces[0].value, 7u);
  EXPECT_EQ(forces[0].size, 4);
  EXPECT_EQ(forces[1].bit, 1);
  harness.bits(CommandKind::Unforce, count);
  EXPECT_EQ(harness.runtime->forces().places.size(), 1u);
  harness.start();
  harness.stop();
  EXPECT_EQ(harness.runtime->forces().places.size(), 1u);
  harness.load(support::step_program());
  EXPECT_TRUE(harness.runtime->forces().places.empty());
}

}  // namespace
}  // namespace stepwright::host
