// Runtime, guard and client (here: the test as the plant), each killed, frozen and restarted: the outputs
// take a safe state, a start alone leaves it, and a guard watches again.

#include <cstdio>

#include "runtime/io_memory/io_area.h"
#include "tests/cells/guard/guarded_cell.h"

namespace stepwright::cells {
namespace {

using io_memory::IoArea;
using io_memory::monotonic_ns;

constexpr std::int64_t kTimeoutNs = 500'000'000;
constexpr const char* kGuard = "[guard]\nenabled = true\ntimeout_ms = 500\n";

class Matrix : public testing::Test {
 protected:
  Matrix()
      : cell_(kGuard), area_(std::move(*IoArea::open(cell_.name(), 8, 8))), runtime_(cell_.start_runtime()) {
    guard_ = guard();
    EXPECT_GT(guard_, 0);
  }
  ~Matrix() override {
    // A guard whose runtime is lost drives until somebody ends it.
    runtime_.kill();
    others_.clear();
    if (cell_.guarded()) ::kill(guard(), SIGKILL);
  }

  pid_t guard() { return static_cast<pid_t>(area_->header().guard_pid.load()); }
  bool guard_watches_again() {
    return cell_.wait([&] { return cell_.guarded() && guard() != guard_; });
  }
  // No heartbeat for longer than the guard's time: whoever looks takes the holder for lost.
  bool silent() {
    return cell_.wait([&] { return cell_.plant->holder_silence_ns() > kTimeoutNs; });
  }
  // From now on no output of the program is written, until the condition holds.
  bool never_driven_until(const std::function<bool()>& condition) {
    const std::int64_t since_ns = monotonic_ns();
    return cell_.wait([&] {
      const int output = cell_.output(0);
      EXPECT_FALSE(output == kRuns && cell_.stamp.time_ns > since_ns) << "driven again by itself";
      return condition();
    });
  }
  // The state is left by a start, and by nothing before it.
  void expect_start_alone_leaves(int column) {
    EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == column; })) << cell_.output(0);
    EXPECT_TRUE(cell_.client->call(service::Start{}, kPatience));
    EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kRuns; })) << cell_.output(0);
  }
  // Another runtime, with the program loaded and not started.
  void bring_up(int column) {
    runtime_.kill();
    TestProcess& next = others_.emplace_back(cell_.start("runtime"));
    ASSERT_TRUE(next.wait_for("listens on")) << next.output();
    cell_.attach();
    EXPECT_EQ(cell_.output(0), column);
    EXPECT_TRUE(cell_.client->download(guarded_program(), kPatience));
  }

  GuardedCell cell_;
  std::unique_ptr<IoArea> area_;
  TestProcess runtime_;
  std::vector<TestProcess> others_;
  pid_t guard_ = -1;
};

TEST_F(Matrix, WhenTheRuntimeIsKilled_ThenSafeUntilAStart) {
  runtime_.kill();
  ASSERT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
  bring_up(kKilled);
  expect_start_alone_leaves(kStop);
}

TEST_F(Matrix, WhenTheRuntimeIsFrozen_ThenTheGuardEndsItAndItIsSafeUntilAStart) {
  runtime_.send(SIGSTOP);
  ASSERT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
  runtime_.send(SIGCONT);
  bring_up(kKilled);
  expect_start_alone_leaves(kStop);
}

TEST_F(Matrix, WhenTheRuntimeIsRestarted_ThenSafeUntilAStart) {
  runtime_.send(SIGTERM);
  EXPECT_EQ(runtime_.wait(), 0);
  ASSERT_TRUE(cell_.wait([&] { return cell_.output(0) == kStop; }));
  bring_up(kStop);
  expect_start_alone_leaves(kStop);
}

TEST_F(Matrix, WhenTheGuardIsKilled_ThenAnotherOneWatchesAndItIsSaid) {
  ::kill(guard_, SIGKILL);
  ASSERT_TRUE(guard_watches_again());
  EXPECT_EQ(cell_.output(0), kRuns);
  EXPECT_TRUE(runtime_.wait_for("the guard is gone")) << runtime_.output();
  EXPECT_TRUE(runtime_.wait_for("another guard watches")) << runtime_.output();
  EXPECT_TRUE(cell_.wait([&] { return cell_.status_says("the guard was lost 1 time, another"); }));
  runtime_.kill();
  EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
}

TEST_F(Matrix, WhenTheGuardIsFrozen_ThenItIsEndedAndAnotherOneWatches) {
  ::kill(guard_, SIGSTOP);
  ASSERT_TRUE(guard_watches_again());
  EXPECT_EQ(cell_.output(0), kRuns);
  EXPECT_TRUE(runtime_.wait_for("the guard stands still")) << runtime_.output();
  runtime_.kill();
  EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
}

TEST_F(Matrix, WhenTheGuardIsRestarted_ThenOneWatches) {
  ::kill(guard_, SIGTERM);
  ASSERT_TRUE(guard_watches_again());
  EXPECT_EQ(cell_.output(0), kRuns);
  runtime_.kill();
  EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
}

// Killed and frozen are the same to those who look: it is not heard of.
TEST_F(Matrix, WhenTheClientIsKilledOrFrozen_ThenSafeUntilAStartAlsoWhenItIsBack) {
  cell_.plant->announce(kTimeoutNs);
  ASSERT_TRUE(cell_.wait([&] { return cell_.output(0) == kLostIo; }));
  cell_.plant->announce(0);
  EXPECT_TRUE(runtime_.wait_for("does not answer"));
  EXPECT_TRUE(cell_.wait([&] { return cell_.client->call(service::Start{}, kPatience).has_value(); }));
  EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kRuns; }));
}

TEST_F(Matrix, WhenTheClientIsRestarted_ThenSafeUntilAStart) {
  cell_.plant->lose(std::vector<std::byte>(8));  // its last word
  cell_.plant->announce(kTimeoutNs, false);
  ASSERT_TRUE(cell_.wait([&] { return cell_.output(0) == kLostIo; }));
  cell_.plant.reset();
  cell_.plant = std::move(*io_memory::PlantSide::open(cell_.name(), 8, 8));
  cell_.plant->announce(0);
  expect_start_alone_leaves(kLostIo);
}

TEST_F(Matrix, WhenRuntimeAndGuardAreKilled_ThenTheNextOfThemMakesItSafe) {
  ::kill(guard_, SIGSTOP);
  runtime_.kill();
  ::kill(guard_, SIGKILL);
  ASSERT_TRUE(cell_.wait([&] { return !cell_.guarded(); }));
  TestProcess& next = others_.emplace_back(cell_.start("runtime"));
  ASSERT_TRUE(next.wait_for("listens on")) << next.output();
  EXPECT_TRUE(cell_.wait([&] { return cell_.output(0) == kKilled; }));
}

// The whole machine, say: nobody has noticed but the clock.
TEST_F(Matrix, WhenRuntimeAndGuardAreFrozen_ThenTheRuntimeItselfTakesTheSafeStateUntilAStart) {
  for (const bool guard_first : {true, false}) {
    ::kill(guard_, SIGSTOP);
    runtime_.send(SIGSTOP);
    ASSERT_TRUE(silent());
    if (guard_first) ::kill(guard_, SIGCONT);
    runtime_.send(SIGCONT);
    if (!guard_first) ::kill(guard_, SIGCONT);
    ASSERT_TRUE(never_driven_until([&] { return cell_.output(0) == kKilled; }));
    EXPECT_TRUE(runtime_.wait_for("the runtime stood still")) << runtime_.output();
    EXPECT_TRUE(cell_.wait([&] { return cell_.status_says("the runtime stood still"); }));
    expect_start_alone_leaves(kKilled);
  }
}

TEST_F(Matrix, WhenAllThreeAreFrozen_ThenSafeUntilAStart) {
  cell_.plant->announce(kTimeoutNs);
  ASSERT_TRUE(cell_.wait([&] {
    cell_.plant->beat();
    return cell_.output(0) == kRuns;
  }));
  ::kill(guard_, SIGSTOP);
  runtime_.send(SIGSTOP);
  ASSERT_TRUE(silent());
  cell_.plant->beat();  // the client is the first that goes on
  ::kill(guard_, SIGCONT);
  runtime_.send(SIGCONT);
  ASSERT_TRUE(never_driven_until([&] {
    cell_.plant->beat();
    return cell_.output(0) == kKilled;
  }));
  cell_.plant->announce(0);
  expect_start_alone_leaves(kKilled);
}

}  // namespace
}  // namespace stepwright::cells
