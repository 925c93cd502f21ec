// Values of every type that two tasks write: whoever reads one finds what one of them wrote, never a mixture.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/merge_map.h"
#include "runtime/image/no_io.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"
#include "runtime/vm/interpreter.h"
#include "tests/unit/runtime/host/every_type.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

// Some tasks of a program, on memory of their own.
class OwnTasks {
 public:
  OwnTasks(const bytecode::Program& program, std::uint32_t tasks)
      : memory_(program.memory_size()),
        stack_(program.sizes().stack_slots),
        image_(memory_, scan::layout_of(program)),
        safe_(image_.outputs().size()),
        engine_(program, stack_),
        cycle_(program, engine_, image_, safe_, io_, clock_, {.own_tasks = tasks}) {
    cycle_.start({});
  }

  std::span<std::byte> bytes() { return image_.bytes(); }
  scan::ScanReport scan() { return cycle_.run_scan(); }

 private:
  std::vector<std::byte> memory_;
  std::vector<std::uint64_t> stack_;
  image::ProcessImage image_;
  std::vector<std::byte> safe_;
  vm::Interpreter engine_;
  image::NoIo io_;
  scan::NoClock clock_;
  scan::ScanCycle cycle_;
};

std::vector<std::byte> copy_of(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

// As long as the long mode of the tests says (scripts/sanitizers); else no longer than it takes.
std::chrono::seconds long_run() {
  const char* seconds = std::getenv("STEPWRIGHT_LONG_S");
  return std::chrono::seconds(seconds == nullptr ? 0 : std::atoi(seconds));
}

// The slow task takes its copy, the fast one scans, the slow one gives its copy back: as threads do, in an
// order that is always the same.
TEST(TwoWriters, WhenTasksPreemptEachOtherInSimulatedTime_ThenEveryValueIsWhole) {
  const auto loaded = reader::LoadedProgram::load(compiled(two_writers(0)), "test").value();
  const auto info = reader::ProgramInfo::read(loaded.bytes()).value();
  const MergeMap map = MergeMap::of(loaded.program(), "test").value();
  OwnTasks fast(loaded.program(), 1u << 0), slow(loaded.program(), 1u << 1);
  const auto number = [&](const char* name) { return reader::read_number(*info.find(name), fast.bytes()); };
  for (int merge = 1; merge <= 5'000; ++merge) {
    const std::vector<std::byte> before = copy_of(fast.bytes());
    std::memcpy(slow.bytes().data(), before.data(), before.size());
    for (int turn = 0; turn < merge % 4; ++turn) ASSERT_FALSE(fast.scan().trap);
    ASSERT_FALSE(slow.scan().trap);
    map.merge(before, slow.bytes(), fast.bytes());
    ASSERT_FALSE(fast.scan().trap);
    ASSERT_EQ(number("bad"), 0) << "after " << merge << " merges, of kind " << number("which");
  }
  EXPECT_EQ(number("merges"), 5'000);
}

TEST(TwoWriters, WhenTasksHaveThreads_ThenEveryValueIsWhole) {
  HostConfig config;
  config.clock = ClockMode::Real;
  config.engine = EngineKind::Vm;  // long enough for the fast task to come in between
  const std::vector<std::byte> container = compiled(two_writers(20'000));
  const auto info = reader::ProgramInfo::read(container).value();
  Harness harness(config, false);
  ASSERT_EQ(harness.load(container), Outcome::Done);
  ASSERT_EQ(harness.start(), Outcome::Done);
  const auto number = [&](const char* name) {
    return reader::read_number(*info.find(name), harness.image());
  };
  const auto end = std::chrono::steady_clock::now() + long_run();
  double merges = 200;
  do {
    ASSERT_TRUE(harness.wait([&] { return number("merges") >= merges || number("bad") > 0; }));
    merges += 200;
  } while (number("bad") == 0 && std::chrono::steady_clock::now() < end);
  EXPECT_EQ(number("bad"), 0) << "of kind " << number("which");
  EXPECT_EQ(harness.runtime->status().state, RuntimeState::Running);
}

}  // namespace
}  // namespace stepwright::host
