// The same container gives the same trace on the boards as on both engines of the host, scan by scan: the
// language tests, random inputs, one request a scan.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "firmware/app/limits.h"
#include "ladder/driver/compile.h"
#include "tests/cells/firmware/rig.h"
#include "tests/st/check_program.h"
#include "tests/support/lock_step/host_machine.h"
#include "tests/support/pou_library.h"
#include "tests/support/step_program.h"

namespace stepwright::firmware_test {
namespace {

using Bytes = std::vector<std::byte>;
constexpr int kScans = 12;
const std::string kPrograms = STEPWRIGHT_SOURCE_DIR "/tests/st/programs/";

// What the C libraries of the host and of the boards round differently in the last bit of an LREAL
// (firmware/README.md). A REAL is computed in double precision and rounded, so that it is the same.
const std::vector<std::string> kRoundedDifferently = {};

Bytes compiled(const std::string& name, const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({name, text});
  auto output = driver::compile(input);
  return output ? std::move(output->container) : Bytes();
}

class Comparison {
 public:
  Comparison(support::RemoteController& controller, const Bytes& container)
      : controller_(controller),
        vm_(container, host::EngineKind::Vm, app::kBudget),
        native_(container, host::EngineKind::Native, app::kBudget) {}

  // What differs; empty if nothing does.
  std::string run(int scans, std::uint32_t seed) {
    controller_.start_lock_step();
    const auto at = controller_.link().outputs({});
    if (!at) return result::to_string(at.error());
    vm_.start({at->next_ns, at->scan, at->trace_hash});
    native_.start({at->next_ns, at->scan, at->trace_hash});
    std::mt19937 random(seed);
    Bytes inputs(vm_.image().inputs().size());
    for (int i = 0; i < scans; ++i) {
      for (std::byte& byte : inputs) byte = static_cast<std::byte>(random());
      const auto host = vm_.scan(inputs);
      static_cast<void>(native_.scan(inputs));
      const auto board = controller_.turn(inputs);
      const std::string where = "scan " + std::to_string(i + 1) + ": ";
      if (native_.cycle().trace_hash() != vm_.cycle().trace_hash())
        return where + "the host's engines differ";
      if (board.head.trace_hash != vm_.cycle().trace_hash()) return where + "the trace differs";
      if (!std::ranges::equal(board.outputs, vm_.image().outputs())) return where + "the outputs differ";
      if (host.trap) return same_trap(host.trap) ? "" : where + "the trap differs";
    }
    return "";
  }

 private:
  bool same_trap(const bytecode::Trap& trap) { return controller_.status().trap == trap; }

  support::RemoteController& controller_;
  support::HostMachine vm_;
  support::HostMachine native_;
};

// False if this controller has no place for the program, or lacks an operation that it needs.
bool takes(Rig& rig, const Bytes& container) {
  rig.controller().send(container);
  const auto answer = rig.controller().command(modbus::control::Command::TransferCommit);
  if (answer.done()) return true;
  EXPECT_EQ(answer.refusal, modbus::control::Refusal::NotSupported);
  return false;
}

class BoardTrace : public testing::TestWithParam<const char*> {
 protected:
  bool fits(const Bytes& container) { return takes(rig, container); }
  Rig rig{GetParam()};
};

// The folders that show most, and one of every `kShare` programs of the others; each on one of the boards, so
// that the whole takes seconds. With STEPWRIGHT_FIRMWARE_ALL set: everything on both.
constexpr std::size_t kShare = 10;
bool is_of_the_sample(const std::string& name, std::size_t number, std::size_t board) {
  if (std::getenv("STEPWRIGHT_FIRMWARE_ALL") != nullptr) return true;
  if (number % 2 != board) return false;
  for (const char* folder : {"tour/", "library/", "6.7_sfc/"}) {
    if (name.starts_with(folder)) return true;
  }
  return number / 2 % kShare == 0;
}

TEST_P(BoardTrace, Trace_WhenLanguageTestsRun_ThenIsThatOfTheHost) {
  const std::size_t board = GetParam() == std::string("mps2-an386") ? 1 : 0;
  int compared = 0;
  int refused = 0;
  const auto names = st_test::programs_below(kPrograms);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_of_the_sample(names[i], i, board) || std::ranges::count(kRoundedDifferently, names[i]) != 0)
      continue;
    const Bytes container = compiled(names[i], st_test::read_file(kPrograms + names[i]));
    if (container.empty()) continue;  // a test of the compiler's diagnostics
    if (!fits(container)) {
      ++refused;
      continue;
    }
    EXPECT_EQ(Comparison(rig.controller(), container).run(kScans, static_cast<std::uint32_t>(i)), "")
        << names[i];
    ++compared;
  }
  std::printf("%d programs compared, %d refused\n", compared, refused);
  EXPECT_GT(compared, 40);
  EXPECT_LT(refused, 5);
}

TEST_P(BoardTrace, Trace_WhenAProgramHasInputsAndCharts_ThenIsThatOfTheHostForManyScans) {
  const Bytes container = compiled("inputs.st", R"(
    PROGRAM main
    VAR
      buttons AT %IB0 : BYTE; level AT %IW1 : INT; setpoint AT %ID1 : DINT;
      lamps AT %QB0 : BYTE; valve AT %QW1 : INT; flow AT %QD1 : REAL;
      filter : REAL; delay : TON; count : CTU;
    END_VAR
      delay(IN := (buttons AND 16#01) <> 0, PT := T#30ms);
      count(CU := (buttons AND 16#02) <> 0, R := (buttons AND 16#04) <> 0, PV := 5);
      filter := filter * 0.9 + INT_TO_REAL(level) * 0.1;
      flow := SQRT(ABS(filter)) + SIN(filter) - LN(1.0 + ABS(filter));
      valve := REAL_TO_INT(filter);
      lamps := (buttons XOR 16#A5) OR SEL(delay.Q, 16#00, 16#40) OR SEL(count.Q, 16#00, 16#80);
      IF setpoint > 1000000 THEN valve := -valve; END_IF;
    END_PROGRAM)");
  ASSERT_TRUE(fits(container));
  EXPECT_EQ(Comparison(rig.controller(), container).run(400, 1), "");
  ASSERT_TRUE(fits(support::step_program({.steps = 5, .scans_per_step = 7})));
  EXPECT_EQ(Comparison(rig.controller(), support::step_program({.steps = 5, .scans_per_step = 7})).run(60, 2),
            "");
}

// What its operation set leaves out is refused at the download; whatever it takes runs as it does everywhere.
TEST(BasicImage, Trace_WhenLanguageTestsRun_ThenIsThatOfTheHostOrTheyAreRefused) {
  constexpr std::size_t kEvery = 9;
  Rig rig("mps2-an385-basic");
  int compared = 0;
  int refused = 0;
  const auto names = st_test::programs_below(kPrograms);
  for (std::size_t i = 4; i < names.size(); i += kEvery) {
    const Bytes container = compiled(names[i], st_test::read_file(kPrograms + names[i]));
    if (container.empty()) continue;
    if (!takes(rig, container)) {
      ++refused;
      continue;
    }
    EXPECT_EQ(Comparison(rig.controller(), container).run(kScans, static_cast<std::uint32_t>(i)), "")
        << names[i];
    ++compared;
  }
  std::printf("%d programs compared, %d refused\n", compared, refused);
  EXPECT_GT(compared, 20);
  EXPECT_GT(refused, 0) << "programs with strings are among them";
  EXPECT_FALSE(
      takes(rig, compiled("sine.st", "PROGRAM main VAR x : REAL; END_VAR x := SIN(x); END_PROGRAM")));
  const Bytes chart = support::step_program({.steps = 5, .scans_per_step = 7});
  ASSERT_TRUE(takes(rig, chart));
  EXPECT_EQ(Comparison(rig.controller(), chart).run(60, 2), "");
}

INSTANTIATE_TEST_SUITE_P(Boards, BoardTrace, testing::Values("mps2-an385", "mps2-an386"),
                         [](const auto& each) {
                           return each.param == std::string("mps2-an385") ? "M3" : "M4F";
                         });

}  // namespace
}  // namespace stepwright::firmware_test
