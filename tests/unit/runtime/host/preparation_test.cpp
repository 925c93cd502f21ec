// A program is prepared beside the service: commands are answered meanwhile, and a start waits for it.

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "tests/support/scarcity.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

std::vector<std::byte> program_that_drives(int output) {
  return compiled(R"(
CONFIGURATION c
  VAR_GLOBAL out AT %QB0 : USINT; count : DINT; END_VAR
  TASK fast(INTERVAL := T#1ms, PRIORITY := 0);
  TASK slow(INTERVAL := T#5ms, PRIORITY := 5);
  PROGRAM pf WITH fast : quick;
  PROGRAM ps WITH slow : heavy;
END_CONFIGURATION
PROGRAM quick
VAR_EXTERNAL out : USINT; END_VAR
out := )" + std::to_string(output) +
                  R"(;
END_PROGRAM
PROGRAM heavy
VAR_EXTERNAL count : DINT; END_VAR
count := count + 1;
END_PROGRAM
)");
}

// A program runs, and the next one is being prepared until `finish`: whoever starts the thread of its task is
// held there.
class Preparing {
 public:
  Preparing() : harness(real_time(), false) {
    EXPECT_EQ(harness.load(program_that_drives(17), "first"), Outcome::Done);
    EXPECT_EQ(harness.start(), Outcome::Done);
    EXPECT_TRUE(harness.wait([this] { return harness.driver.output.load() == 17; }));
    hook_.emplace([this] { hold(); });
    EXPECT_TRUE(harness.runtime->load(kTicket, program_that_drives(42), "second"));
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(30), [this] { return held_; }));
  }
  ~Preparing() { finish(); }

  void finish() {
    {
      const std::lock_guard lock(mutex_);
      finished_ = true;
    }
    changed_.notify_all();
    hook_.reset();
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
  void submit(std::uint64_t ticket, CommandKind kind) {
    Command command;
    command.ticket = ticket;
    command.kind = kind;
    EXPECT_TRUE(harness.runtime->submit(command));
  }

  static constexpr std::uint64_t kTicket = 1'000;

 private:
  void hold() {
    std::unique_lock lock(mutex_);
    held_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, std::chrono::seconds(30), [this] { return finished_; });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool held_ = false;
  bool finished_ = false;
  std::optional<support::BeforeThreads> hook_;

 public:
  Harness harness;  // last: its threads use the rest
};

TEST(Preparation, WhenAProgramIsBeingPrepared_ThenCommandsAreAnsweredAndWhatRunsGoesOn) {
  Preparing plant;
  const std::uint64_t reads = plant.harness.driver.reads.load();
  EXPECT_TRUE(plant.harness.wait([&] { return plant.harness.driver.reads.load() > reads + 10; }));
  EXPECT_EQ(plant.harness.stop(), Outcome::Done);
  EXPECT_EQ(plant.harness.driver.output.load(), 0);
  EXPECT_EQ(plant.harness.runtime->status().program_digest, "first");
  EXPECT_EQ(plant.harness.runtime->preparing(), 1u);
  plant.finish();
  const Completion loaded = plant.next();
  EXPECT_EQ(loaded.ticket, Preparing::kTicket);
  EXPECT_EQ(loaded.outcome, Outcome::Done);
  EXPECT_EQ(plant.harness.runtime->status().program_digest, "second");
}

TEST(Preparation, WhenAStartComesBehindADownload_ThenItStartsThatProgram) {
  Preparing plant;
  plant.submit(2'000, CommandKind::Start);
  plant.finish();
  EXPECT_EQ(plant.next().ticket, Preparing::kTicket);
  const Completion started = plant.next();
  EXPECT_EQ(started.ticket, 2'000u);
  EXPECT_EQ(started.outcome, Outcome::Done);
  EXPECT_TRUE(plant.harness.wait([&] { return plant.harness.driver.output.load() == 42; }));
}

TEST(Preparation, WhenAStopComesBehindAWaitingStart_ThenNothingStarts) {
  Preparing plant;
  plant.submit(2'000, CommandKind::Start);
  plant.submit(2'001, CommandKind::Stop);
  EXPECT_EQ(plant.next().ticket, 2'001u);
  plant.finish();
  EXPECT_EQ(plant.next().ticket, Preparing::kTicket);
  EXPECT_EQ(plant.next().outcome, Outcome::Overtaken);
  EXPECT_EQ(plant.harness.runtime->status().state, RuntimeState::Stopped);
}

TEST(Preparation, WhenAnotherDownloadIsUnderWay_ThenAnOnlineChangeIsRefused) {
  Preparing plant;
  auto refused = plant.harness.runtime->change(3'000, program_that_drives(43), "third", DownloadMode::Change);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0032");
}

TEST(Preparation, WhenTheRuntimeEndsMeanwhile_ThenOutputsAreSafeFirst) {
  FakeDriver* driver = nullptr;
  Preparing plant;
  driver = &plant.harness.driver;
  std::thread finisher([&] {
    while (driver->output.load() != 0) std::this_thread::yield();
    plant.finish();
  });
  plant.harness.runtime.reset();
  finisher.join();
  EXPECT_EQ(driver->output.load(), 0);
}

}  // namespace
}  // namespace stepwright::host
