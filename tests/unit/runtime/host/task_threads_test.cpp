// Programs with several tasks on the real clock: each task on a thread of its own.

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cmath>
#include <memory>
#include <thread>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/real_time.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

using namespace std::chrono_literals;

// A harness whose variables are read by name from the newest image.
class Tasks {
 public:
  explicit Tasks(const std::string& source, const HostConfig& config = real_time())
      : container_(compiled(source)), info_(*reader::ProgramInfo::read(container_)), harness(config, false) {
    EXPECT_EQ(harness.load(container_), Outcome::Done);
  }

  // Of the snapshot, which is published every few milliseconds.
  double value(const char* name) {
    const reader::Variable* variable = info_.find(name);
    if (variable == nullptr) throw std::runtime_error(std::string("no variable ") + name);
    const auto snapshot = reader_->read();
    return snapshot ? reader::read_number(*variable, snapshot->image) : -1.0;
  }
  void write(const char* name, std::uint64_t value, std::uint64_t mask = 1) {
    ASSERT_EQ(harness.bits(CommandKind::Write, {info_.find(name)->address, mask, value}), Outcome::Done);
  }
  TaskStatus task(std::size_t index) { return harness.runtime->status().tasks.at(index); }
  bool wait_for(const char* name, double at_least) {
    return harness.wait([&] { return value(name) >= at_least; });
  }

 private:
  std::vector<std::byte> container_;
  reader::ProgramInfo info_;

 public:
  Harness harness;

 private:
  std::unique_ptr<SnapshotReader> reader_ =
      std::move(*SnapshotReader::open(harness.runtime->snapshot_descriptor()));
};

// The slow task computes for much longer than the fast one's interval, and looks at a value of the fast one
// at its beginning and at its end.
constexpr const char* kFastAndSlow = R"(
CONFIGURATION c
  VAR_GLOBAL fast_count, slow_count, torn, steps : DINT; a : BOOL; b : BOOL;
    bit_fast AT %QX0.0 : BOOL; bit_slow AT %QX0.1 : BOOL; END_VAR
  TASK fast(INTERVAL := T#1ms, PRIORITY := 0);
  TASK slow(INTERVAL := T#10ms, PRIORITY := 5);
  PROGRAM pf WITH fast : quick;
  PROGRAM ps WITH slow : heavy;
END_CONFIGURATION
PROGRAM quick
VAR_EXTERNAL fast_count : DINT; a : BOOL; b : BOOL; bit_fast : BOOL; END_VAR
fast_count := fast_count + 1;
a := NOT a; b := a; bit_fast := TRUE;
END_PROGRAM
PROGRAM heavy
VAR_EXTERNAL fast_count, slow_count, torn, steps : DINT; a : BOOL; b : BOOL; bit_slow : BOOL; END_VAR
VAR i, before : DINT; x : LREAL; END_VAR
before := fast_count;
IF a <> b THEN torn := torn + 1; END_IF;
FOR i := 1 TO 600000 DO x := x * 0.5 + 1.0; END_FOR;
IF before <> fast_count THEN torn := torn + 1; END_IF;
slow_count := slow_count + 1; bit_slow := TRUE;
END_PROGRAM
)";

TEST(TaskThreads, WhenASlowTaskComputes_ThenTheFastOneGoesOnAndEachSeesAConsistentImage) {
  HostConfig config = real_time();
  config.engine = EngineKind::Vm;  // 20 to 30 ms for the slow task
  Tasks tasks(kFastAndSlow, config);
  tasks.harness.start();
  ASSERT_TRUE(tasks.wait_for("slow_count", 10));
  tasks.harness.stop();
  EXPECT_EQ(tasks.value("torn"), 0);
  EXPECT_EQ(tasks.harness.driver.output.load(), 0) << "stopped: safe";
  // One after the other, the fast task would come at most once or twice for each time of the slow one.
  EXPECT_GT(tasks.value("fast_count"), 3 * tasks.value("slow_count"));
}

TEST(TaskThreads, WhenTasksDriveBitsOfOneByte_ThenBothReachTheOutputs) {
  Tasks tasks(kFastAndSlow);
  tasks.harness.start();
  EXPECT_TRUE(tasks.harness.wait([&] { return tasks.harness.driver.output.load() == 3; }));
}

TEST(TaskThreads, WhenTasksRun_ThenTheStatusSaysHowPunctualEachIs) {
  Tasks tasks(kFastAndSlow);
  tasks.harness.start();
  ASSERT_TRUE(tasks.harness.wait([&] { return tasks.task(0).cycles > 300 && tasks.task(1).cycles > 20; }));
  const TaskStatus fast = tasks.task(0), slow = tasks.task(1);
  EXPECT_EQ(fast.name, "fast");
  EXPECT_EQ(fast.interval_us, 1'000u);
  EXPECT_EQ(slow.name, "slow");
  EXPECT_EQ(slow.priority, 5u);
  for (const TaskStatus& task : {fast, slow}) {
    EXPECT_GT(task.latency.max_us, 0.0);
    EXPECT_GE(task.latency.p9999_us, task.latency.p50_us);
    EXPECT_GE(task.execution.max_us, task.execution.p9999_us);
    EXPECT_GT(task.jitter.max_us, 0.0);
  }
  EXPECT_GT(slow.execution.p50_us, fast.execution.p50_us);
}

constexpr const char* kEvents = R"(
CONFIGURATION c
  VAR_GLOBAL go : BOOL; events, both, ticks : DINT; END_VAR
  TASK tick(INTERVAL := T#1ms, PRIORITY := 2);
  TASK event(SINGLE := go, PRIORITY := 0);
  PROGRAM pt WITH tick : ticker;
  PROGRAM pe WITH event : on_event;
END_CONFIGURATION
PROGRAM ticker
VAR_EXTERNAL ticks : DINT; END_VAR
ticks := ticks + 1;
END_PROGRAM
PROGRAM on_event
VAR_EXTERNAL events : DINT; END_VAR
events := events + 1;
END_PROGRAM
)";

TEST(TaskThreads, WhenATriggerRises_ThenItsTaskRunsOncePerEdge) {
  Tasks tasks(kEvents);
  tasks.harness.start();
  for (int edge = 1; edge <= 20; ++edge) {
    tasks.write("go", 1);
    ASSERT_TRUE(tasks.wait_for("events", edge));
    const double ticks = tasks.value("ticks");
    ASSERT_TRUE(tasks.wait_for("ticks", ticks + 3));
    tasks.write("go", 0);
    ASSERT_TRUE(tasks.wait_for("ticks", tasks.value("ticks") + 3));
    EXPECT_EQ(tasks.value("events"), edge) << "while the trigger stays there is no further edge";
  }
}

constexpr const char* kFreewheeling = R"(
CONFIGURATION c
  VAR_GLOBAL ticks, rounds : DINT; END_VAR
  TASK tick(INTERVAL := T#10ms, PRIORITY := 0);
  PROGRAM pt WITH tick : ticker;
  PROGRAM pb : background;
END_CONFIGURATION
PROGRAM ticker
VAR_EXTERNAL ticks : DINT; END_VAR
ticks := ticks + 1;
END_PROGRAM
PROGRAM background
VAR_EXTERNAL rounds : DINT; END_VAR
rounds := rounds + 1;
END_PROGRAM
)";

TEST(TaskThreads, WhenAProgramHasNoTask_ThenItRunsAgainAsSoonAsItHasEnded) {
  Tasks tasks(kFreewheeling);
  tasks.harness.start();
  ASSERT_TRUE(tasks.wait_for("ticks", 20));
  EXPECT_GT(tasks.value("rounds"), 2 * tasks.value("ticks"));
  EXPECT_EQ(tasks.task(1).latency.max_us, 0.0) << "it is never due";
}

constexpr const char* kOnlyFreewheeling = R"(
CONFIGURATION c
  VAR_GLOBAL rounds : DINT; END_VAR
  PROGRAM pb : background;
END_CONFIGURATION
PROGRAM background
VAR_EXTERNAL rounds : DINT; END_VAR
rounds := rounds + 1;
END_PROGRAM
)";

TEST(TaskThreads, WhenTheOnlyTaskIsFreewheeling_ThenTheScanThreadRunsIt) {
  Tasks tasks(kOnlyFreewheeling);
  tasks.harness.start();
  EXPECT_TRUE(tasks.wait_for("rounds", 100));
  EXPECT_EQ(tasks.harness.runtime->status().overruns, 0u);
}

// How the scan thread is scheduled, as its newest scan saw it.
class ScanScheduling {
 public:
  explicit ScanScheduling(Tasks& tasks) : tasks_(tasks) {
    // The driver keeps it for longer than this object lasts.
    tasks.harness.driver.intervene([seen = seen_](std::int64_t) {
      int policy = -1;
      sched_param parameters{};
      pthread_getschedparam(pthread_self(), &policy, &parameters);
      seen->store(policy * 1'000 + parameters.sched_priority);
    });
  }
  bool comes_to(int policy, int priority) {
    return tasks_.harness.wait([&] { return seen_->load() == policy * 1'000 + priority; });
  }

 private:
  Tasks& tasks_;
  std::shared_ptr<std::atomic<int>> seen_ = std::make_shared<std::atomic<int>>(-1);
};

// Whether this process may have real-time priorities at all.
bool may_be_urgent() {
  bool may = false;
  std::thread([&] { may = place_thread({}).empty(); }).join();
  return may;
}

TEST(TaskThreads, WhenAFreewheelingTaskLeads_ThenItHasOrdinaryPriority) {
  if (!may_be_urgent()) GTEST_SKIP() << "no real-time priorities here";
  Tasks tasks(kOnlyFreewheeling);
  ScanScheduling scheduling(tasks);
  tasks.harness.start();
  EXPECT_TRUE(scheduling.comes_to(SCHED_OTHER, 0));
  // The next program's task is urgent again.
  ASSERT_EQ(tasks.harness.load(compiled(kFreewheeling), "cyclic"), Outcome::Done);
  tasks.harness.start();
  EXPECT_TRUE(scheduling.comes_to(SCHED_FIFO, 80));
}

TEST(TaskThreads, WhenAnEventIsMoreUrgentThanTheTaskThatLeads_ThenSoAreTheirThreads) {
  if (!may_be_urgent()) GTEST_SKIP() << "no real-time priorities here";
  Tasks tasks(kEvents);
  ScanScheduling scheduling(tasks);
  tasks.harness.start();
  EXPECT_TRUE(scheduling.comes_to(SCHED_FIFO, 79)) << "the event has 80";
}

constexpr const char* kTrapOfTheSlowTask = R"(
CONFIGURATION c
  VAR_GLOBAL count : DINT; lamp AT %QX0.0 : BOOL; END_VAR
  TASK fast(INTERVAL := T#1ms, PRIORITY := 0);
  TASK slow(INTERVAL := T#10ms, PRIORITY := 1);
  PROGRAM pf WITH fast : quick;
  PROGRAM ps WITH slow : faulty;
END_CONFIGURATION
PROGRAM quick
VAR_EXTERNAL lamp : BOOL; END_VAR
lamp := TRUE;
END_PROGRAM
PROGRAM faulty
VAR_EXTERNAL count : DINT; END_VAR
count := count + 1;
IF count > 3 THEN count := count / (count - count); END_IF;
END_PROGRAM
)";

TEST(TaskThreads, WhenATaskOfItsOwnThreadTraps_ThenEverythingStopsAndItSaysWhere) {
  Tasks tasks(kTrapOfTheSlowTask);
  tasks.harness.start();
  EXPECT_EQ(tasks.harness.event().kind, EventKind::Started);
  const StepEvent event = tasks.harness.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("test.st:16"), std::string::npos) << event.detail;
  EXPECT_EQ(tasks.harness.runtime->status().state, RuntimeState::Fault);
  EXPECT_EQ(tasks.harness.driver.output.load(), 0);
  const std::uint64_t cycles = tasks.task(1).cycles;
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(tasks.task(1).cycles, cycles);
  EXPECT_EQ(tasks.harness.start(), Outcome::Done) << "a start leaves the fault";
  EXPECT_EQ(tasks.harness.event().kind, EventKind::Started);
  EXPECT_EQ(tasks.harness.event().kind, EventKind::Trap);
}

TEST(TaskThreads, WhenStoppedAndStartedOften_ThenEveryStartIsFromTheInitialValues) {
  Tasks tasks(kFastAndSlow);
  for (int round = 0; round < 50; ++round) {
    ASSERT_EQ(tasks.harness.start(), Outcome::Done);
    if (round % 10 == 0) std::this_thread::sleep_for(15ms);
    ASSERT_EQ(tasks.harness.stop(), Outcome::Done);
    EXPECT_EQ(tasks.value("torn"), 0);
  }
}

constexpr const char* kOneTask = R"(
CONFIGURATION c
  VAR_GLOBAL count : DINT; END_VAR
  TASK t(INTERVAL := T#100ms, PRIORITY := 0);
  PROGRAM p WITH t : counter;
END_CONFIGURATION
PROGRAM counter
VAR_EXTERNAL count : DINT; END_VAR
count := count + 1;
END_PROGRAM
)";

// Holds up one read of the inputs for ten intervals, while the program runs: for so long that what the
// machine adds to it is little.
void hold_up(Tasks& tasks) {
  // The driver keeps it for longer than this function lasts.
  const auto reads = std::make_shared<std::atomic<int>>(0);
  tasks.harness.start();
  tasks.harness.driver.intervene([reads](std::int64_t) {
    if (reads->fetch_add(1) == 3) std::this_thread::sleep_for(1s);
  });
  EXPECT_TRUE(tasks.harness.wait([&] {
    const RuntimeStatus status = tasks.harness.runtime->status();
    const bool counted = status.overruns >= 8 && status.tasks.at(0).overruns >= 8;
    return status.state == RuntimeState::Fault || (reads->load() > 8 && counted);
  }));
}

TEST(OverrunPolicy, WhenScansAreSkipped_ThenTheyAreCountedAndLeftOut) {
  Tasks tasks(kOneTask);
  hold_up(tasks);
  const TaskStatus task = tasks.task(0);
  EXPECT_GE(task.overruns, 8u);
  EXPECT_GE(task.skipped, 8u);
  EXPECT_GE(tasks.harness.runtime->status().overruns, 8u);
}

TEST(OverrunPolicy, WhenScansAreCaughtUp_ThenNoneIsLeftOut) {
  HostConfig config = real_time();
  config.tasks.push_back({.name = "T", .overrun = scan::OverrunPolicy::CatchUp});
  Tasks tasks(kOneTask, config);
  hold_up(tasks);
  EXPECT_GE(tasks.task(0).overruns, 8u);
  EXPECT_EQ(tasks.task(0).skipped, 0u);
}

TEST(OverrunPolicy, WhenItIsAFault_ThenTheProgramEndsAndSaysWhy) {
  HostConfig config = real_time();
  config.tasks.push_back({.name = "t", .overrun = scan::OverrunPolicy::Fault});
  Tasks tasks(kOneTask, config);
  hold_up(tasks);
  EXPECT_EQ(tasks.harness.event().kind, EventKind::Started);
  const StepEvent event = tasks.harness.event();
  EXPECT_EQ(event.kind, EventKind::Trap);
  EXPECT_NE(event.detail.find("was late"), std::string::npos) << event.detail;
  EXPECT_EQ(tasks.harness.runtime->status().state, RuntimeState::Fault);
}

TEST(TaskSettings, WhenTheyNameNoTask_ThenTheStatusSaysSo) {
  HostConfig config = real_time();
  config.tasks.push_back({.name = "tt"});
  Tasks tasks(kOneTask, config);
  EXPECT_NE(tasks.harness.runtime->status().detail.find("no task is called tt"), std::string::npos);
}

TEST(TaskSettings, WhenATaskHasAPhase_ThenSimulatedTimeBeginsThere) {
  HostConfig config;
  config.tasks.push_back({.name = "slow", .phase_ns = 3'000'000});
  Tasks tasks(kFastAndSlow, config);
  tasks.harness.start();
  EXPECT_TRUE(tasks.wait_for("slow_count", 5));
  tasks.harness.stop();
  const double fast = tasks.value("fast_count"), slow = tasks.value("slow_count");
  // At 3 ms, 13 ms, ...; the fast one at 0, 1, ...
  EXPECT_EQ(slow, std::floor((fast - 1 - 3) / 10) + 1);
}

}  // namespace
}  // namespace stepwright::host
