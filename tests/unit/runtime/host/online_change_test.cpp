// Online change through the threads of a runtime: events, refusals, trial and rollback.

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "tests/support/malloc_guard.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/host/change_pair.h"
#include "tests/unit/runtime/host/harness.h"

namespace stepwright::host {
namespace {

// Counts scans; drives %QB0 with 17. `more` stands before the end.
std::string counting(const std::string& declarations = "", const std::string& more = "") {
  return program_text("VAR n : DINT; out AT %QB0 : USINT; END_VAR\n" + declarations,
                      "n := n + 1; out := 17;\n" + more);
}

double number(const StepEvent& event, const std::vector<std::byte>& container, const std::string& path) {
  const auto info = reader::ProgramInfo::read(container);
  const reader::Variable* variable = info->find(path);
  if (variable == nullptr) throw std::runtime_error("no variable " + path);
  return reader::read_number(*variable, event.image);
}

// A runtime with real time of 1 ms that runs `container`; its Started event is taken.
class Running {
 public:
  explicit Running(const std::string& text, HostConfig config = {}) : harness(config) {
    EXPECT_EQ(harness.load(compiled(text), "first"), Outcome::Done);
    EXPECT_EQ(harness.start(), Outcome::Done);
    EXPECT_EQ(harness.event().kind, EventKind::Started);
  }
  RuntimeStatus status() const { return harness.runtime->status(); }
  bool reach(std::uint64_t scan) {
    return harness.wait([&] { return status().scan >= scan; });
  }

  Harness harness;
};

TEST(OnlineChange, WhenAProgramRuns_ThenTheNextTakesOverWithoutAStop) {
  Running run(counting());
  ASSERT_TRUE(run.reach(100));
  const std::vector<std::byte> next = compiled(counting("VAR pad : LINT; more : INT := 5; END_VAR"));
  const Completion completion = run.harness.change(next, "second");
  ASSERT_EQ(completion.outcome, Outcome::Done);
  EXPECT_EQ(completion.change.carried, 2u);
  EXPECT_EQ(completion.change.initialised, 2u);
  EXPECT_GT(completion.change.pause_us, 0.0);
  const StepEvent changed = run.harness.event();
  EXPECT_EQ(changed.kind, EventKind::Changed);
  EXPECT_EQ(changed.sequence, 2u);
  EXPECT_EQ(changed.program_digest, "second");
  EXPECT_EQ(changed.detail, "from first to second");
  // One scan, one count: none was lost and none came twice.
  EXPECT_EQ(number(changed, next, "main.n"), static_cast<double>(changed.scan));
  EXPECT_EQ(number(changed, next, "main.more"), 5.0);
  EXPECT_TRUE(run.reach(changed.scan + 100));
  const RuntimeStatus status = run.status();
  EXPECT_EQ(status.state, RuntimeState::Running);
  EXPECT_EQ(status.program_digest, "second");
  EXPECT_EQ(status.changes, 1u);
  EXPECT_EQ(status.last_change_pause_us, completion.change.pause_us);
  EXPECT_EQ(run.harness.driver.output, 17);
  const auto program = run.harness.runtime->program();
  EXPECT_TRUE(std::equal(program.begin(), program.end(), next.begin(), next.end()));
  EXPECT_FALSE(run.harness.runtime->take_event());
}

TEST(OnlineChange, WhenChanged_ThenTheTraceIsTheSameWheneverTheServiceWasSlow) {
  const auto trace = [](bool slow) {
    Harness harness;
    const auto pause = [&] {
      if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(3));
    };
    const auto chart = [](const std::string& declarations) {
      return compiled("PROGRAM main\n" + declarations +
                      "VAR n : INT; END_VAR\nINITIAL_STEP A: END_STEP\nSTEP B: END_STEP\nSTEP C: END_STEP\n"
                      "TRANSITION FROM A TO B := A.T >= T#100ms; END_TRANSITION\n"
                      "TRANSITION FROM B TO C := B.T >= T#100ms; END_TRANSITION\n"
                      "TRANSITION FROM C TO A := C.T >= T#100ms; END_TRANSITION\nEND_PROGRAM\n");
    };
    harness.load(chart(""));
    harness.start(true);
    harness.event();
    harness.acknowledge(harness.event().sequence);
    EXPECT_EQ(harness.event().scan, 11u);
    pause();
    // The clock stands still at the second step; the change lets it go on.
    EXPECT_EQ(harness.change(chart("VAR pad : LINT; END_VAR\n")).outcome, Outcome::Done);
    pause();
    EXPECT_EQ(harness.event().kind, EventKind::Changed);
    const StepEvent next = harness.event();
    EXPECT_EQ(next.kind, EventKind::StepChange);
    EXPECT_EQ(next.scan, 21u);
    return harness.runtime->status().trace_hash;
  };
  EXPECT_EQ(trace(false), trace(true));
}

TEST(OnlineChange, WhenNothingRuns_ThenItIsRefused) {
  Harness harness;
  Completion completion = harness.change(compiled(counting()));
  ASSERT_FALSE(completion.problems.empty());
  EXPECT_EQ(completion.problems[0].code, "R0031");
  harness.load(compiled(counting()));
  completion = harness.change(compiled(counting()));
  ASSERT_FALSE(completion.problems.empty());
  EXPECT_EQ(completion.problems[0].code, "R0031");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Stopped);
}

TEST(OnlineChange, WhenTwoComeAtOnce_ThenTheSecondIsRefused) {
  Harness harness;
  std::atomic<bool> hold{false};
  harness.driver.on_read = [&](std::int64_t) {
    while (hold) std::this_thread::yield();
  };
  ASSERT_EQ(harness.load(compiled(counting()), "first"), Outcome::Done);
  ASSERT_EQ(harness.start(), Outcome::Done);
  EXPECT_EQ(harness.event().kind, EventKind::Started);
  hold = true;
  HostRuntime& runtime = *harness.runtime;
  ASSERT_TRUE(runtime.change(901, compiled(counting()), "second", DownloadMode::Change));
  const auto refused = runtime.change(902, compiled(counting()), "third", DownloadMode::Change);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "R0032");
  hold = false;
  EXPECT_TRUE(harness.wait([&] { return runtime.take_completion().has_value(); }));
  EXPECT_EQ(runtime.status().program_digest, "second");
}

TEST(OnlineChange, WhenARollbackComesFirst_ThenTheChangePlannedForTheOtherProgramIsRefused) {
  Running run(counting());
  HostRuntime& runtime = *run.harness.runtime;
  std::atomic<std::uint64_t> reads{0};
  std::atomic<std::uint64_t> allowed{~std::uint64_t{0}};
  run.harness.driver.intervene([&](std::int64_t) {
    ++reads;
    while (reads > allowed) std::this_thread::yield();
  });
  allowed = 0;
  ASSERT_TRUE(run.harness.wait([&] { return reads > 0; }));
  // The scan thread stands at the inputs of a scan of the first program.
  ASSERT_TRUE(runtime.change(901, compiled(counting("VAR zero : DINT; END_VAR", "n := n / zero;")), "bad",
                             DownloadMode::Change));
  const auto handed_over = [&] {
    EXPECT_FALSE(runtime.take_completion());
    return runtime.preparing() == 0;
  };
  ASSERT_TRUE(run.harness.wait(handed_over));
  const std::uint64_t at = reads;
  allowed = at;
  ASSERT_TRUE(run.harness.wait([&] { return reads > at; }));
  // Now at those of the second one, which will trap.
  ASSERT_TRUE(run.harness.wait([&] { return runtime.take_completion().has_value(); }));
  ASSERT_TRUE(runtime.change(902, compiled(counting()), "third", DownloadMode::Change));
  ASSERT_TRUE(run.harness.wait(handed_over));
  allowed = ~std::uint64_t{0};
  std::optional<Completion> refused;
  ASSERT_TRUE(run.harness.wait([&] { return (refused = runtime.take_completion()).has_value(); }));
  EXPECT_EQ(refused->outcome, Outcome::ChangeOutdated);
  ASSERT_EQ(refused->problems.size(), 1u);
  EXPECT_EQ(refused->problems[0].code, "R0035");
  EXPECT_EQ(runtime.status().program_digest, "first");
  EXPECT_EQ(runtime.status().state, RuntimeState::Running);
}

TEST(OnlineChange, WhenTheContainerIsWrong_ThenThePreviousGoesOnUntouched) {
  Running run(counting());
  const std::vector<std::byte> good = compiled(counting("VAR pad : LINT; END_VAR"));
  for (std::size_t at = 0; at < good.size(); at += 97) {
    std::vector<std::byte> damaged = good;
    damaged[at] ^= std::byte{0x20};
    const Completion completion = run.harness.change(damaged);
    EXPECT_TRUE(result::has_errors(completion.problems)) << at;
  }
  EXPECT_TRUE(result::has_errors(run.harness.change({good.begin(), good.end() - 9}).problems));
  EXPECT_TRUE(result::has_errors(run.harness.change({}).problems));
  // Wider inputs than the cell has.
  const Completion wide = run.harness.change(compiled(counting("VAR far AT %IW500 : INT; END_VAR")));
  ASSERT_TRUE(result::has_errors(wide.problems));
  EXPECT_EQ(wide.problems[0].code, "R0080");
  const RuntimeStatus status = run.status();
  EXPECT_EQ(status.program_digest, "first");
  EXPECT_EQ(status.changes, 0u);
  EXPECT_TRUE(run.reach(status.scan + 100));
  EXPECT_FALSE(run.harness.runtime->take_event());
  EXPECT_EQ(run.harness.stop(), Outcome::Done);
  const StepEvent stopped = run.harness.event();
  EXPECT_EQ(number(stopped, compiled(counting()), "main.n"), static_cast<double>(stopped.scan));
}

TEST(OnlineChange, WhenAStepWouldBeLost_ThenTheCompletionNamesItAndTheProgramGoesOn) {
  const auto chart = [](const std::string& second) {
    return "PROGRAM main VAR n : INT; END_VAR\nINITIAL_STEP A: END_STEP\nSTEP " + second +
           ": END_STEP\nTRANSITION FROM A TO " + second + " := TRUE; END_TRANSITION\nTRANSITION FROM " +
           second + " TO A := FALSE; END_TRANSITION\nEND_PROGRAM\n";
  };
  Running run(chart("Hold"));
  ASSERT_TRUE(run.reach(10));
  const Completion refused = run.harness.change(compiled(chart("Kept")));
  EXPECT_EQ(refused.outcome, Outcome::StepLost);
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems[0].code, "R0033");
  EXPECT_NE(refused.problems[0].message.find("main.Hold"), std::string::npos);
  EXPECT_EQ(run.status().program_digest, "first");
  EXPECT_EQ(run.status().state, RuntimeState::Running);
  const Completion restarted =
      run.harness.change(compiled(chart("Kept")), "second", DownloadMode::ChangeRestartCharts);
  EXPECT_EQ(restarted.outcome, Outcome::Done) << result::to_string(restarted.problems);
  EXPECT_EQ(run.status().program_digest, "second");
}

TEST(OnlineChange, WhenTheProgramRetains_ThenTheStoreFollowsTheChangeAndTheNextStartFindsItsValues) {
  const std::filesystem::path store = std::filesystem::path(testing::TempDir()) / "online_change.store";
  std::filesystem::remove(store);
  const auto text = [](const std::string& more) {
    return "PROGRAM main\n" + more +
           "VAR RETAIN kept : DINT; END_VAR VAR n : DINT; END_VAR\nn := n + 1; kept := n;\nEND_PROGRAM\n";
  };
  HostConfig config;
  config.retain.store = store;
  config.retain.period_ns = 1'000'000;
  const std::vector<std::byte> second = compiled(text("VAR RETAIN pad : LINT := 3; END_VAR\n"));
  double last = 0;
  {
    Running run(text(""), config);
    ASSERT_TRUE(run.reach(20));
    ASSERT_EQ(run.harness.change(second).outcome, Outcome::Done);
    const StepEvent changed = run.harness.event();
    EXPECT_EQ(number(changed, second, "main.kept"), static_cast<double>(changed.scan));
    ASSERT_TRUE(run.reach(changed.scan + 20));
    ASSERT_EQ(run.harness.stop(), Outcome::Done);
    last = number(run.harness.event(), second, "main.kept");
    EXPECT_GT(last, static_cast<double>(changed.scan));
  }
  Harness again(config);
  ASSERT_EQ(again.load(second), Outcome::Done);
  ASSERT_EQ(again.start(), Outcome::Done);
  const StepEvent started = again.event();
  EXPECT_EQ(number(started, second, "main.kept"), last);
  EXPECT_EQ(number(started, second, "main.pad"), 3.0);
}

// The driver's every output from a change on: none may be the safe state, 0.
class OutputWatch final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    inputs[0] = std::byte{++scans};
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    if (watching && outputs[0] != std::byte{17}) ++wrong;
    return image::IoStatus::Good;
  }
  std::atomic<bool> watching{false};
  std::atomic<int> wrong{0};
  std::uint8_t scans = 0;
};

TEST(OnlineChange, WhenTheNewProgramTrapsOnTrial_ThenTheOldOneGoesOnAndOutputsWereNeverSafe) {
  for (const int trap_at : {1, 2, 9, 10}) {
    OutputWatch driver;
    HostConfig config;
    config.clock = ClockMode::Real;
    auto runtime = HostRuntime::create(config, driver, nullptr);
    ASSERT_TRUE(runtime);
    const auto wait_for = [&](const std::function<bool()>& condition) {
      const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
      while (std::chrono::steady_clock::now() < deadline) {
        while ((*runtime)->take_completion()) {
        }
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      return false;
    };
    const auto event = [&] {
      std::optional<StepEvent> next;
      EXPECT_TRUE(wait_for([&] { return (next = (*runtime)->take_event()).has_value(); }));
      return next.value_or(StepEvent{});
    };
    const std::vector<std::byte> first = compiled(counting("VAR in AT %IB0 : USINT; END_VAR"));
    ASSERT_TRUE((*runtime)->load(1, first, "first"));
    Command start;
    start.kind = CommandKind::Start;
    start.ticket = 2;
    ASSERT_TRUE((*runtime)->submit(start));
    EXPECT_EQ(event().kind, EventKind::Started);
    ASSERT_TRUE(wait_for([&] { return (*runtime)->status().scan > 5; }));
    driver.watching = true;
    const std::string trap =
        "k := k + 1; IF k = " + std::to_string(trap_at) + " THEN out := 1; n := n / zero; END_IF;";
    ASSERT_TRUE((*runtime)->change(3, compiled(counting("VAR k, zero : DINT; END_VAR", trap)), "bad",
                                   DownloadMode::Change));
    const StepEvent changed = event();
    EXPECT_EQ(changed.kind, EventKind::Changed);
    const StepEvent back = event();
    EXPECT_EQ(back.kind, EventKind::RolledBack);
    EXPECT_EQ(back.sequence, changed.sequence + 1);
    EXPECT_EQ(back.scan, changed.scan + static_cast<std::uint64_t>(trap_at));
    EXPECT_EQ(back.program_digest, "first");
    EXPECT_NE(back.detail.find("bad trapped"), std::string::npos) << back.detail;
    EXPECT_NE(back.detail.find("test.st:"), std::string::npos) << back.detail;
    // The values of the swap; the scans of the trial are lost to it.
    EXPECT_EQ(number(back, first, "main.n"), static_cast<double>(changed.scan));
    ASSERT_TRUE(wait_for([&] { return (*runtime)->status().scan > back.scan + 20; }));
    EXPECT_EQ((*runtime)->status().state, RuntimeState::Running);
    EXPECT_EQ((*runtime)->status().program_digest, "first");
    const auto program = (*runtime)->program();
    EXPECT_TRUE(std::equal(program.begin(), program.end(), first.begin(), first.end()));
    driver.watching = false;
    EXPECT_EQ(driver.wrong, 0);
    // It can be changed again, to a program that is good.
    ASSERT_TRUE((*runtime)->change(4, compiled(counting()), "good", DownloadMode::Change));
    EXPECT_EQ(event().kind, EventKind::Changed);
    EXPECT_EQ((*runtime)->status().program_digest, "good");
  }
}

TEST(OnlineChange, WhenTheNewProgramTrapsAfterItsTrial_ThenThatIsAFault) {
  HostConfig config;
  config.change_trial_scans = 3;
  Running run(counting(), config);
  ASSERT_EQ(run.harness
                .change(compiled(counting("VAR k, zero : DINT; END_VAR",
                                          "k := k + 1; IF k = 4 THEN n := n / zero; END_IF;")),
                        "bad")
                .outcome,
            Outcome::Done);
  EXPECT_EQ(run.harness.event().kind, EventKind::Changed);
  const StepEvent trap = run.harness.event();
  EXPECT_EQ(trap.kind, EventKind::Trap);
  EXPECT_EQ(trap.program_digest, "bad");
  EXPECT_EQ(run.status().state, RuntimeState::Fault);
  EXPECT_EQ(run.harness.driver.output, 0);
}

TEST(OnlineChange, WhenThereIsNoTrial_ThenTheFirstTrapIsAFault) {
  HostConfig config;
  config.change_trial_scans = 0;
  Running run(counting(), config);
  ASSERT_EQ(run.harness.change(compiled(counting("VAR zero : DINT; END_VAR", "n := n / zero;"))).outcome,
            Outcome::Done);
  EXPECT_EQ(run.harness.event().kind, EventKind::Changed);
  EXPECT_EQ(run.harness.event().kind, EventKind::Trap);
  EXPECT_EQ(run.status().state, RuntimeState::Fault);
}

TEST(OnlineChange, WhenForced_ThenForcesHoldThroughChangeAndRollback) {
  HostConfig config;
  config.clock = ClockMode::Real;
  Running run(program_text("VAR a, b : DINT; out AT %QB0 : USINT; END_VAR", "b := b + 1; a := 0;"), config);
  const std::vector<std::byte> first =
      compiled(program_text("VAR a, b : DINT; out AT %QB0 : USINT; END_VAR", "b := b + 1; a := 0;"));
  const auto place = reader::ProgramInfo::read(first)->find("main.a")->address;
  ASSERT_EQ(run.harness.bits(CommandKind::Force, {place, 0xFFFF'FFFFu, 1234}), Outcome::Done);
  ASSERT_TRUE(run.reach(run.status().scan + 2)) << "a force holds from the next scan on";
  const std::vector<std::byte> second =
      compiled(program_text("VAR pad : LINT; k, zero, c : DINT; a : DINT; out AT %QB0 : USINT; END_VAR",
                            "a := 0; k := k + 1; IF k = 8 THEN a := 5 / zero; END_IF;"));
  ASSERT_EQ(run.harness.change(second, "second").outcome, Outcome::Done);
  const StepEvent changed = run.harness.event();
  EXPECT_EQ(number(changed, second, "main.a"), 1234.0);
  const StepEvent back = run.harness.event();
  ASSERT_EQ(back.kind, EventKind::RolledBack);
  ASSERT_TRUE(run.reach(back.scan + 5));
  EXPECT_EQ(run.harness.stop(), Outcome::Done);
  EXPECT_EQ(number(run.harness.event(), first, "main.a"), 1234.0);
}

// The failed program lacks `b`, and has `only`, which is forced while it is on trial.
TEST(OnlineChange, WhenTheFailedProgramLackedAForcedVariable_ThenItIsForcedAgainAndWhatIsGoneIsSaid) {
  const std::vector<std::byte> first =
      compiled(program_text("VAR a, b : DINT; out AT %QB0 : USINT; END_VAR", "a := 0; b := 0;"));
  const std::vector<std::byte> second =
      compiled(program_text("VAR a, only, k, zero : DINT; out AT %QB0 : USINT; END_VAR",
                            "a := 0; k := k + 1; IF only = 8 AND k > 5 THEN a := 5 / zero; END_IF;"));
  HostConfig config;
  config.clock = ClockMode::Real;
  config.change_trial_scans = 100'000;
  Running run(program_text("VAR a, b : DINT; out AT %QB0 : USINT; END_VAR", "a := 0; b := 0;"), config);
  const auto force = [&](const std::vector<std::byte>& program, const char* name, std::uint32_t value) {
    const auto place = reader::ProgramInfo::read(program)->find(name)->address;
    ASSERT_EQ(run.harness.bits(CommandKind::Force, {place, 0xFFFF'FFFFu, value}), Outcome::Done);
  };
  force(first, "main.a", 7);
  force(first, "main.b", 9);
  const Completion changed = run.harness.change(second, "second");
  ASSERT_EQ(changed.outcome, Outcome::Done);
  EXPECT_EQ(changed.change.dropped_forces, 1u);
  EXPECT_EQ(run.harness.event().kind, EventKind::Changed);
  force(second, "main.only", 8);
  const StepEvent back = run.harness.event();
  ASSERT_EQ(back.kind, EventKind::RolledBack);
  EXPECT_NE(back.detail.find("1 forces of what only it had are gone"), std::string::npos) << back.detail;
  EXPECT_EQ(run.harness.runtime->forces().places.size(), 2u);
  ASSERT_TRUE(run.reach(back.scan + 5));
  EXPECT_EQ(run.harness.stop(), Outcome::Done);
  const StepEvent stopped = run.harness.event();
  EXPECT_EQ(number(stopped, first, "main.a"), 7.0);
  EXPECT_EQ(number(stopped, first, "main.b"), 9.0);
}

TEST(OnlineChange, WhenChangedAgainAndAgain_ThenNoScanIsLostAndNoProgramIsKept) {
  Running run(counting());
  const std::vector<std::byte> odd = compiled(counting("VAR pad : LINT; END_VAR"));
  const std::vector<std::byte> even = compiled(counting());
  std::uint64_t sequence = 1;
  for (int i = 0; i < 300; ++i) {
    const bool is_odd = i % 2 == 0;
    ASSERT_EQ(run.harness.change(is_odd ? odd : even, is_odd ? "odd" : "even").outcome, Outcome::Done) << i;
    const StepEvent event = run.harness.event();
    ASSERT_EQ(event.kind, EventKind::Changed);
    ASSERT_EQ(event.sequence, ++sequence);
    ASSERT_EQ(number(event, is_odd ? odd : even, "main.n"), static_cast<double>(event.scan)) << i;
  }
  EXPECT_EQ(run.status().changes, 300u);
}

TEST(OnlineChange, WhenTheScanThreadSwaps_ThenItNeitherAllocatesNorLocks) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  Running run(counting());
  support::GuardCounts before;
  std::atomic<std::uint64_t> scans{0};
  std::atomic<std::uint64_t> noisy{0};
  ASSERT_TRUE(run.reach(10));
  ASSERT_EQ(run.harness.stop(), Outcome::Done);
  EXPECT_EQ(run.harness.event().kind, EventKind::Stopped);
  run.harness.driver.intervene([&](std::int64_t) {
    const support::GuardCounts now = support::guard_counts();
    if (++scans > 1 && !(now == before)) ++noisy;
    before = now;
  });
  ASSERT_EQ(run.harness.start(), Outcome::Done);
  EXPECT_EQ(run.harness.event().kind, EventKind::Started);
  for (int i = 0; i < 20; ++i) {
    const std::string text =
        i % 3 == 2 ? counting("VAR z : DINT; END_VAR", "n := n / z;")
                   : counting("VAR pad : ARRAY[0..99] OF INT; END_VAR", "pad[3] := pad[3] + 1;");
    ASSERT_EQ(run.harness.change(compiled(text)).outcome, Outcome::Done);
    EXPECT_EQ(run.harness.event().kind, EventKind::Changed);
    if (i % 3 == 2) {
      EXPECT_EQ(run.harness.event().kind, EventKind::RolledBack);
    }
  }
  EXPECT_EQ(noisy, 0u);
  EXPECT_GT(scans, 20u);
}

}  // namespace
}  // namespace stepwright::host
