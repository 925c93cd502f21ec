#include "runtime/scan/scan_cycle.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <utility>
#include <vector>

#include "runtime/base/hash64.h"
#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/scan/scan_fixture.h"

namespace stepwright::scan {
namespace {

using L = support::SampleLayout;
using bytecode::TrapCode;

constexpr std::int64_t kMs = 1'000'000;

std::int32_t main_count(const ScanFixture& f) {
  return f.program.read<std::int32_t>(L::kMain + L::kCount);
}
std::int32_t slow_count(const ScanFixture& f) {
  return f.program.read<std::int32_t>(L::kSlow);
}

TEST(ScanCycle, Tasks_WhenTheyHaveTwoIntervals_ThenEachRunsAtItsOwnMultiples) {
  ScanFixture f;
  f.cycle.start({});
  for (std::int64_t k = 0; k < 6; ++k) {
    EXPECT_EQ(f.cycle.next_time_ns(), k * 10 * kMs);
    const ScanReport report = f.cycle.run_scan();
    EXPECT_EQ(report.scan, static_cast<std::uint64_t>(k + 1));
    EXPECT_EQ(report.time_ns, k * 10 * kMs);
    EXPECT_EQ(main_count(f), k + 1);
    EXPECT_EQ(slow_count(f), 100 + k / 2 + 1);
  }
}

// Task A (priority 1) runs before task B (priority 5) although B stands first in the table: B sees A's
// result.
TEST(ScanCycle, Tasks_WhenDueTogether_ThenTheHigherPriorityRunsFirst) {
  writer::FunctionBuilder first("A", bytecode::FunctionKind::Program, 8);
  first.const_i32(42);
  first.store(bytecode::MemType::I32, bytecode::AddressMode::This, 0);
  first.emit(bytecode::Opcode::Return);
  writer::FunctionBuilder second("B", bytecode::FunctionKind::Program, 8);
  second.load(bytecode::MemType::I32, bytecode::AddressMode::This, 0);
  second.store(bytecode::MemType::I32, bytecode::AddressMode::This, 4);
  second.emit(bytecode::Opcode::Return);
  writer::ContainerModel model;
  model.sizes.data_bytes = 8;
  model.functions.push_back(std::move(first).take());
  model.functions.push_back(std::move(second).take());
  model.tasks = {{"b", 10'000, 5, {{"B", 1, 0}}}, {"a", 10'000, 1, {{"A", 0, 0}}}};
  ScanFixture f({}, model);
  f.cycle.start({});
  f.cycle.run_scan();
  EXPECT_EQ(f.program.read<std::int32_t>(4), 42);
}

TEST(ScanCycle, Inputs_WhenTheDriverGivesThem_ThenReachProgramAndOutputs) {
  ScanFixture f;
  f.cycle.start({});
  f.cycle.run_scan();
  f.driver.input_bytes[0] = std::byte{1};
  f.driver.input_bytes[2] = std::byte{8};
  for (int i = 0; i < 3; ++i) f.cycle.run_scan();
  EXPECT_EQ(f.driver.output_bytes[0] & std::byte{1}, std::byte{1});  // 30 ms after the start at 0
  EXPECT_EQ(f.program.read<float>(L::kMain + L::kLevel), 2.0f);
  EXPECT_EQ(f.driver.read_times[3], 30 * kMs);
}

TEST(ScanCycle, Forces_WhenSet_ThenHoldForInputsAndOutputs) {
  ScanFixture f;
  f.cycle.start({});
  ASSERT_TRUE(f.cycle.forces().set({.address = L::kInputs + 2, .size = 2, .value = 400},
                                   f.program.image().bytes().size()));
  ASSERT_TRUE(f.cycle.forces().set({.address = L::kOutputs, .bit = 0, .size = 1, .value = 1},
                                   f.program.image().bytes().size()));
  f.cycle.run_scan();
  EXPECT_EQ(f.program.read<float>(L::kMain + L::kLevel), 100.0f);
  EXPECT_EQ(f.driver.output_bytes[0] & std::byte{1}, std::byte{1});
  f.cycle.forces().clear_all();
  f.cycle.run_scan();
  EXPECT_EQ(f.driver.output_bytes[0] & std::byte{1}, std::byte{0});
}

TEST(ScanCycle, Stop_WhenOutputsAreOn_ThenEachTakesItsSafeState) {
  const std::vector<SafeOutput> safe = {{.byte = 0, .mask = 0x0C, .mode = SafeMode::Hold},
                                        {.byte = 1, .mask = 0xFF, .mode = SafeMode::Value, .value = 0x55}};
  SafeMatrix matrix;
  matrix[static_cast<std::size_t>(SafeCause::Stop)].outputs = safe;
  ScanFixture f({.safe_state = matrix});
  f.cycle.start({});
  ASSERT_TRUE(f.cycle.forces().set({.address = L::kOutputs, .size = 1, .value = 0xFF},
                                   f.program.image().bytes().size()));
  f.cycle.run_scan();
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{0xFF});
  f.cycle.forces().clear_all();
  f.program.image().outputs()[0] = std::byte{0};  // never put out: what is held is what was
  f.cycle.stop();
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{0x0C});
  EXPECT_EQ(f.driver.output_bytes[1], std::byte{0x55});
  EXPECT_EQ(f.cycle.state(), ScanState::Stopped);
  const std::int32_t before = main_count(f);
  ASSERT_TRUE(f.cycle.forces().set({.address = L::kOutputs, .bit = 0, .size = 1, .value = 1},
                                   f.program.image().bytes().size()));
  f.cycle.run_scan();
  EXPECT_EQ(main_count(f), before);
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{0x0C});  // a force cannot leave the safe state
}

// MAIN divides 100 by the input word and writes the result to %QB0.
writer::ContainerModel dividing_model() {
  writer::ContainerModel model = support::one_program(8, [](writer::FunctionBuilder& f) {
    f.line(0, 5);
    f.const_i32(100);
    f.load(bytecode::MemType::I16, bytecode::AddressMode::Abs, 2);
    f.emit(bytecode::Opcode::DivI32);
    f.store(bytecode::MemType::U8, bytecode::AddressMode::Abs, 4);
  });
  model.sizes = {4, 2, 0, 8};
  model.tasks[0].calls[0].instance = 6;
  model.source_files = {"divide.st"};
  return model;
}

TEST(ScanCycle, Trap_WhenATaskFaults_ThenOutputsAreSafeAndTheFaultStays) {
  ScanFixture f({}, dividing_model());
  f.cycle.start({});
  f.driver.input_bytes[2] = std::byte{5};
  EXPECT_FALSE(f.cycle.run_scan().trap);
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{20});
  f.driver.input_bytes[2] = std::byte{0};
  const ScanReport faulted = f.cycle.run_scan();
  EXPECT_EQ(faulted.trap.code, TrapCode::DivisionByZero);
  EXPECT_EQ(faulted.state, ScanState::Trapped);
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{0});
  f.driver.input_bytes[2] = std::byte{5};
  const ScanReport after = f.cycle.run_scan();
  EXPECT_EQ(after.state, ScanState::Trapped);
  EXPECT_FALSE(after.trap);
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{0});
  EXPECT_EQ(f.cycle.statistics().traps, 1u);
  f.cycle.start({});
  EXPECT_EQ(f.cycle.run_scan().state, ScanState::Running);
  EXPECT_EQ(f.driver.output_bytes[0], std::byte{20});
}

TEST(ScanCycle, Watchdog_WhenTheBudgetIsTooSmall_ThenTraps) {
  ScanFixture f({.budget = 10});
  f.cycle.start({});
  EXPECT_EQ(f.cycle.run_scan().trap.code, TrapCode::Watchdog);
}

TEST(ScanCycle, Io_WhenReadingOrWritingIsLost_ThenOutputsAreSafeUntilStarted) {
  for (const bool reading : {true, false}) {
    ScanFixture f({}, dividing_model());
    f.driver.input_bytes[2] = std::byte{5};
    f.cycle.start({});
    f.cycle.run_scan();
    (reading ? f.driver.reads_good : f.driver.writes_good) = false;
    EXPECT_EQ(f.cycle.run_scan().state, ScanState::IoLost);
    EXPECT_EQ(f.driver.output_bytes[0], std::byte{0});
    (reading ? f.driver.reads_good : f.driver.writes_good) = true;
    EXPECT_EQ(f.cycle.run_scan().state, ScanState::IoLost);
    EXPECT_EQ(f.driver.output_bytes[0], std::byte{0});
    EXPECT_EQ(f.cycle.statistics().io_losses, 1u);
    f.cycle.start({});
    f.cycle.run_scan();
    EXPECT_EQ(f.driver.output_bytes[0], std::byte{20});
  }
}

TEST(ScanCycle, TraceHash_WhenInputsAreEqual_ThenIsEqualAndOtherwiseNot) {
  const auto trace = [](std::uint8_t input) {
    ScanFixture f;
    f.cycle.start({});
    for (int i = 0; i < 10; ++i) {
      f.driver.input_bytes[3] = i == 4 ? std::byte{input} : std::byte{0};
      f.cycle.run_scan();
    }
    return f.cycle.trace_hash();
  };
  EXPECT_EQ(trace(1), trace(1));
  EXPECT_NE(trace(1), trace(2));
}

TEST(ScanCycle, Start_WhenAnotherProgramRanBefore_ThenTimeAndTraceGoOn) {
  ScanFixture f;
  f.cycle.start({});
  f.cycle.run_scan();
  const std::uint64_t trace = f.cycle.trace_hash();
  ScanFixture next;
  next.cycle.start({.time_ns = 10 * kMs, .scan = f.cycle.scan(), .trace_hash = trace});
  const ScanReport report = next.cycle.run_scan();
  EXPECT_EQ(report.scan, 2u);
  EXPECT_EQ(report.time_ns, 10 * kMs);
  EXPECT_EQ(next.cycle.trace_hash(), base::hash_mix(base::hash_mix(trace, 2), report.image_hash));
}

TEST(ScanCycle, Overrun_WhenScansWereMissed_ThenTheNewestRunsAndTasksKeepTheirPhase) {
  ScanFixture f;
  f.cycle.start({});
  f.cycle.run_scan();
  f.cycle.settle_overruns(45 * kMs);
  EXPECT_EQ(f.cycle.next_time_ns(), 40 * kMs);
  EXPECT_EQ(f.cycle.statistics().overruns, 4u) << "three of the fast task, one of the slow one";
  f.cycle.run_scan();
  EXPECT_EQ(slow_count(f), 102);
  f.cycle.settle_overruns(50 * kMs);
  EXPECT_EQ(f.cycle.next_time_ns(), 50 * kMs);
  EXPECT_EQ(f.cycle.statistics().overruns, 4u);
}

// One periodic task that copies the input to `go` and two that count: on the edge only, and on the edge or
// every scan. The functions use their task's own frames.
writer::ContainerModel triggered_model() {
  using bytecode::AddressMode;
  using bytecode::MemType;
  using bytecode::Opcode;
  constexpr std::uint32_t kGo = 4, kCounts = 8;
  writer::ContainerModel model;
  model.sizes = {4, 0, 0, 16};
  writer::FunctionBuilder copy("COPY", bytecode::FunctionKind::Program, 16);
  copy.load_bit(0, 0);
  copy.store(MemType::Bool, AddressMode::Abs, kGo);
  copy.emit(Opcode::Return);
  writer::FunctionBuilder count("COUNT", bytecode::FunctionKind::Program, 4);
  const std::uint32_t local = count.allocate_frame(4, 4);
  count.addr_frame(local);
  count.load(MemType::I32, AddressMode::This, 0);
  count.const_i32(1);
  count.emit(Opcode::AddI32);
  count.store(MemType::I32, AddressMode::Ind);
  count.addr_frame(local);
  count.load(MemType::I32, AddressMode::Ind);
  count.store(MemType::I32, AddressMode::This, 0);
  count.emit(Opcode::Return);
  model.functions = {std::move(copy).take(), std::move(count).take()};
  model.types = {writer::elementary(bytecode::ElementaryType::Bool)};
  model.symbols = {{.name = "go", .type = 0, .address = kGo, .direct_address = {}}};
  model.tasks = {{"cycle", 10'000, 0, {{"COPY", 0, 4}}},
                 {"event", 0, 1, {{"EVENT", 1, kCounts}}, 0},
                 {"both", 10'000, 2, {{"BOTH", 1, kCounts + 4}}, 0}};
  return model;
}

TEST(ScanCycle, Trigger_WhenItRises_ThenItsTasksRunOnce) {
  support::TestProgram program(triggered_model());
  FakeDriver driver;
  CountingClock clock;
  std::vector<std::byte> safe_outputs(program.image().outputs().size());
  ScanCycle cycle(program.loaded().program(), program.engine(), program.image(), safe_outputs, driver, clock,
                  {});
  cycle.start({});
  const auto scan = [&](bool go) {
    driver.input_bytes[0] = std::byte{go};
    EXPECT_FALSE(cycle.run_scan().trap);
    return std::pair(program.read<std::int32_t>(8), program.read<std::int32_t>(12));
  };
  using Counts = std::pair<std::int32_t, std::int32_t>;
  EXPECT_EQ(scan(false), Counts(0, 1));
  EXPECT_EQ(scan(true), Counts(1, 2)) << "in the scan in which a task of higher priority raises it";
  EXPECT_EQ(scan(true), Counts(1, 2)) << "while it is TRUE the interval does not run the task";
  EXPECT_EQ(scan(false), Counts(1, 3));
  EXPECT_EQ(scan(true), Counts(2, 4));
  EXPECT_EQ(cycle.next_time_ns(), 50'000'000);
  cycle.settle_overruns(85'000'000);
  EXPECT_EQ(cycle.next_time_ns(), 80'000'000);
  // Each task wrote its own frame, behind the image of 20 bytes.
  EXPECT_EQ(program.read<std::int32_t>(20 + 8), 2);
  EXPECT_EQ(program.read<std::int32_t>(20 + 16), 4);
  cycle.start({});
  EXPECT_EQ(scan(true), Counts(1, 1)) << "a start forgets the edge";
}

TEST(ScanCycle, Statistics_WhenTheClockIsKnown_ThenHoldTheDurations) {
  ScanFixture f;
  f.cycle.start({});
  for (int i = 0; i < 20; ++i) f.cycle.run_scan();
  const ScanStatistics& statistics = f.cycle.statistics();
  EXPECT_EQ(statistics.scans, 20u);
  EXPECT_EQ(statistics.program_time.max_ns(), 1000);
  EXPECT_EQ(statistics.scan_time.max_ns(), 3000);
}

TEST(ScanCycle, Scan_WhenGuarded_ThenNeitherAllocatesNorLocks) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  ScanFixture f;
  f.cycle.start({});
  ASSERT_TRUE(f.cycle.forces().set({.address = L::kOutputs, .bit = 3, .size = 1, .value = 1},
                                   f.program.image().bytes().size()));
  const support::GuardCounts before = support::guard_counts();
  for (int i = 0; i < 50; ++i) f.cycle.run_scan();
  f.driver.reads_good = false;
  f.cycle.run_scan();
  f.cycle.start({});
  f.cycle.stop();
  EXPECT_EQ(support::guard_counts(), before);
}

// The guard itself must be able to fail.
TEST(MallocGuard, Counts_WhenMemoryIsTakenOrAMutexLocked_ThenGrow) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  const support::GuardCounts before = support::guard_counts();
  {
    std::vector<std::byte> block(100);
    ASSERT_EQ(block.size(), 100u);
    // Keeps the compiler from removing the allocation.
    asm volatile("" : : "r"(block.data()) : "memory");
  }
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  pthread_mutex_unlock(&mutex);
  const support::GuardCounts after = support::guard_counts();
  EXPECT_EQ(after.allocations, before.allocations + 1);
  EXPECT_EQ(after.frees, before.frees + 1);
  EXPECT_EQ(after.locks, before.locks + 1);
}

}  // namespace
}  // namespace stepwright::scan
