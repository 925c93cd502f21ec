// The firmware on its boards: time, power, watchdog, masters that others wrote.

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

#include "firmware/storage/sha256.h"
#include "ladder/driver/compile.h"
#include "tests/cells/firmware/gdb_stub.h"
#include "tests/cells/firmware/rig.h"
#include "tests/support/patience.h"

namespace stepwright::firmware_test {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::byte>;
using modbus::control::Command;
using modbus::control::State;

Bytes compiled(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", text});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

const char* const kCounting = R"(
  PROGRAM main
  VAR input AT %IB0 : USINT; output AT %QB0 : USINT; scans AT %QW1 : INT; marker AT %MW0 : INT; END_VAR
  VAR RETAIN kept AT %MW2 : INT; END_VAR
    output := input;
    scans := scans + 1;
    kept := kept + 1;
  END_PROGRAM)";

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "no process";
  std::array<char, 512> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), count);
  ::pclose(pipe);
  return text;
}

// By arm-none-eabi-nm.
std::uint32_t address_of(const std::string& symbol) {
  const std::string text =
      output_of("arm-none-eabi-nm -C " + Rig::image("mps2-an385").string() + " | grep ' " + symbol + "$'");
  if (text.empty()) throw std::runtime_error("no symbol " + symbol);
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, 16));
}

std::uint16_t kept(Rig& rig) {
  std::array<std::uint16_t, 1> word{};
  // A busy machine may let an answer come too late: reading again does no harm.
  for (int tries = 0; tries < 10; ++tries) {
    if (rig.controller().line().read(1026, word).ok()) return word[0];
    std::this_thread::sleep_for(50ms);
  }
  ADD_FAILURE() << "the register cannot be read";
  return 0;
}

class Board : public testing::TestWithParam<const char*> {};

TEST_P(Board, Scans_WhenByTheClock_ThenKeepTimeWithTheWall) {
  Rig rig(GetParam());
  rig.controller().download(compiled(kCounting));
  auto begin = std::chrono::steady_clock::now();
  auto first = rig.controller().status();
  auto last = first;
  Bytes outputs;
  // A busy machine may hold the master up for half a second, which is a loss of the I/O: then once more. It
  // may let the board make few scans in a second as well: then until there are enough.
  for (int tries = 0; tries < 100 && last.state != State::Running; ++tries) {
    rig.controller().start(0);
    begin = std::chrono::steady_clock::now();
    first = rig.controller().status();
    const auto over = [&](std::chrono::steady_clock::duration time) {
      return std::chrono::steady_clock::now() - begin > time;
    };
    do {
      std::this_thread::sleep_for(20ms);
      outputs = rig.controller().turn(Bytes{std::byte{7}}).outputs;
      last = rig.controller().status();
    } while (last.state == State::Running && !over(support::kPatience) &&
             (!over(1s) || last.scan <= first.scan + 20));
  }
  const auto wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin);
  // A busy machine makes an emulator late, and cycles are left out then; but each is due once in 10 ms of the
  // board's clock, which is not ahead of the wall's.
  const auto due = static_cast<double>(last.scan - first.scan + last.overruns - first.overruns);
  EXPECT_NEAR(due, (last.uptime_ms - first.uptime_ms) / 10.0, 5);
  EXPECT_LE(last.uptime_ms - first.uptime_ms, wall.count() + 100);
  EXPECT_GT(last.scan, first.scan + 10);
  EXPECT_EQ(outputs[0], std::byte{7});
  rig.controller().expect_done(Command::Stop);
  EXPECT_EQ(rig.controller().turn(Bytes(1)).outputs[0], std::byte{0});
}

TEST_P(Board, Program_WhenPowerGoes_ThenIsThereAgainWithItsRetainedValues) {
  Rig rig(GetParam());
  const Bytes container = compiled(kCounting);
  rig.controller().download(container);
  rig.controller().start(modbus::control::kStartLockStep);
  for (int i = 0; i < 9; ++i) rig.controller().turn(Bytes(1));
  rig.controller().expect_done(Command::Stop);
  std::this_thread::sleep_for(50ms);
  rig.power_cycle();
  const auto status = rig.controller().status();
  EXPECT_EQ(status.state, State::Stopped);
  EXPECT_EQ(status.digest, storage::sha256(container));
  EXPECT_EQ(status.resets, 0);
  rig.controller().start(modbus::control::kStartLockStep);
  EXPECT_EQ(kept(rig), 9);
}

TEST_P(Board, Silence_WhenTheMasterIsAway_ThenOutputsAreSafe) {
  Rig rig(GetParam());
  rig.controller().download(compiled(kCounting));
  // By the board's own clock, which a busy machine makes late. The last sign of life is between the two
  // times: reading is none. Where the machine has held up the master for so long already, once more.
  std::uint32_t before_ms = 0;
  auto status = rig.controller().status();
  for (int tries = 0; tries < 100 && status.state != State::Running; ++tries) {
    rig.controller().start(0);
    before_ms = rig.controller().status().uptime_ms;
    rig.controller().turn(Bytes{std::byte{255}});
    status = rig.controller().status();
  }
  const std::uint32_t after_ms = status.uptime_ms;
  const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
  // A board that was held up answers before it looks at its clock, once.
  int late_answers = 0;
  while (status.state == State::Running && std::chrono::steady_clock::now() < deadline) {
    if (status.uptime_ms - after_ms >= 800u) ++late_answers;
    std::this_thread::sleep_for(20ms);
    status = rig.controller().status();
  }
  EXPECT_LE(late_answers, 1);
  EXPECT_EQ(status.state, State::Fault);
  EXPECT_GE(status.uptime_ms - before_ms, 400u);
  EXPECT_TRUE(status.inputs_lost());
  EXPECT_EQ(rig.controller().turn(Bytes(1)).outputs, Bytes(4));
}

INSTANTIATE_TEST_SUITE_P(Boards, Board, testing::Values("mps2-an385", "mps2-an386"), [](const auto& each) {
  return each.param == std::string("mps2-an385") ? "M3" : "M4F";
});

// The main loop is overwritten with a jump to itself, as a defect of the firmware would hang it.
TEST(Watchdog, Board_WhenTheMainLoopHangs_ThenIsResetAndKeepsProgramAndValues) {
  Rig rig("mps2-an385", {}, true);
  const Bytes container = compiled(kCounting);
  rig.controller().download(container);
  rig.controller().start(0);
  // Values are kept once in a second of the board's clock, which a busy machine makes late.
  const std::uint32_t begun_ms = rig.controller().status().uptime_ms;
  const auto deadline = std::chrono::steady_clock::now() + support::kPatience;
  while (rig.controller().status().uptime_ms - begun_ms < 2500 &&
         std::chrono::steady_clock::now() < deadline) {
    rig.controller().turn(Bytes(1));
    std::this_thread::sleep_for(50ms);
  }
  const auto before = kept(rig);
  {
    GdbStub gdb(rig.board().gdb_socket());
    gdb.write16(address_of("stepwright::app::Firmware::turn()") & ~1u, 0xE7FE);  // b .
  }
  std::array<std::uint16_t, 1> word{};
  EXPECT_FALSE(rig.controller().line().read(0xF000, word).ok());
  for (int i = 0; i < 20 && !rig.controller().link().status(); ++i)
    static_cast<void>(rig.controller().line().reopen());
  const auto status = rig.controller().status();
  EXPECT_EQ(status.flags & modbus::control::kWatchdogReset, modbus::control::kWatchdogReset);
  EXPECT_EQ(status.resets, 1);
  EXPECT_EQ(status.state, State::Stopped);
  EXPECT_EQ(status.digest, storage::sha256(container));
  rig.controller().start(modbus::control::kStartLockStep);
  EXPECT_GT(kept(rig), 0);
  EXPECT_LE(kept(rig), before);
}

// What the stack has not reached still holds the pattern of the start-up code.
TEST(Memory, Stack_WhenEverythingHasRun_ThenHasNotReachedItsEnd) {
  Rig rig("mps2-an385", {}, true);
  rig.controller().download(compiled(R"(
    PROGRAM main
    VAR s : STRING; r : LREAL; END_VAR
      r := SIN(r + 0.1) + EXP(r) / 3.0;
      s := CONCAT(LREAL_TO_STRING(r), '!');
    END_PROGRAM)"));
  rig.controller().start_lock_step();
  for (int i = 0; i < 20; ++i) rig.controller().turn({});
  GdbStub gdb(rig.board().gdb_socket());
  const auto bottom = address_of("stack_bottom_");
  const auto bytes = gdb.read(bottom, 2048);
  std::size_t untouched = 0;
  const std::array<std::uint8_t, 4> paint = {0x46, 0x52, 0x41, 0x57};
  while (untouched < bytes.size() && bytes[untouched] == paint[untouched % 4]) ++untouched;
  std::printf("stack: at least %zu of 6144 bytes were never used\n", untouched);
  EXPECT_GE(untouched, 512u);
}

TEST(Masters, Mbpoll_WhenItReadsAndWrites_ThenSeesTheProgram) {
  Rig rig("mps2-an385");
  rig.controller().download(compiled(kCounting));
  rig.controller().start(modbus::control::kStartLockStep);
  rig.controller().turn(Bytes{std::byte{0x5A}});
  const std::string poll = "mbpoll -m rtu -a 1 -b 115200 -P none -0 -1 -q -o 10 ";  // s to wait: its most
  const std::string line = " " + rig.board().line();
  EXPECT_NE(output_of(poll + "-t 4:hex -r 0 -c 2" + line).find("[0]: \t0x005A"), std::string::npos);
  EXPECT_NE(output_of(poll + "-t 4 -r 1024" + line + " 1234").find("Written 1 references"),
            std::string::npos);
  EXPECT_NE(output_of(poll + "-t 4 -r 1024 -c 1" + line).find("1234"), std::string::npos);
  EXPECT_NE(output_of(poll + "-t 0 -r 1 -c 1" + line).find("1"), std::string::npos);
  EXPECT_NE(output_of(poll + "-t 4 -r 9000 -c 1" + line).find("Illegal data address"), std::string::npos);
}

TEST(Masters, Pymodbus_WhenItReadsAndWrites_ThenSeesTheProgram) {
  Rig rig("mps2-an386");
  rig.controller().download(compiled(kCounting));
  rig.controller().start(modbus::control::kStartLockStep);
  const std::string script = STEPWRIGHT_SOURCE_DIR "/tests/cells/firmware/pymodbus_master.py";
  const std::string said = output_of("/usr/bin/python3 " + script + " " + rig.board().line());
  EXPECT_EQ(said, "all as expected\n");
}

}  // namespace
}  // namespace stepwright::firmware_test
