// The guard's states, with runtimes that are processes of the test and die as it wants.

#include "runtime/io_memory/output_guard.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <functional>

#include "runtime/io_memory/memory_driver.h"
#include "runtime/io_memory/plant_side.h"

namespace stepwright::io_memory {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::uint32_t kOutputs = 8;

// Killed: %QB0 zero, %QB1 hold, %QB2 = 0x33, %QW2 to 0 at 10000 a second; Stop: %QW2 to 1000 at 10000 a
// second.
struct Rules {
  std::vector<scan::SafeOutput> killed = {{1, 0xFF, scan::SafeMode::Hold},
                                          {2, 0xFF, scan::SafeMode::Value, 0x33}};
  std::vector<scan::SafeRamp> down = {{4, scan::RampType::I16, 0, 10'000}};
  std::vector<scan::SafeRamp> up = {{4, scan::RampType::I16, 1'000, 10'000}};
  scan::SafeMatrix matrix() const {
    scan::SafeMatrix matrix;
    matrix[static_cast<std::size_t>(scan::SafeCause::Killed)] = {killed, down};
    matrix[static_cast<std::size_t>(scan::SafeCause::Stop)] = {{}, up};
    return matrix;
  }
};

class OutputGuardTest : public testing::Test {
 protected:
  OutputGuardTest() : name_("guard-" + std::to_string(getpid()) + "-" + std::to_string(++count_)) {
    plant_ = std::move(*PlantSide::open(name_, 8, kOutputs));
  }
  ~OutputGuardTest() override { std::filesystem::remove(area_path(name_)); }

  std::unique_ptr<OutputGuard> guard(std::int64_t timeout_ns = 10'000 * kMs) {
    auto made = OutputGuard::create(name_, 8, kOutputs, rules_.matrix(), {.timeout_ns = timeout_ns});
    EXPECT_TRUE(made) << (made ? "" : result::to_string(made.error()));
    return made ? std::move(*made) : nullptr;
  }

  // A process that drives: %QB0 0x11, %QB1 0x22, %QW2 = 3000; then `rest` with its driver.
  pid_t runtime(const std::function<void(MemoryDriver&)>& rest) {
    const pid_t child = fork();
    if (child != 0) return child;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    {
      MemoryDriver driver(std::move(*IoArea::open(name_, 8, kOutputs)));
      Bytes outputs(kOutputs);
      outputs[0] = std::byte{0x11};
      outputs[1] = std::byte{0x22};
      const std::int16_t word = 3'000;
      std::memcpy(outputs.data() + 4, &word, 2);
      while (plant_->owner() != Owner::Runtime || area_pid() != static_cast<std::uint32_t>(getpid())) {
        driver.write_outputs(0, outputs);
        usleep(500);
      }
      driver.write_outputs(0, outputs);
      rest(driver);
    }
    _exit(0);
  }
  static void live(MemoryDriver& driver) {
    while (true) {
      driver.beat();
      usleep(1'000);
    }
  }

  std::uint32_t area_pid() {
    auto area = IoArea::open(name_, 8, kOutputs);
    return (*area)->header().owner_pid.load();
  }

  bool hidden() { return (*IoArea::open(name_, 8, kOutputs))->header().owner_space.load() == 1; }

  bool turn_until(OutputGuard& guard, const std::function<bool()>& condition) {
    for (int i = 0; i < 6'000; ++i) {
      guard.turn(-1);
      if (condition()) return true;
    }
    return false;
  }
  bool turn_until(OutputGuard& guard, GuardState state) {
    return turn_until(guard, [&] { return guard.state() == state; });
  }

  int byte(std::size_t at) {
    Bytes outputs(kOutputs);
    stamp_ = plant_->read_outputs(outputs).value();
    return std::to_integer<int>(outputs[at]);
  }
  int word() { return byte(4) | byte(5) << 8; }

  std::string name_;
  Rules rules_;
  std::unique_ptr<PlantSide> plant_;
  OutputStamp stamp_;

 private:
  static inline int count_ = 0;
};

void end(pid_t child, int signal) {
  kill(child, signal);
  waitpid(child, nullptr, 0);
}

TEST_F(OutputGuardTest, WhenTheRuntimeIsKilled_ThenTheOutputsTakeTheColumnAndTheRampMoves) {
  const auto guard = this->guard();
  const pid_t child = runtime(live);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  EXPECT_EQ(byte(0), 0x11);
  end(child, SIGKILL);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_EQ(byte(0), 0);
  EXPECT_EQ(byte(1), 0x22);
  EXPECT_EQ(byte(2), 0x33);
  const int first = word();
  EXPECT_LE(first, 3'000);
  EXPECT_GT(first, 0);
  EXPECT_EQ(stamp_.generation, 2u);
  EXPECT_EQ(plant_->owner(), Owner::Guard);
  EXPECT_TRUE(turn_until(*guard, [&] { return word() < first && word() > 0; }) || word() == 0);
  EXPECT_TRUE(turn_until(*guard, [&] { return word() == 0; }));
  EXPECT_FALSE(guard->idle());
}

TEST_F(OutputGuardTest, WhenTheRuntimeIsSilent_ThenItIsKilledBeforeTheGuardDrives) {
  const auto guard = this->guard(200 * kMs);
  const pid_t child = runtime([](MemoryDriver& driver) {
    driver.beat();
    pause();  // a scan that does not come back
  });
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, WNOHANG), child);  // gone already
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST_F(OutputGuardTest, WhenTheRuntimeIsStopped_ThenItIsKilledToo) {
  const auto guard = this->guard(200 * kMs);
  const pid_t child = runtime(live);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  kill(child, SIGSTOP);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), child);
}

TEST_F(OutputGuardTest, WhenTheRuntimeEndsInGoodOrder_ThenTheGuardIsCalm) {
  const auto guard = this->guard();
  EXPECT_TRUE(guard->idle());
  const pid_t child = runtime([](MemoryDriver& driver) {
    for (int i = 0; i < 100; ++i) {
      driver.beat();
      usleep(1'000);
    }
  });
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  ASSERT_TRUE(turn_until(*guard, GuardState::Waiting));
  waitpid(child, nullptr, 0);
  for (int i = 0; i < 20; ++i) guard->turn(-1);
  EXPECT_EQ(guard->state(), GuardState::Waiting);
  EXPECT_TRUE(guard->idle());
  EXPECT_EQ(byte(0), 0x11);  // as the runtime left it
  EXPECT_EQ(stamp_.generation, 1u);
}

TEST_F(OutputGuardTest, WhenTheRuntimeEndsInTheMiddleOfARamp_ThenTheGuardBringsItToItsEnd) {
  const auto guard = this->guard();
  const pid_t child = runtime(
      [](MemoryDriver& driver) { driver.safe(static_cast<std::uint8_t>(scan::SafeCause::Stop), false); });
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  ASSERT_TRUE(turn_until(*guard, GuardState::Waiting));
  EXPECT_EQ(word(), 1'000);
  EXPECT_TRUE(guard->idle());
  EXPECT_EQ(plant_->owner(), Owner::Released);
}

TEST_F(OutputGuardTest, WhenTheGuardIsStartedLate_ThenItFindsWhatWasLost) {
  const pid_t child = runtime(live);
  while (plant_->owner() != Owner::Runtime) usleep(1'000);
  end(child, SIGKILL);
  const auto guard = this->guard();
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_EQ(byte(0), 0);
}

TEST_F(OutputGuardTest, WhenTheGuardIsStartedAgain_ThenTheRampGoesOn) {
  auto first = guard();
  const pid_t child = runtime(live);
  ASSERT_TRUE(turn_until(*first, GuardState::Watching));
  end(child, SIGKILL);
  ASSERT_TRUE(turn_until(*first, GuardState::Driving));
  const int before = word();
  first.reset();
  const auto second = guard();
  ASSERT_TRUE(turn_until(*second, GuardState::Driving));
  EXPECT_LE(word(), before);
  EXPECT_EQ(byte(1), 0x22);
  EXPECT_TRUE(turn_until(*second, [&] { return word() == 0; }));
}

TEST_F(OutputGuardTest, WhenARuntimeComesBack_ThenTheGuardGivesWayAndWatchesIt) {
  const auto guard = this->guard();
  const pid_t first = runtime(live);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  end(first, SIGKILL);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  const pid_t second = runtime(live);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  EXPECT_TRUE(turn_until(*guard, [&] { return byte(0) == 0x11; }));
  EXPECT_EQ(stamp_.generation, 3u);
  for (int i = 0; i < 10; ++i) guard->turn(-1);
  EXPECT_EQ(byte(0), 0x11);  // the guard writes no more
  end(second, SIGKILL);
  EXPECT_TRUE(turn_until(*guard, GuardState::Driving));
}

// A runtime that asked for the lease and died before it had it.
TEST_F(OutputGuardTest, WhenNobodyTakesTheLease_ThenTheGuardTakesItBack) {
  const auto guard = this->guard();
  const pid_t child = runtime(live);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  end(child, SIGKILL);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  (*IoArea::open(name_, 8, kOutputs))->header().wanted_by.store(1);
  ASSERT_TRUE(turn_until(*guard, GuardState::Waiting));
  EXPECT_TRUE(turn_until(*guard, GuardState::Driving));
}

TEST_F(OutputGuardTest, WhenThereIsAGuard_ThenASecondIsRefused) {
  const auto first = guard();
  const auto second = OutputGuard::create(name_, 8, kOutputs, rules_.matrix(), {});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().front().code, "R0045");
}

// In a PID namespace of its own the runtime is process 1: here that is somebody else.
TEST_F(OutputGuardTest, WhenTheRuntimeIsOfAnotherPidNamespace_ThenItAndNoOtherIsWatchedAndKilled) {
  std::array<int, 2> told{};
  ASSERT_EQ(pipe(told.data()), 0);
  const pid_t outer = fork();
  if (outer == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (unshare(CLONE_NEWPID) != 0) _exit(77);
    const pid_t inner = runtime(live);  // returns here only
    [[maybe_unused]] const ssize_t written = write(told[1], &inner, sizeof inner);
    waitpid(inner, nullptr, 0);
    _exit(0);
  }
  close(told[1]);
  pid_t inner = 0;
  if (read(told[0], &inner, sizeof inner) != sizeof inner) {
    waitpid(outer, nullptr, 0);
    GTEST_SKIP() << "no PID namespace can be made here";
  }
  const auto guard = this->guard(200 * kMs);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  EXPECT_EQ(area_pid(), 1u);
  for (int i = 0; i < 20; ++i) guard->turn(-1);
  EXPECT_EQ(guard->state(), GuardState::Watching);
  kill(inner, SIGSTOP);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_EQ(byte(0), 0);
  int status = 0;
  EXPECT_EQ(waitpid(outer, &status, 0), outer);  // it has seen the other one's end
}

// Another user's namespace, say: the lock still tells that it is gone.
TEST_F(OutputGuardTest, WhenTheRuntimeCannotBeSeen_ThenItsLockAndItsHeartbeatTell) {
  const auto guard = this->guard(200 * kMs);
  const pid_t child = runtime([this](MemoryDriver& driver) {
    (*IoArea::open(name_, 8, kOutputs))->header().owner_space.store(1);
    live(driver);
  });
  while (!hidden()) usleep(1'000);
  ASSERT_TRUE(turn_until(*guard, GuardState::Watching));
  kill(child, SIGSTOP);
  ASSERT_TRUE(turn_until(*guard, GuardState::Helpless));
  EXPECT_EQ(byte(0), 0x11);
  end(child, SIGKILL);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_EQ(byte(0), 0);
}

// Garbage in memory that others can write.
TEST_F(OutputGuardTest, WhenTheCauseIsNone_ThenItCountsAsAStop) {
  const auto guard = this->guard();
  const pid_t child = runtime([](MemoryDriver& driver) { driver.safe(200, false); });
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(turn_until(*guard, GuardState::Driving));
  EXPECT_TRUE(turn_until(*guard, [&] { return word() == 1'000; }));
}

}  // namespace
}  // namespace stepwright::io_memory
