// Programs with several tasks on the real clock, each on its thread: what becomes of them at an online
// change, at a rollback, under a watchdog and in a recording.

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/record/replay.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

using namespace std::chrono_literals;

// Two tasks that count; `slow_body` stands behind the count of the slow one, `more` among the variables.
std::vector<std::byte> two_tasks(const std::string& slow_body, const std::string& more = "") {
  return compiled(R"(
CONFIGURATION c
  VAR_GLOBAL fast_count, slow_count : DINT; out AT %QB0 : USINT; )" +
                  more + R"( END_VAR
  TASK fast(INTERVAL := T#1ms, PRIORITY := 0);
  TASK slow(INTERVAL := T#5ms, PRIORITY := 5);
  PROGRAM pf WITH fast : quick;
  PROGRAM ps WITH slow : heavy;
END_CONFIGURATION
PROGRAM quick
VAR_EXTERNAL fast_count : DINT; out : USINT; END_VAR
fast_count := fast_count + 1; out := 17;
END_PROGRAM
PROGRAM heavy
VAR_EXTERNAL slow_count : DINT; END_VAR
VAR zero : DINT; END_VAR
slow_count := slow_count + 1;
)" + slow_body + "\nEND_PROGRAM\n");
}

class RealTimeTasks {
 public:
  explicit RealTimeTasks(const std::vector<std::byte>& container, const HostConfig& config = real_time())
      : info_(*reader::ProgramInfo::read(container)), harness(config, false) {
    EXPECT_EQ(harness.load(container, "first"), Outcome::Done);
    EXPECT_EQ(harness.start(), Outcome::Done);
    EXPECT_EQ(harness.event().kind, EventKind::Started);
  }

  double value(const char* name, const std::vector<std::byte>& image) const {
    return reader::read_number(*info_.find(name), image);
  }
  std::uint64_t cycles(std::size_t task) const {
    const RuntimeStatus status = harness.runtime->status();
    return task < status.tasks.size() ? status.tasks[task].cycles : 0;
  }
  // Waits until the slow task was measured so often; its figures come every 0.1 s.
  bool slow_ran(std::uint64_t times) {
    return harness.wait([&] { return cycles(1) >= times; });
  }

 private:
  reader::ProgramInfo info_;

 public:
  Harness harness;
};

TEST(TaskThreadsChange, WhenAProgramChanges_ThenTheTasksOfEveryThreadGoOnWithTheirValues) {
  RealTimeTasks tasks(two_tasks(""));
  ASSERT_TRUE(tasks.slow_ran(20));
  const std::vector<std::byte> next = two_tasks("slow_count := slow_count + 1000;", "more : LINT;");
  ASSERT_EQ(tasks.harness.change(next, "second").outcome, Outcome::Done);
  const StepEvent changed = tasks.harness.event();
  EXPECT_EQ(changed.kind, EventKind::Changed);
  const double slow_before = tasks.value("slow_count", changed.image);
  EXPECT_GE(slow_before, 20.0);
  EXPECT_EQ(tasks.value("fast_count", changed.image), static_cast<double>(changed.scan));
  ASSERT_TRUE(tasks.slow_ran(20)) << "the slow task of the new program runs";
  EXPECT_EQ(tasks.harness.runtime->status().state, RuntimeState::Running);
  tasks.harness.stop();
  const StepEvent stopped = tasks.harness.event();
  EXPECT_EQ(stopped.kind, EventKind::Stopped);
  // The new slow task counted in steps of 1001 from where the old one stood.
  const auto info = *reader::ProgramInfo::read(next);
  const auto slow_after =
      static_cast<std::int64_t>(reader::read_number(*info.find("slow_count"), stopped.image) - slow_before);
  EXPECT_GE(slow_after, 20 * 1001);  // that many it was waited for
  EXPECT_EQ(slow_after % 1001, 0);
}

TEST(TaskThreadsChange, WhenATaskOfAThreadTrapsOnTrial_ThenTheOldProgramGoesOn) {
  HostConfig config = real_time();
  config.change_trial_scans = 1'000;
  RealTimeTasks tasks(two_tasks(""), config);
  ASSERT_TRUE(tasks.slow_ran(5));
  const std::vector<std::byte> next = two_tasks("slow_count := slow_count / zero;");
  ASSERT_EQ(tasks.harness.change(next, "second").outcome, Outcome::Done);
  EXPECT_EQ(tasks.harness.event().kind, EventKind::Changed);
  const StepEvent back = tasks.harness.event();
  EXPECT_EQ(back.kind, EventKind::RolledBack);
  EXPECT_NE(back.detail.find("second trapped"), std::string::npos) << back.detail;
  EXPECT_EQ(tasks.harness.driver.output.load(), 17);
  const std::uint64_t cycles = tasks.cycles(1);
  EXPECT_TRUE(tasks.slow_ran(cycles + 20)) << "the old slow task is at work again";
  const RuntimeStatus status = tasks.harness.runtime->status();
  EXPECT_EQ(status.state, RuntimeState::Running);
  EXPECT_EQ(status.program_digest, "first");
}

TEST(TaskThreadsChange, WhenChangedAgainAndAgain_ThenEveryProgramsThreadsComeAndGo) {
  RealTimeTasks tasks(two_tasks(""));
  for (int i = 0; i < 60; ++i) {
    const auto next = two_tasks("zero := " + std::to_string(i) + ";");
    ASSERT_EQ(tasks.harness.change(next, std::to_string(i)).outcome, Outcome::Done) << i;
    ASSERT_EQ(tasks.harness.event().kind, EventKind::Changed);
    if (i % 5 == 0) std::this_thread::sleep_for(3ms);
  }
  EXPECT_EQ(tasks.harness.runtime->status().state, RuntimeState::Running);
}

TEST(TaskThreadsWatchdog, WhenATaskOfAThreadNeverEnds_ThenItsWatchdogEndsIt) {
  for (const EngineKind engine : {EngineKind::Auto, EngineKind::Vm}) {
    HostConfig config = real_time();
    config.engine = engine;
    config.safety.watchdogs = {{"SLOW", {.time_ns = 20'000'000, .sensitivity = 1}}};
    config.safety.monitor_ns = 5'000'000;
    RealTimeTasks tasks(
        two_tasks("IF slow_count > 10 THEN WHILE TRUE DO zero := zero + 1; END_WHILE; END_IF;"), config);
    const StepEvent event = tasks.harness.event();
    EXPECT_EQ(event.kind, EventKind::Trap);
    EXPECT_NE(event.detail.find("R0041"), std::string::npos) << event.detail;
    EXPECT_EQ(tasks.harness.driver.output.load(), 0);
    EXPECT_TRUE(tasks.harness.wait([&] {
      for (const TaskDetail& task : tasks.harness.runtime->status().task_details)
        if (task.watchdog_expiries == 1)
          return task.watchdog_us == 20'000 && task.execution.counts.back() == 1;
      return false;
    })) << "the status tells of it";
    EXPECT_GE(tasks.value("fast_count", event.image), 50.0) << "the fast task went on meanwhile";
  }
}

TEST(TaskThreadsRecording, WhenTasksHaveThreads_ThenTheReplayOfTheLeadingOneIsEqual) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("task_threads_recording" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "run").string();
  RealTimeTasks tasks(two_tasks(""));
  ASSERT_EQ(tasks.harness.record({.file = file, .keyframe_every = 16}), Outcome::Done);
  ASSERT_TRUE(tasks.slow_ran(tasks.cycles(1) + 40));
  ASSERT_TRUE(tasks.harness.wait([&] { return tasks.harness.runtime->recording().scans > 150; }));
  tasks.harness.stop();
  ASSERT_EQ(tasks.harness.command(CommandKind::RecordEnd), Outcome::Done);
  ASSERT_TRUE(tasks.harness.wait(
      [&] { return tasks.harness.runtime->recording().state == record::RecordingState::Done; }));
  for (const EngineKind engine : {EngineKind::Vm, EngineKind::Native}) {
    record::ReplayOptions options;
    options.engine = [engine](const bytecode::Program& program) { return make_engine(engine, program); };
    const auto report = record::replay(file, options);
    ASSERT_TRUE(report) << result::to_string(report.error());
    EXPECT_FALSE(report->difference);
    EXPECT_GT(report->hashes, 100u);
    EXPECT_TRUE(report->problems.empty()) << result::to_string(report->problems);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace stepwright::host
