// Every output of the cell is driven at any time, whatever the program has; and at the end the driver is let
// go before anything waits.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "tests/support/patience.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/runtime/host/change_pair.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

constexpr std::size_t kOutputs = 8;
using Outputs = std::array<std::uint8_t, kOutputs>;

// Has as many outputs as the cell, and remembers the newest. Another runtime may drive them first, and leave
// 20 in %QW1.
class WidePlant final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return image::IoStatus::Good; }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    const std::lock_guard lock(mutex_);
    whole_ = whole_ && outputs.size() == kOutputs;
    std::memcpy(newest_.data(), outputs.data(), std::min(outputs.size(), kOutputs));
    if (std::exchange(first_after_, false)) first_word_ = std::to_integer<int>(outputs[2]);
    return image::IoStatus::Good;
  }
  bool takes_over() override {
    if (!another_drives_ || !another_ended.load()) return false;
    const std::lock_guard lock(mutex_);
    another_drives_ = false;
    first_after_ = true;
    return true;
  }
  bool left_outputs(std::span<std::byte> outputs) override {
    std::ranges::fill(outputs, std::byte{0});
    outputs[2] = std::byte{20};
    return true;
  }
  void release_outputs() override { left.store(true); }
  // Before the runtime is made.
  void another_drives() { another_drives_ = true; }
  // %QW1 of the first write after the other one.
  std::optional<int> first_word() const {
    const std::lock_guard lock(mutex_);
    return first_word_;
  }

  Outputs newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
  }
  bool whole() const {
    const std::lock_guard lock(mutex_);
    return whole_;
  }
  int word(std::size_t at) const {
    const Outputs now = newest();
    return static_cast<std::int16_t>(now[at] | now[at + 1] << 8);
  }

  std::atomic<bool> left{false};
  std::atomic<bool> another_ended{false};

 private:
  std::atomic<bool> another_drives_{false};
  mutable std::mutex mutex_;
  Outputs newest_{};
  bool whole_ = true;
  bool first_after_ = false;
  std::optional<int> first_word_;
};

// %QB5 has 85 after a stop and 86 after a trap, %QB6 is held, %QW1 goes to 100 at 1000 a second.
HostConfig cell(ClockMode clock) {
  HostConfig config;
  config.clock = clock;
  config.output_bytes = kOutputs;
  for (const scan::SafeCause cause : {scan::SafeCause::Stop, scan::SafeCause::Trap}) {
    auto& column = config.safety.safe_state.of(cause);
    const auto value = static_cast<std::uint8_t>(cause == scan::SafeCause::Stop ? 85 : 86);
    column.outputs = {{5, 0xFF, scan::SafeMode::Value, value}, {6, 0xFF, scan::SafeMode::Hold}};
    column.ramps = {{2, scan::RampType::I16, 100, 1'000}};
  }
  return config;
}

std::vector<std::byte> wide(const std::string& more = "") {
  return compiled(
      program_text("VAR a AT %QB0 : USINT; w AT %QW1 : INT; five AT %QB5 : USINT; six AT %QB6 : USINT; "
                   "n, zero : DINT; END_VAR",
                   "a := 1; w := 300; five := 16#AA; six := 6; n := n + 1;" + more));
}
// Has %QB0 only, and fails in its tenth scan if that is wanted.
std::vector<std::byte> narrow(bool fails = false) {
  return compiled(program_text(
      "VAR a AT %QB0 : USINT; n, zero : DINT; END_VAR",
      std::string("a := 2; n := n + 1;") + (fails ? "IF n = 10 THEN n := n / zero; END_IF;" : "")));
}

class AllOutputs : public testing::Test {
 protected:
  void open(HostConfig config) {
    config_ = std::move(config);
    auto created = HostRuntime::create(config_, plant_, nullptr);
    ASSERT_TRUE(created);
    runtime_ = std::move(*created);
  }
  Completion done() {
    std::optional<Completion> completion;
    EXPECT_TRUE(wait([&] { return (completion = runtime_->take_completion()).has_value(); }));
    return completion.value_or(Completion{});
  }
  void load(std::vector<std::byte> program, const std::string& digest) {
    ASSERT_TRUE(runtime_->load(++ticket_, std::move(program), digest));
    ASSERT_EQ(done().outcome, Outcome::Done);
  }
  void command(CommandKind kind) {
    Command command;
    command.kind = kind;
    command.ticket = ++ticket_;
    ASSERT_TRUE(runtime_->submit(command));
    ASSERT_EQ(done().outcome, Outcome::Done);
  }
  bool wait(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
      while (runtime_ != nullptr && runtime_->take_event()) {
      }
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  bool drives(int first, int fifth, int sixth) {
    return wait([&] {
      const Outputs now = plant_.newest();
      return now[0] == first && now[5] == fifth && now[6] == sixth;
    });
  }

  HostConfig config_;
  WidePlant plant_;
  std::unique_ptr<HostRuntime> runtime_;
  std::uint64_t ticket_ = 0;
};

// What this one thought to drive meanwhile nobody has seen.
TEST_F(AllOutputs, WhenAnotherRuntimeLeavesARampOnItsWay_ThenItGoesOnFromWhereItIs) {
  plant_.another_drives();
  open(cell(ClockMode::Real));
  load(wide(), "wide");
  ASSERT_TRUE(wait([&] { return plant_.word(2) == 100; }));
  plant_.another_ended.store(true);
  ASSERT_TRUE(wait([&] { return plant_.first_word().has_value(); }));
  EXPECT_EQ(plant_.first_word(), 20);
  EXPECT_TRUE(wait([&] { return plant_.word(2) == 100; }));
}

TEST_F(AllOutputs, WhenTheNextProgramLacksSome_ThenTheyStayInTheirSafeState) {
  open(cell(ClockMode::Real));
  load(wide(), "wide");
  command(CommandKind::Start);
  ASSERT_TRUE(drives(1, 0xAA, 6));
  command(CommandKind::Stop);
  EXPECT_TRUE(drives(0, 85, 6));
  load(narrow(), "narrow");
  command(CommandKind::Start);
  ASSERT_TRUE(wait([&] { return plant_.newest()[0] == 2; }));
  EXPECT_EQ(plant_.newest()[5], 85);
  EXPECT_EQ(plant_.newest()[6], 6);
  EXPECT_TRUE(wait([&] { return plant_.word(2) == 100; })) << "the ramp goes on while it runs";
  EXPECT_EQ(plant_.newest()[0], 2);
  command(CommandKind::Stop);
  EXPECT_TRUE(drives(0, 85, 6));
  EXPECT_TRUE(plant_.whole());
}

TEST_F(AllOutputs, WhenTheFirstProgramLacksSome_ThenTheyAreSafeFromTheStart) {
  open(cell(ClockMode::Real));
  load(narrow(true), "narrow");
  command(CommandKind::Start);
  EXPECT_TRUE(drives(0, 86, 0)) << "a trap has its own column for them, too";
  EXPECT_TRUE(plant_.whole());
}

TEST_F(AllOutputs, WhenAProgramTakesOverThatLacksSome_ThenTheyAreAsAfterAStop) {
  open(cell(ClockMode::Real));
  load(wide(), "wide");
  command(CommandKind::Start);
  ASSERT_TRUE(drives(1, 0xAA, 6));
  ASSERT_TRUE(runtime_->change(++ticket_, narrow(), "narrow", DownloadMode::Change));
  ASSERT_EQ(done().outcome, Outcome::Done);
  EXPECT_TRUE(drives(2, 85, 6));
  EXPECT_TRUE(wait([&] { return plant_.word(2) == 100; }));
  EXPECT_EQ(runtime_->status().state, RuntimeState::Running);
}

// Step by step, so that nothing runs between the rollback and the stop.
TEST_F(AllOutputs, WhenAStopComesBehindARollback_ThenWhatWasDrivenLastIsHeld) {
  HostConfig config = cell(ClockMode::Simulated);
  config.safety.safe_state.of(scan::SafeCause::Stop).outputs = {{0, 0xFF, scan::SafeMode::Hold}};
  config.safety.safe_state.of(scan::SafeCause::Trap).outputs = {};
  open(config);
  const auto counts = [](const std::string& more) {
    return compiled(program_text("VAR a AT %QB0 : USINT; n, k, zero : DINT; END_VAR", "n := n + 1;" + more));
  };
  const auto step = [&](std::uint32_t count) {
    Command command;
    command.kind = CommandKind::Step;
    command.count = count;
    command.ticket = ++ticket_;
    ASSERT_TRUE(runtime_->submit(command));
    ASSERT_EQ(done().outcome, Outcome::Done);
  };
  load(counts("a := 17;"), "first");
  step(5);
  command(CommandKind::Start);
  ASSERT_TRUE(wait([&] { return runtime_->status().scan == 5; }));
  ASSERT_TRUE(runtime_->change(++ticket_, counts("a := 34; k := k + 1; IF k = 4 THEN n := n / zero; END_IF;"),
                               "bad", DownloadMode::Change));
  ASSERT_EQ(done().outcome, Outcome::Done);
  step(4);
  ASSERT_TRUE(
      wait([&] { return runtime_->status().scan == 9 && runtime_->status().program_digest == "first"; }));
  EXPECT_EQ(plant_.newest()[0], 34);
  command(CommandKind::Stop);
  EXPECT_EQ(plant_.newest()[0], 34);
}

// A disk that does not answer: the writer stands at the file that it makes, a pipe that nobody reads.
TEST_F(AllOutputs, WhenTheDiskIsSlowAtTheEnd_ThenTheOutputsAreReleasedBeforeIt) {
  const support::TemporaryFolder folder;
  HostConfig config = cell(ClockMode::Real);
  config.retain.store = folder / "retain.store";
  const std::string pipe = (folder / "retain.store.new").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  open(config);
  load(compiled(program_text("VAR a AT %QB0 : USINT; END_VAR VAR RETAIN n : DINT; END_VAR",
                             "a := 1; n := n + 1;")),
       "keeps");
  command(CommandKind::Start);
  ASSERT_TRUE(wait([&] { return plant_.newest()[0] == 1; }));
  std::atomic<bool> ended{false};
  std::thread end([&] {
    runtime_.reset();
    ended = true;
  });
  const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
  while (!plant_.left && std::chrono::steady_clock::now() < deadline) usleep(1'000);
  EXPECT_TRUE(plant_.left);
  EXPECT_EQ(plant_.newest()[0], 0);
  EXPECT_FALSE(ended) << "the disk was not slow";
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  end.join();
  close(reader);
}

}  // namespace
}  // namespace stepwright::host
