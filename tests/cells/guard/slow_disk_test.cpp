// The end of a runtime whose disk does not answer: safe outputs and their release do not wait for it, and
// what is retained is written when it does.

#include <filesystem>
#include <fstream>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "tests/cells/guard/guarded_cell.h"

namespace stepwright::cells {
namespace {

using io_memory::Owner;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // its library has to be the first
#else
constexpr bool kSanitized = false;
#endif

// As guarded_program, with a number that is retained.
std::vector<std::byte> counting_program() {
  const std::string text =
      "PROGRAM MAIN\nVAR a AT %QB0 : USINT; END_VAR VAR RETAIN total : DINT; END_VAR\n"
      "a := 16#0F; total := total + 1;\nEND_PROGRAM\n";
  return std::move(driver::compile({{{"counting.st", text}}})->container);
}

double total(service::Connection& client) {
  const auto snapshot = client.snapshot();
  if (!snapshot) return -1.0;
  const auto container = counting_program();
  return reader::read_number(*reader::ProgramInfo::read(container)->find("MAIN.total"), snapshot->image);
}

TEST(SlowDisk, WhenTheRuntimeIsToEnd_ThenItsOutputsAreSafeAndItsValuesAreKept) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer has to be loaded first";
  // Values go to the disk at the end only.
  GuardedCell cell("[guard]\nenabled = true\ntimeout_ms = 500\n[retain]\nperiod_ms = 60_000\n");
  const std::filesystem::path gate = cell.folder() / "the disk is slow";
  TestProcess runtime(
      {"/usr/bin/env", "LD_PRELOAD=" STEPWRIGHT_SLOW_DISK, "STEPWRIGHT_SLOW_DISK=" + gate.string(),
       STEPWRIGHT_BIN_DIR "/stepwright", "runtime", "--config", cell.config().string()},
      cell.folder() / "slow.log");
  ASSERT_TRUE(runtime.wait_for("listens on")) << runtime.output();
  ASSERT_TRUE(cell.attach());
  ASSERT_TRUE(cell.client->download(counting_program(), kPatience));
  ASSERT_TRUE(cell.client->call(service::Start{}, kPatience));
  ASSERT_TRUE(cell.wait([&] { return total(*cell.client) >= 20; }));
  std::ofstream(gate) << "yes";
  runtime.send(SIGTERM);
  EXPECT_TRUE(cell.wait([&] { return cell.plant->owner() == Owner::Released; }));
  EXPECT_EQ(cell.output(0), kStop);
  std::filesystem::remove(gate);
  EXPECT_EQ(runtime.wait(), 0) << runtime.output();
  EXPECT_EQ(cell.output(0), kStop);

  TestProcess next = cell.start("runtime");
  ASSERT_TRUE(next.wait_for("listens on")) << next.output();
  ASSERT_TRUE(cell.attach());
  ASSERT_TRUE(cell.client->download(counting_program(), kPatience));
  ASSERT_TRUE(cell.client->call(service::Start{}, kPatience));
  EXPECT_TRUE(cell.wait([&] { return total(*cell.client) > 20; }));
  next.send(SIGTERM);
  EXPECT_EQ(next.wait(), 0);
}

}  // namespace
}  // namespace stepwright::cells
