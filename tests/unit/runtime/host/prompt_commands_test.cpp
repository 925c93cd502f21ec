// Commands, faults and the end do not wait for a scan that is far away, nor behind other commands. The
// leading task of these programs is due once an hour: what waited for it would never come.

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>

#include "runtime/bytecode/reader/program_info.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

HostConfig prompt_config() {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.on_lost_supervisor = LostSupervisor::Safe;
  return config;
}

constexpr const char* kHourly = R"(
CONFIGURATION c
  VAR_GLOBAL out AT %QB0 : USINT; spare : USINT; END_VAR
  TASK t(INTERVAL := T#1h, PRIORITY := 0);
  PROGRAM p WITH t : hourly;
END_CONFIGURATION
PROGRAM hourly
VAR_EXTERNAL out : USINT; END_VAR
out := 200;
END_PROGRAM
)";

std::uint32_t address_of(const char* source, const char* variable) {
  const auto container = compiled(source);
  return reader::ProgramInfo::read(container)->find(variable)->address;
}

// Its first scan has been, the next one comes in an hour.
class Hourly {
 public:
  explicit Hourly(const HostConfig& config = prompt_config(), const std::string& source = kHourly)
      : harness(config, false) {
    EXPECT_EQ(harness.load(compiled(source)), Outcome::Done);
    EXPECT_EQ(harness.start(), Outcome::Done);
    EXPECT_EQ(harness.event().kind, EventKind::Started);
    EXPECT_TRUE(harness.wait([this] { return harness.driver.output.load() == 200; }));
  }
  std::uint64_t scan() const { return harness.runtime->status().scan; }

  Harness harness;
};

TEST(PromptCommands, WhenTheNextScanIsFar_ThenAStopIsPerformedWithoutIt) {
  Hourly plant;
  EXPECT_EQ(plant.harness.stop(), Outcome::Done);
  EXPECT_EQ(plant.harness.event().kind, EventKind::Stopped);
  EXPECT_EQ(plant.harness.driver.output.load(), 0);
  EXPECT_EQ(plant.scan(), 1u);
  EXPECT_EQ(plant.harness.start(), Outcome::Done);
}

TEST(PromptCommands, WhenTheNextScanIsFar_ThenEveryOtherCommandIsPerformedWithoutIt) {
  Hourly plant;
  const ImageBits bits{address_of(kHourly, "spare"), 0xFF, 7};
  EXPECT_EQ(plant.harness.bits(CommandKind::Force, bits), Outcome::Done);
  EXPECT_EQ(plant.harness.bits(CommandKind::Unforce, bits), Outcome::Done);
  EXPECT_EQ(plant.harness.block({plant.harness.runtime->status().program_digest, {bits}}), Outcome::Done);
  EXPECT_EQ(std::to_integer<int>(plant.harness.image()[bits.byte_offset]), 7);
  EXPECT_EQ(plant.scan(), 1u);
  EXPECT_EQ(plant.harness.change(compiled(std::string(kHourly) + " ")).outcome, Outcome::Done);
  EXPECT_EQ(plant.scan(), 1u);
  EXPECT_EQ(plant.harness.load(compiled(kHourly)), Outcome::Done);
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Stopped);
}

TEST(PromptCommands, WhenTheSupervisorIsLost_ThenOutputsAreSafeWithoutAScan) {
  Hourly plant;
  EXPECT_EQ(plant.harness.command(CommandKind::SupervisorLost), Outcome::Done);
  EXPECT_EQ(plant.harness.driver.output.load(), 0);
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(plant.scan(), 1u);
}

TEST(PromptCommands, WhenTheRuntimeEnds_ThenItDoesNotWaitForTheScan) {
  Hourly plant;
  plant.harness.runtime.reset();
  EXPECT_EQ(plant.harness.driver.output.load(), 0);
}

TEST(PromptCommands, WhenTheProgramIsStopped_ThenRampsGoOnAtOnceFromWhatWasDriven) {
  HostConfig config = prompt_config();
  config.idle_interval_ns = 1'000'000;
  for (auto& column : config.safety.safe_state.columns)
    column.ramps = {{.byte = 0, .type = scan::RampType::U8, .target = 0, .per_second = 1'000}};
  Hourly plant(config);
  EXPECT_EQ(plant.harness.stop(), Outcome::Done);
  EXPECT_TRUE(plant.harness.wait([&] { return plant.harness.driver.output.load() == 0; }));
  EXPECT_EQ(plant.scan(), 1u);
}

constexpr const char* kFaultyBeside = R"(
CONFIGURATION c
  VAR_GLOBAL out AT %QB0 : USINT; go : BOOL; END_VAR
  TASK t(INTERVAL := T#1h, PRIORITY := 0);
  TASK often(INTERVAL := T#5ms, PRIORITY := 1);
  PROGRAM p WITH t : hourly;
  PROGRAM q WITH often : faulty;
END_CONFIGURATION
PROGRAM hourly
VAR_EXTERNAL out : USINT; END_VAR
out := 200;
END_PROGRAM
PROGRAM faulty
VAR_EXTERNAL go : BOOL; END_VAR
VAR count : DINT; END_VAR
IF go THEN count := 1 / count; END_IF;
END_PROGRAM
)";

TEST(PromptCommands, WhenATaskBesideTheLeadingOneTraps_ThenItIsReportedAndRampsGoOnWithoutAScan) {
  HostConfig config = prompt_config();
  config.idle_interval_ns = 1'000'000;
  for (auto& column : config.safety.safe_state.columns)
    column.ramps = {{.byte = 0, .type = scan::RampType::U8, .target = 10, .per_second = 1'000}};
  Hourly plant(config, kFaultyBeside);
  EXPECT_EQ(plant.harness.bits(CommandKind::Write, {address_of(kFaultyBeside, "go"), 1, 1}), Outcome::Done);
  const StepEvent event = plant.harness.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("test.st:16"), std::string::npos) << event.detail;
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Fault);
  EXPECT_TRUE(plant.harness.wait([&] { return plant.harness.driver.output.load() == 10; }));
  EXPECT_EQ(plant.scan(), 1u);
}

// Holds the scan thread at its inputs until it is let go.
class Gate {
 public:
  void hold() {
    std::unique_lock lock(mutex_);
    if (!closed_) return;
    held_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !closed_; });
  }
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    changed_.wait(lock, [this] { return held_; });
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = false;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  bool held_ = false;
};

constexpr const char* kOften = R"(
CONFIGURATION c
  VAR_GLOBAL out AT %QB0 : USINT; count : DINT; END_VAR
  TASK t(INTERVAL := T#1ms, PRIORITY := 0);
  PROGRAM p WITH t : often;
END_CONFIGURATION
PROGRAM often
VAR_EXTERNAL count : DINT; END_VAR
count := count + 1;
END_PROGRAM
)";

struct Gated {
  Gated() : harness(prompt_config(), false) {
    harness.driver.on_read = [this](std::int64_t) {
      {
        const std::lock_guard lock(mutex);
        seen.insert(harness.driver.output.load());
      }
      gate.hold();
    };
    EXPECT_EQ(harness.load(compiled(kOften)), Outcome::Done);
  }
  ~Gated() { gate.open(); }

  void submit(std::uint64_t ticket, CommandKind kind) {
    Command command;
    command.ticket = ticket;
    command.kind = kind;
    EXPECT_TRUE(harness.runtime->submit(command));
  }
  Completion next() {
    Completion completion;
    EXPECT_TRUE(harness.wait([&] {
      auto came = harness.runtime->take_completion();
      if (came) completion = std::move(*came);
      return came.has_value();
    }));
    return completion;
  }

  Gate gate;
  std::mutex mutex;
  std::set<int> seen;  // what the outputs were when a scan began
  Harness harness;
};

TEST(PromptCommands, WhenAStopComesBehindOtherCommands_ThenItIsPerformedBeforeThem) {
  Gated plant;
  plant.harness.start();
  plant.gate.close();
  const std::uint32_t out = address_of(kOften, "out");
  for (std::uint64_t i = 1; i <= 199; ++i) {
    ASSERT_TRUE(plant.harness.runtime->write(1'000 + i, {"", {{out, 0xFF, i}}}));
  }
  plant.submit(2'000, CommandKind::RecordEnd);
  Command refused;
  refused.kind = CommandKind::RecordEnd;
  EXPECT_FALSE(plant.harness.runtime->submit(refused)) << "there is no room for another";
  plant.submit(3'000, CommandKind::Stop);
  plant.gate.open();
  EXPECT_EQ(plant.next().ticket, 3'000u);
  for (int i = 0; i < 200; ++i) EXPECT_LE(plant.next().ticket, 2'000u);
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Stopped);
}

TEST(PromptCommands, WhenAStopOvertakesAStart_ThenTheStartDoesNotUndoIt) {
  Gated plant;
  plant.gate.close();
  plant.submit(1'001, CommandKind::Start);
  plant.submit(1'002, CommandKind::Stop);
  plant.gate.open();
  const Completion first = plant.next();
  const Completion second = plant.next();
  EXPECT_EQ(first.ticket, 1'002u);
  EXPECT_EQ(second.ticket, 1'001u);
  EXPECT_EQ(second.outcome, Outcome::Overtaken);
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Stopped);
  plant.submit(1'003, CommandKind::Start);
  EXPECT_EQ(plant.next().outcome, Outcome::Done) << "one that comes after it starts";
}

// 200 blocks of 2048 parts take many times the share of a pause between two scans: were they performed in
// one, the outputs would show the last of them only.
TEST(PromptCommands, WhenManyLongCommandsCome_ThenScansGoOnBetweenThem) {
  Gated plant;
  plant.harness.start();
  plant.gate.close();
  BlockWrite block;
  block.program_digest = plant.harness.runtime->status().program_digest;
  const std::uint32_t out = address_of(kOften, "out");
  for (std::uint64_t i = 1; i <= 200; ++i) {
    block.parts.assign(kMaxBlockWrites, {out, 0xFF, i});
    ASSERT_TRUE(plant.harness.runtime->write(1'000 + i, block));
  }
  plant.gate.open();
  for (int i = 0; i < 200; ++i) EXPECT_EQ(plant.next().outcome, Outcome::Done);
  plant.harness.stop();
  const std::lock_guard lock(plant.mutex);
  EXPECT_GE(plant.seen.size(), 5u);
}

}  // namespace
}  // namespace stepwright::host
