#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

using host::CommandKind;
using host::EventKind;
using host::Outcome;
using host::RuntimeState;
using support::step_program;
using support::StepProgramLayout;

// What goes over the line is what is asked for, however long it takes.
RemoteConfig without_polls() {
  RemoteConfig config = quick_config();
  config.status_period = std::chrono::hours(1);
  return config;
}

// Every event until `count` step changes came; the last one is not acknowledged, so that the clock stands.
std::vector<host::StepEvent> run_steps(Driver& driver, int count) {
  std::vector<host::StepEvent> events;
  for (int changes = 0; changes < count;) {
    events.push_back(driver.event());
    if (events.back().sequence == 0) break;
    changes += events.back().kind == EventKind::StepChange ? 1 : 0;
    if (changes < count) driver.acknowledge(events.back().sequence);
  }
  return events;
}

TEST(RemoteRuntime_WhenItRunsInLockStep, ThenEventsAndTraceAreThoseOfTheHost) {
  const auto program = step_program({.steps = 6, .scans_per_step = 7});
  Bench bench;
  TestPlant host_plant;
  auto host_runtime = host::HostRuntime::create({}, host_plant, nullptr);
  Driver host_driver(**host_runtime);
  std::vector<std::vector<host::StepEvent>> seen;
  for (Driver* driver : {&bench.driver, &host_driver}) {
    EXPECT_EQ(driver->load(program).outcome, Outcome::Done);
    EXPECT_EQ(driver->start(true).outcome, Outcome::Done);
    seen.push_back(run_steps(*driver, 6));
    EXPECT_EQ(driver->stop().outcome, Outcome::Done);
    seen.back().push_back(driver->event());
    // A second run goes on with the scans and the trace of the first one.
    EXPECT_EQ(driver->start(true).outcome, Outcome::Done);
    const auto again = run_steps(*driver, 3);
    seen.back().insert(seen.back().end(), again.begin(), again.end());
    EXPECT_EQ(driver->stop().outcome, Outcome::Done);
  }
  ASSERT_EQ(seen[0].size(), seen[1].size());
  for (std::size_t i = 0; i < seen[0].size(); ++i) EXPECT_EQ(seen[0][i], seen[1][i]) << "event " << i;
  const auto remote = bench.runtime->status();
  const auto host = (*host_runtime)->status();
  EXPECT_EQ(remote.trace_hash, host.trace_hash);
  EXPECT_EQ(remote.scan, host.scan);
  EXPECT_EQ(remote.time_ns, host.time_ns);
  EXPECT_NE(remote.trace_hash, 0u);
}

TEST(RemoteRuntime_WhenABarrierHolds, ThenTheControllerGetsNoTurn) {
  Bench bench;
  bench.driver.load(step_program());
  bench.driver.start(true);
  EXPECT_EQ(bench.driver.event().kind, EventKind::Started);
  const host::StepEvent first = bench.driver.event();
  EXPECT_TRUE(bench.runtime->status().waiting_for_supervisor);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  {
    const std::lock_guard lock(bench.world->mutex);
    EXPECT_EQ(bench.world->board.machine().figures().scan, first.scan);
  }
  bench.driver.acknowledge(first.sequence);
  EXPECT_GT(bench.driver.event().scan, first.scan);
}

TEST(RemoteRuntime_WhenInputsChange, ThenTheNextScanHasThem) {
  Bench bench;
  bench.plant.input = std::byte{0x5A};
  bench.driver.load(step_program());
  bench.driver.start(true);
  bench.driver.event();
  EXPECT_EQ(bench.driver.event().image[0], std::byte{0x5A});
  EXPECT_EQ(bench.plant.output.load(), std::byte{1});  // step 0 drives %QX0.0
  EXPECT_EQ(bench.plant.last_read_ns.load(), bench.runtime->status().time_ns);
}

TEST(RemoteRuntime_WhenAProgramTraps, ThenTheFaultIsLocatedAndOutputsAreOff) {
  Bench bench;
  bench.driver.load(step_program({.steps = 2, .scans_per_step = 4, .trap_at_end = true}));
  bench.driver.start(false);
  host::StepEvent event;
  do event = bench.driver.event();
  while (event.sequence != 0 && event.kind != EventKind::Trap);
  EXPECT_NE(event.detail.find("steps.st:2"), std::string::npos) << event.detail;
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Fault);
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
  EXPECT_EQ(bench.driver.start(false).outcome, Outcome::Done);  // a start leaves the fault
}

TEST(RemoteRuntime_WhenBitsAreForcedAndWritten, ThenTheControllersImageHasThem) {
  Bench bench;
  bench.driver.load(step_program({.steps = 2, .scans_per_step = 20}));
  const host::ImageBits free{StepProgramLayout::kFree, 0xFFFF'FFFF'FFFF'FFFF, 0x0123'4567'89AB'CDEF};
  EXPECT_EQ(bench.driver.bits(CommandKind::Force, {0, 0x04, 0x04}).outcome, Outcome::Done);
  ASSERT_EQ(bench.runtime->forces().places.size(), 1u);
  EXPECT_EQ(bench.runtime->forces().places[0].bit, 2);
  EXPECT_EQ(bench.runtime->forces().program_digest, bench.runtime->status().program_digest);
  bench.driver.start(true);
  bench.driver.event();
  const std::uint64_t barrier = bench.driver.event().sequence;  // here the clock stands
  EXPECT_EQ(bench.driver.bits(CommandKind::Write, free).outcome, Outcome::Done);
  bench.driver.acknowledge(barrier);
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.image[0], std::byte{0x04});
  std::uint64_t value = 0;
  std::memcpy(&value, event.image.data() + StepProgramLayout::kFree, sizeof value);
  EXPECT_EQ(value, free.value);
  EXPECT_EQ(bench.driver.bits(CommandKind::Unforce, {0, 0x04, 0}).outcome, Outcome::Done);
  EXPECT_TRUE(bench.runtime->forces().places.empty());
  EXPECT_EQ(bench.driver.bits(CommandKind::Unforce, {0, 0x04, 0}).outcome, Outcome::NotForced);
  EXPECT_EQ(bench.driver.bits(CommandKind::Write, {4'000, 0xFF, 1}).outcome, Outcome::OutOfBounds);
  EXPECT_EQ(bench.driver.bits(CommandKind::Force, {0, 0x05, 1}).outcome, Outcome::OutOfBounds);
}

TEST(RemoteRuntime_WhenBitsAreOfAnotherProgram, ThenTheControllerIsNotAsked) {
  Bench bench(without_polls());
  bench.driver.load(step_program({.steps = 2}));
  host::Command command;
  command.bits = {StepProgramLayout::kFree, 0xFFFF, 0x1234};
  for (const CommandKind kind : {CommandKind::Force, CommandKind::Unforce, CommandKind::Write}) {
    for (const std::string& digest : {std::string(64, 'a'), std::string()}) {
      command.kind = kind;
      command.program_digest = host::FixedText<host::kDigestLetters>(digest);
      const std::uint64_t before = bench.world->requests;
      const host::Completion refused = bench.driver.run(command);
      EXPECT_EQ(refused.outcome, Outcome::ProgramDiffers);
      EXPECT_EQ(refused.program_digest.view(), bench.runtime->status().program_digest);
      EXPECT_EQ(bench.world->requests, before);
    }
  }
  EXPECT_TRUE(bench.runtime->forces().places.empty());
}

// Whose end the controller keeps: who forced may be gone by then.
TEST(RemoteRuntime_WhenTheTimeOfAForceIsOver, ThenTheControllerReleasesIt) {
  Bench bench;
  bench.driver.load(step_program({.steps = 2}));
  host::Command command;
  command.kind = CommandKind::Force;
  command.bits = {StepProgramLayout::kFree, 0xFFFF, 0x1234};
  command.program_digest = host::FixedText<host::kDigestLetters>(bench.runtime->status().program_digest);
  command.duration_ns = 3'600'000'000'000;
  ASSERT_EQ(bench.driver.run(command).outcome, Outcome::Done);
  ASSERT_EQ(bench.runtime->forces().places.size(), 1u);
  EXPECT_LE(bench.runtime->forces().places[0].end_ns, command.duration_ns);
  command.duration_ns = 1'000'000;
  ASSERT_EQ(bench.driver.run(command).outcome, Outcome::Done) << "the same place, with another end";
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->forces().places.empty(); }));
  {
    const std::lock_guard lock(bench.world->mutex);
    ASSERT_EQ(bench.world->board.machine().forces()->forces().size(), 1u) << "the board's clock stands";
    bench.world->board.run_ms(2);
    EXPECT_TRUE(bench.world->board.machine().forces()->forces().empty());
  }
  EXPECT_EQ(bench.driver.bits(CommandKind::Unforce, command.bits).outcome, Outcome::NotForced);
}

TEST(RemoteRuntime_WhenSomebodySteps, ThenThatManyScansRun) {
  Bench bench;
  bench.driver.load(step_program());
  host::Command step;
  step.kind = CommandKind::Step;
  bench.driver.run(step);
  bench.driver.start(false);
  step.count = 3;
  EXPECT_EQ(bench.driver.run(step).scan, 3u);
  EXPECT_TRUE(bench.driver.await([&] { return bench.runtime->status().scan == 3; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(bench.runtime->status().scan, 3u);
}

TEST(RemoteRuntime_WhenItIsAskedForWhatItCannotDo, ThenItSaysSoAndNothingHappens) {
  Bench bench;
  const auto program = step_program();
  bench.driver.load(program);
  bench.driver.start(true);
  const auto changed =
      bench.runtime->change(99, program, Driver::digest(program), host::DownloadMode::Change);
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error()[0].code, "R0147");
  EXPECT_EQ(changed.error()[0].where.file, "test board");
  EXPECT_FALSE(changed.error()[0].hint.empty());
  const auto recorded = bench.runtime->record(98, {});
  ASSERT_FALSE(recorded);
  EXPECT_EQ(recorded.error()[0].code, "R0147");
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Running);
}

TEST(RemoteRuntime_WhenAProgramDoesNotFit, ThenWhatRunsGoesOn) {
  constexpr std::size_t kFlashBytes = 16 * boards::RamFlash::kPageBytes;  // of which a slot has seven pages
  Bench bench(quick_config(), std::make_shared<support::BoardWorld>(kFlashBytes));
  const auto small = step_program({.steps = 2});
  const auto large = step_program({.steps = 1'000});
  ASSERT_LT(small.size(), kFlashBytes / 16 * 6);
  ASSERT_GT(large.size(), kFlashBytes / 16 * 7);
  bench.driver.load(small);
  bench.driver.start(true);
  const host::Completion refused = bench.driver.load(large);
  EXPECT_EQ(refused.outcome, Outcome::Refused);
  ASSERT_FALSE(refused.problems.empty());
  EXPECT_EQ(refused.problems[0].code, "R0145");
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Running);
  EXPECT_EQ(bench.runtime->status().program_digest, Driver::digest(small));
}

TEST(RemoteRuntime_WhenAContainerIsDamaged, ThenItIsNotSent) {
  Bench bench(without_polls());
  auto program = step_program();
  program[program.size() / 2] ^= std::byte{1};
  const std::uint64_t before = bench.world->requests;
  const auto loading = bench.runtime->load(1, program, Driver::digest(program));
  ASSERT_FALSE(loading);
  EXPECT_EQ(loading.error()[0].code, "B0004");
  EXPECT_EQ(bench.world->requests, before);
}

TEST(RemoteRuntime_WhenAnotherProgramIsLoaded, ThenTheOneThatRanIsStopped) {
  Bench bench;
  bench.driver.load(step_program());
  bench.driver.start(true);
  EXPECT_EQ(bench.driver.event().kind, EventKind::Started);
  EXPECT_EQ(bench.driver.event().kind, EventKind::StepChange);
  const auto next = step_program({.steps = 4});
  EXPECT_EQ(bench.driver.load(next).outcome, Outcome::Done);
  const host::StepEvent stopped = bench.driver.event();
  EXPECT_EQ(stopped.kind, EventKind::Stopped);
  EXPECT_EQ(stopped.detail, "another program was loaded");
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(bench.runtime->status().program_digest, Driver::digest(next));
  EXPECT_EQ(std::vector<std::byte>(bench.runtime->program().begin(), bench.runtime->program().end()), next);
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
}

TEST(RemoteRuntime_WhenTheControllerHasAProgram, ThenItIsReadFromIt) {
  auto world = std::make_shared<support::BoardWorld>();
  const auto program = step_program({.steps = 9});
  {
    Bench before(quick_config(), world);
    before.driver.load(program);
  }
  Bench bench(quick_config(), world);
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(bench.runtime->status().program_digest, Driver::digest(program));
  EXPECT_EQ(std::vector<std::byte>(bench.runtime->program().begin(), bench.runtime->program().end()),
            program);
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);
}

TEST(RemoteRuntime_WhenAScanCosts, ThenItIsOneRequest) {
  RemoteConfig config = without_polls();
  config.image_period = std::chrono::hours(1);
  Bench bench(config);
  bench.driver.load(step_program({.steps = 2, .scans_per_step = 1'000}));
  bench.driver.start(true);
  bench.driver.event();
  bench.driver.acknowledge(bench.driver.event().sequence);
  const std::uint64_t before = bench.world->requests;
  EXPECT_EQ(bench.driver.event().scan, 1'001u);
  const std::uint64_t spent = bench.world->requests - before;
  EXPECT_LE(spent, 1'010u);  // and a few for the image of the event
}

TEST(RemoteRuntime_WhenTheSupervisorIsLost, ThenThePolicyApplies) {
  RemoteConfig config = quick_config();
  config.host.on_lost_supervisor = host::LostSupervisor::Safe;
  Bench bench(config);
  bench.driver.load(step_program());
  bench.driver.start(true);
  bench.driver.event();
  bench.driver.event();
  host::Command lost;
  lost.kind = CommandKind::SupervisorLost;
  EXPECT_EQ(bench.driver.run(lost).outcome, Outcome::Done);
  const host::StepEvent event = bench.driver.event();
  EXPECT_EQ(event.kind, EventKind::Stopped);
  EXPECT_EQ(event.detail, host::kSupervisorLost);
}

TEST(RemoteRuntime_WhenTheProgramIsThereAlready, ThenItIsNotSentAgain) {
  Bench bench(without_polls());
  const auto program = step_program({.steps = 200});
  ASSERT_GT(program.size(), 20 * control::transfer::kMaxBytes);
  bench.driver.load(program);
  bench.driver.start(true);
  EXPECT_EQ(bench.driver.bits(CommandKind::Force, {0, 0x01, 0x01}).outcome, Outcome::Done);
  const std::uint64_t before = bench.world->requests;
  EXPECT_EQ(bench.driver.load(program).outcome, Outcome::Done);
  EXPECT_LT(bench.world->requests - before, 20u);
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  EXPECT_TRUE(bench.runtime->forces().places.empty());
  EXPECT_EQ(bench.driver.bits(CommandKind::Unforce, {0, 0x01, 0x01}).outcome, Outcome::NotForced);
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);
}

}  // namespace
}  // namespace stepwright::remote
