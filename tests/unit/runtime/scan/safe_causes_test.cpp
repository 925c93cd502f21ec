// Every cause in the scan, for every mode: how many scans it takes until the outputs are safe.

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/scan/scan_fixture.h"

namespace stepwright::scan {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;

// A clock that a test advances while the program runs.
class TestClock final : public Clock {
 public:
  std::int64_t now_ns() override {
    const std::int64_t now = now_;
    now_ += step;
    return now;
  }
  std::int64_t step = 0;  // between two looks

 private:
  std::int64_t now_ = 0;
};

// Lost at the scan that a test asks for; counts the writes.
class Driver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    inputs[0] = std::byte{input};
    return good ? image::IoStatus::Good : image::IoStatus::Lost;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    std::memcpy(written.data(), outputs.data(), written.size());
    return image::IoStatus::Good;
  }
  std::uint8_t input = 1;
  bool good = true;
  std::array<std::byte, 8> written{};
};

// MAIN sets all outputs to 0x64 (%QW2 and %QW3 then hold 0x6464 = 25700), then divides by %IB0, and loops for
// ever if that is 2.
writer::ContainerModel model() {
  writer::ContainerModel m = support::one_program(4, [](writer::FunctionBuilder& f) {
    for (std::uint32_t byte = 0; byte < 8; ++byte) {
      f.const_i32(0x64);
      f.store(MemType::U8, AddressMode::Abs, 4 + byte);
    }
    const auto again = f.new_label();
    f.bind(again);
    f.load(MemType::U8, AddressMode::Abs, 0);
    f.const_i32(2);
    f.emit(bytecode::Opcode::EqI32);
    f.jump_if_true(again);
    f.const_i32(100);
    f.load(MemType::U8, AddressMode::Abs, 0);
    f.emit(bytecode::Opcode::DivI32);
    f.store(MemType::I32, AddressMode::This, 0);
  });
  m.sizes = {4, 8, 0, 4};
  m.tasks[0].calls[0].instance = 12;
  return m;
}

// %QB0 zero, %QB1 hold, %QB2..3 = %QW1 value 500, %QB4..5 = %QW2 ramp to 0 at 10000 a second; plus the cause
// in %QB7.
struct Rules {
  std::array<std::vector<SafeOutput>, kSafeCauses> outputs;
  std::vector<SafeRamp> ramps = {{.byte = 4, .type = RampType::I16, .target = 0, .per_second = 10'000}};
  SafeMatrix matrix;

  Rules() {
    for (std::size_t i = 0; i < kSafeCauses; ++i) {
      outputs[i] = {{.byte = 1, .mode = SafeMode::Hold},
                    {.byte = 2, .mode = SafeMode::Value, .value = 500 & 0xFF},
                    {.byte = 3, .mode = SafeMode::Value, .value = 500 >> 8},
                    {.byte = 7, .mode = SafeMode::Value, .value = static_cast<std::uint8_t>(i + 1)}};
      matrix[i] = {outputs[i], ramps};
    }
  }
};

struct Plant {
  explicit Plant(ScanConfig config = {})
      : program(model()),
        cycle(program.loaded().program(), program.engine(), program.image(), safe_outputs, driver, clock,
              [&] {
                config.safe_state = rules.matrix;
                config.tasks = options;
                config.budget = 100'000;
                return config;
              }()) {
    cycle.start({});
    for (int i = 0; i < 5; ++i) EXPECT_EQ(cycle.run_scan().state, ScanState::Running);
    EXPECT_EQ(driver.written[0], std::byte{0x64});
  }

  // Safe for this cause, at the beginning of the ramp or on its way.
  bool safe(SafeCause cause, std::int16_t ramp) const {
    std::int16_t word = 0;
    std::int16_t value = 0;
    std::memcpy(&value, driver.written.data() + 2, 2);
    std::memcpy(&word, driver.written.data() + 4, 2);
    return driver.written[0] == std::byte{0} && driver.written[1] == std::byte{0x64} && value == 500 &&
           word == ramp && driver.written[6] == std::byte{0} &&
           std::to_integer<int>(driver.written[7]) == static_cast<int>(cause) + 1;
  }

  Rules rules;
  std::array<std::byte, 8> safe_outputs{};
  std::array<TaskOptions, 1> options{{{.watchdog = {.time_ns = 1'000'000, .sensitivity = 2}}}};
  support::TestProgram program;
  Driver driver;
  TestClock clock;
  ScanCycle cycle;
};

constexpr std::int16_t kStart = 0x6464;

// Scans from the one in which the cause happens until the outputs are safe, that one included.
int scans_until_safe(Plant& plant, SafeCause cause) {
  for (int scans = 1; scans <= 10; ++scans) {
    plant.cycle.run_scan();
    if (plant.safe(cause, kStart)) return scans;
  }
  return 0;
}

TEST(SafeCauses, WhenStopped_ThenSafeWithoutAScan) {
  for (const SafeCause cause : {SafeCause::Stop, SafeCause::SupervisorLost}) {
    Plant plant;
    plant.cycle.stop(cause);
    EXPECT_TRUE(plant.safe(cause, kStart));
  }
}

TEST(SafeCauses, WhenTheProgramTraps_ThenSafeInThatScan) {
  Plant plant;
  plant.driver.input = 0;
  EXPECT_EQ(scans_until_safe(plant, SafeCause::Trap), 1);
  EXPECT_EQ(plant.cycle.state(), ScanState::Trapped);
}

TEST(SafeCauses, WhenTheProgramLoopsForEver_ThenSafeInThatScan) {
  Plant plant;
  plant.driver.input = 2;
  EXPECT_EQ(scans_until_safe(plant, SafeCause::Watchdog), 1);
  EXPECT_EQ(plant.cycle.last_trap().code, bytecode::TrapCode::Watchdog);
}

TEST(SafeCauses, WhenTheTaskIsTooLongTwice_ThenSafeInTheSecondScan) {
  Plant plant;
  plant.clock.step = 1'500'000;  // of 1 ms, sensitivity 2
  EXPECT_EQ(scans_until_safe(plant, SafeCause::Watchdog), 2);
  EXPECT_EQ(plant.cycle.state(), ScanState::WatchdogExpired);
  EXPECT_EQ(plant.cycle.watchdog_report().took_ns, 1'500'000);
  EXPECT_EQ(plant.cycle.watchdog_report().too_long, 2u);
  EXPECT_EQ(plant.cycle.statistics().watchdogs, 1u);
}

TEST(SafeCauses, WhenTheTaskIsMuchTooLong_ThenSafeInThatScan) {
  Plant plant;
  plant.clock.step = 2'000'001;
  EXPECT_EQ(scans_until_safe(plant, SafeCause::Watchdog), 1);
}

TEST(SafeCauses, WhenTheDeviceDoesNotAnswer_ThenSafeInThatScan) {
  Plant plant;
  plant.driver.good = false;
  EXPECT_EQ(scans_until_safe(plant, SafeCause::IoLost), 1);
}

// The device is back, and somebody stops what does not run any more: only a start leaves the state.
TEST(SafeCauses, WhenAnotherCauseComesLater_ThenTheFirstStays) {
  Plant plant;
  plant.driver.good = false;
  plant.cycle.run_scan();
  plant.driver.good = true;
  plant.cycle.stop(SafeCause::Stop);
  EXPECT_TRUE(plant.safe(SafeCause::IoLost, kStart));
  plant.cycle.start({});
  plant.cycle.run_scan();
  EXPECT_EQ(plant.driver.written[0], std::byte{0x64});
}

TEST(SafeCauses, WhenScansGoOn_ThenTheRampMovesWithTheirClock) {
  Plant plant;
  plant.driver.input = 0;
  plant.cycle.run_scan();
  for (int i = 1; i <= 10; ++i) plant.cycle.run_scan();  // 10 ms each: 100 a scan
  EXPECT_TRUE(plant.safe(SafeCause::Trap, kStart - 1'000));
  for (int i = 0; i < 1'000; ++i) plant.cycle.run_scan();
  EXPECT_TRUE(plant.safe(SafeCause::Trap, 0));
  EXPECT_TRUE(plant.cycle.safe_state().settled());
}

// The scan that trapped had already changed the image: what Hold keeps is what was driven.
TEST(SafeCauses, WhenTheTrapIsInTheMiddleOfAScan_ThenItsHalfOutputsAreNotHeld) {
  Plant plant;
  plant.program.image().outputs()[1] = std::byte{0x11};  // as if the program had got that far
  plant.driver.good = false;                             // before it could write more
  plant.cycle.run_scan();
  EXPECT_TRUE(plant.safe(SafeCause::IoLost, kStart));
}

TEST(SafeCauses, WhenAnotherCycleTakesOver_ThenOutputsAndRampGoOn) {
  Plant plant;
  plant.cycle.stop();
  for (int i = 1; i <= 10; ++i) plant.cycle.idle(50'000'000 + i * 10'000'000);
  std::int16_t before = 0;
  std::memcpy(&before, plant.driver.written.data() + 4, 2);
  EXPECT_LT(before, kStart);
  Plant next;
  next.cycle.stop();
  next.cycle.inherit_outputs(plant.cycle.safe_state().outputs(), plant.cycle.safe_state().cause(),
                             1'000'000'000);
  next.cycle.idle(1'000'000'000);
  EXPECT_TRUE(next.safe(SafeCause::Stop, before));
  next.cycle.idle(1'100'000'000);
  EXPECT_TRUE(next.safe(SafeCause::Stop, static_cast<std::int16_t>(before - 1'000)));
}

TEST(SafeCauses, WhenFaultsHappen_ThenScansNeitherAllocateNorLock) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  Plant plant;
  const support::GuardCounts before = support::guard_counts();
  plant.driver.input = 0;
  for (int i = 0; i < 100; ++i) plant.cycle.run_scan();
  plant.cycle.stop();
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::scan
