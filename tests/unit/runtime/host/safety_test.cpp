// What the host does about tasks that take too long and threads that do not come back.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "runtime/host/scan_monitor.h"
#include "tests/support/patience.h"
#include "tests/support/test_program.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using std::chrono::milliseconds;

constexpr std::int64_t kMs = 1'000'000;

// MAIN writes 0x0F to %QB0, then loops as long as %IB1 is not zero.
std::vector<std::byte> looping_program() {
  writer::ContainerModel model = support::one_program(4, [](writer::FunctionBuilder& f) {
    f.const_i32(0x0F);
    f.store(MemType::U8, AddressMode::Abs, 4);
    const auto again = f.new_label();
    f.bind(again);
    f.load(MemType::U8, AddressMode::Abs, 1);
    f.const_i32(0);
    f.emit(bytecode::Opcode::NeI32);
    f.jump_if_true(again);
  });
  model.sizes = {4, 4, 0, 4};
  model.tasks[0].calls[0].instance = 8;
  return *writer::write_container(model);
}

// Sets %IB1 when the test says so, and blocks when it says so.
class Driver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !blocked_; });
    inputs[1] = std::byte{loop ? std::uint8_t{1} : std::uint8_t{0}};
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    output.store(std::to_integer<int>(outputs[0]));
    return image::IoStatus::Good;
  }
  void beat() override { beats.fetch_add(1); }

  void block(bool blocked) {
    {
      const std::lock_guard lock(mutex_);
      blocked_ = blocked;
    }
    changed_.notify_all();
  }

  std::atomic<bool> loop{false};
  std::atomic<int> output{-1};
  std::atomic<int> beats{0};

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool blocked_ = false;
};

struct Machine {
  explicit Machine(const HostConfig& config) {
    auto created = HostRuntime::create(config, driver, nullptr);
    EXPECT_TRUE(created);
    runtime = std::move(*created);
    EXPECT_TRUE(runtime->load(1, looping_program(), "program"));
    EXPECT_TRUE(submit(CommandKind::Start));
    EXPECT_TRUE(wait([&] { return driver.output.load() == 0x0F; }));
  }

  bool submit(CommandKind kind) {
    Command command;
    command.kind = kind;
    return runtime->submit(command);
  }

  bool wait(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
    while (std::chrono::steady_clock::now() < deadline) {
      while (runtime->take_completion()) {
      }
      while (auto event = runtime->take_event()) {
        if (event->kind == EventKind::Trap) trap = event->detail;
      }
      if (condition()) return true;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }

  Driver driver;
  std::string trap;
  std::unique_ptr<HostRuntime> runtime;
};

HostConfig real(EngineKind engine) {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.engine = engine;
  config.safety.monitor_ns = kMs;
  return config;
}

TEST(Watchdog, WhenAProgramLoopsForEver_ThenItIsEndedWithinItsTimeInBothEngines) {
  for (const EngineKind engine : {EngineKind::Auto, EngineKind::Vm}) {
    HostConfig config = real(engine);
    config.safety.watchdogs = {{"TASK", {.time_ns = 5 * kMs, .sensitivity = 2}}};  // named "task" there
    Machine machine(config);
    machine.driver.loop = true;
    ASSERT_TRUE(machine.wait([&] { return !machine.trap.empty(); }));
    EXPECT_EQ(machine.runtime->status().state, RuntimeState::Fault);
    EXPECT_EQ(machine.driver.output.load(), 0);
    EXPECT_NE(machine.trap.find("R0041"), std::string::npos) << machine.trap;
    EXPECT_NE(machine.trap.find("of a task with 5000 us x 2"), std::string::npos) << machine.trap;
    EXPECT_TRUE(machine.wait([&] {
      const auto details = machine.runtime->status().task_details;
      return details.size() == 1 && details[0].watchdog_us == 5'000 && details[0].watchdog_sensitivity == 2 &&
             details[0].too_long == 1 && details[0].watchdog_expiries == 1;
    })) << "the status tells of it";
    // The budget alone would have let it run for longer; a busy machine makes the bound generous.
    const auto took = std::stoll(machine.trap.substr(machine.trap.find("expired: ") + 9));
    EXPECT_GE(took, 10'000);
    RecordProperty("took_us", std::to_string(took));
    std::printf("engine %d: ended after %lld us\n", static_cast<int>(engine), took);
  }
}

// Without a watchdog the budget ends the loop.
TEST(Watchdog, WhenThereIsNone_ThenTheBudgetEndsTheLoop) {
  for (const EngineKind engine : {EngineKind::Auto, EngineKind::Vm}) {
    Machine machine(real(engine));
    machine.driver.loop = true;
    ASSERT_TRUE(machine.wait([&] { return !machine.trap.empty(); }));
    EXPECT_NE(machine.trap.find("R04"), std::string::npos) << machine.trap;
    EXPECT_EQ(machine.driver.output.load(), 0);
  }
}

TEST(Monitor, WhenADriverBlocks_ThenTheRuntimeIsNotHealthyAndTheHeartbeatStops) {
  HostConfig config = real(EngineKind::Auto);
  config.safety.stall_ns = 200 * kMs;
  Machine machine(config);
  ASSERT_TRUE(machine.wait([&] { return machine.driver.beats.load() > 2; }));
  ASSERT_TRUE(machine.wait([&] { return machine.runtime->monitor().healthy(); }));
  machine.driver.block(true);
  ASSERT_TRUE(machine.wait([&] { return !machine.runtime->monitor().healthy(); }));
  EXPECT_NE(machine.runtime->status().detail.find("has not come back for"), std::string::npos);
  const int beats = machine.driver.beats.load();
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(machine.driver.beats.load(), beats);
  machine.driver.block(false);
  EXPECT_TRUE(machine.wait([&] { return machine.runtime->monitor().healthy(); }));
  EXPECT_TRUE(machine.wait([&] { return machine.driver.beats.load() > beats; }));
}

TEST(Monitor, WhenNothingRuns_ThenTheRuntimeIsHealthyForEver) {
  for (const ClockMode clock : {ClockMode::Simulated, ClockMode::Real}) {
    HostConfig config = real(EngineKind::Auto);
    config.clock = clock;
    config.safety.stall_ns = 20 * kMs;
    FakeDriver driver;
    auto runtime = HostRuntime::create(config, driver, nullptr);
    ASSERT_TRUE(runtime);
    std::this_thread::sleep_for(milliseconds(100));
    EXPECT_TRUE((*runtime)->monitor().healthy());
  }
}

// The sequence of the calls decides, not the machine: instants are given.
TEST(ThreadLiveness, WhenItIsSilentForTooLong_ThenItSaysForHowLong) {
  MonotonicClock clock;
  ThreadLiveness liveness(100 * kMs);
  EXPECT_EQ(liveness.silent_ns(clock.now_ns() + 1'000'000 * kMs), 0);  // not yet heard of
  liveness.rest_until(1'000 * kMs);
  EXPECT_EQ(liveness.silent_ns(1'100 * kMs), 0);
  EXPECT_EQ(liveness.silent_ns(1'101 * kMs), kMs);
  liveness.begin(2'000 * kMs);
  EXPECT_EQ(liveness.silent_ns(2'100 * kMs), 0);
  liveness.end_if_late(2'000 * kMs);
  EXPECT_FALSE(liveness.interrupt()->asked());
  liveness.end_if_late(2'000 * kMs + 1);
  EXPECT_TRUE(liveness.interrupt()->asked());
  liveness.end();
  EXPECT_FALSE(liveness.interrupt()->asked());
  liveness.begin(scan::TaskWatchdog::kNoLimit);  // the budget ends it
  EXPECT_EQ(liveness.silent_ns(clock.now_ns() + 1'000'000 * kMs), 0);
  liveness.end_if_late(clock.now_ns() + 1'000'000 * kMs);
  EXPECT_FALSE(liveness.interrupt()->asked());
}

TEST(SafeCause, WhenTheSupervisorIsLost_ThenItsColumnHoldsAndStopHasAnother) {
  for (const bool lost : {true, false}) {
    HostConfig config = real(EngineKind::Auto);
    config.on_lost_supervisor = LostSupervisor::Safe;
    config.safety.safe_state.of(scan::SafeCause::SupervisorLost).outputs = {
        {0, 0xFF, scan::SafeMode::Value, 0x11}};
    config.safety.safe_state.of(scan::SafeCause::Stop).outputs = {{0, 0xFF, scan::SafeMode::Hold}};
    Machine machine(config);
    ASSERT_TRUE(machine.submit(lost ? CommandKind::SupervisorLost : CommandKind::Stop));
    ASSERT_TRUE(machine.wait([&] { return machine.runtime->status().state == RuntimeState::Stopped; }));
    EXPECT_EQ(machine.driver.output.load(), lost ? 0x11 : 0x0F);
    // Another program: the outputs stay as they are until it is started.
    ASSERT_TRUE(machine.runtime->load(2, looping_program(), "next"));
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(machine.driver.output.load(), lost ? 0x11 : 0x0F);
  }
}

}  // namespace
}  // namespace stepwright::host
