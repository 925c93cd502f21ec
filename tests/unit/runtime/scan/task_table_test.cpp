#include "runtime/scan/task_table.h"

#include <gtest/gtest.h>

#include "runtime/scan/task_timing.h"

namespace stepwright::scan {
namespace {

constexpr std::int64_t kMs = 1'000'000;

Task cyclic(OverrunPolicy policy) {
  Task task;
  task.interval_ns = 10 * kMs;
  task.options.overrun = policy;
  task.restart(0);
  return task;
}

TEST(Overrun, WhenATaskIsLateByLessThanItsInterval_ThenNothingIsMissed) {
  for (const OverrunPolicy policy : {OverrunPolicy::Skip, OverrunPolicy::CatchUp, OverrunPolicy::Fault}) {
    Task task = cyclic(policy);
    const Overrun overrun = settle_overrun(task, 10 * kMs - 1);
    EXPECT_EQ(overrun.missed, 0u);
    EXPECT_FALSE(overrun.fault);
    EXPECT_EQ(task.due_ns, 0);
  }
}

TEST(Overrun, WhenCyclesAreSkipped_ThenTheNewestRunsInPhase) {
  Task task = cyclic(OverrunPolicy::Skip);
  task.options.phase_ns = 3 * kMs;
  task.restart(0);
  const Overrun overrun = settle_overrun(task, 47 * kMs);
  EXPECT_EQ(overrun.missed, 4u);
  EXPECT_EQ(overrun.skipped, 4u);
  EXPECT_EQ(task.due_ns, 43 * kMs);
}

TEST(Overrun, WhenCyclesAreCaughtUp_ThenEachMissedOneIsCountedOnceAndNoneIsLeftOut) {
  Task task = cyclic(OverrunPolicy::CatchUp);
  EXPECT_EQ(settle_overrun(task, 35 * kMs).missed, 3u);
  EXPECT_EQ(task.due_ns, 0);
  std::uint64_t missed = 0;
  for (int cycle = 0; cycle < 4; ++cycle) {
    missed += settle_overrun(task, 36 * kMs).missed;
    task.due_ns += task.interval_ns;
  }
  EXPECT_EQ(missed, 0u);
  EXPECT_EQ(task.due_ns, 40 * kMs);
}

TEST(Overrun, WhenThereIsTooMuchToCatchUp_ThenTheOldestAreLeftOut) {
  Task task = cyclic(OverrunPolicy::CatchUp);
  const Overrun overrun = settle_overrun(task, 1'000 * kMs);
  EXPECT_EQ(overrun.missed, 100u);
  EXPECT_EQ(overrun.skipped, 100u - kMaxBacklog);
  EXPECT_EQ(task.due_ns, (100 - kMaxBacklog) * 10 * kMs);
}

TEST(Overrun, WhenThePolicyIsFault_ThenItSaysSo) {
  Task task = cyclic(OverrunPolicy::Fault);
  EXPECT_TRUE(settle_overrun(task, 10 * kMs).fault);
}

TEST(Overrun, WhenATaskHasNoIntervalOrNeverRests_ThenItIsNeverLate) {
  Task event;
  event.restart(0);
  EXPECT_EQ(settle_overrun(event, 1'000 * kMs).missed, 0u);
  Task free = cyclic(OverrunPolicy::Fault);
  free.freewheeling = true;
  EXPECT_EQ(settle_overrun(free, 1'000 * kMs).missed, 0u);
}

TEST(TaskTiming, WhenCyclesAreMeasured_ThenLatencyExecutionAndJitterAreKept) {
  TaskTiming timing;
  timing.cycle({.due_ns = 1'000, .begin_ns = 1'010, .end_ns = 1'050, .interval_ns = 1'000});
  EXPECT_EQ(timing.jitter.count(), 0u) << "one begin has no period";
  timing.cycle({.due_ns = 2'000, .begin_ns = 2'004, .end_ns = 2'024, .interval_ns = 1'000});
  EXPECT_EQ(timing.jitter.max_ns(), 6);
  EXPECT_EQ(timing.latency.max_ns(), 10);
  EXPECT_EQ(timing.execution.max_ns(), 40);
  timing.interrupted();
  timing.cycle({.due_ns = 9'000, .begin_ns = 9'001, .end_ns = 9'002, .interval_ns = 1'000});
  EXPECT_EQ(timing.jitter.count(), 1u) << "the pause is no period";
  timing.cycle({.begin_ns = 9'500, .end_ns = 9'502});
  EXPECT_EQ(timing.latency.count(), 3u) << "an event was never due";
  EXPECT_EQ(timing.cycles, 4u);
}

}  // namespace
}  // namespace stepwright::scan
