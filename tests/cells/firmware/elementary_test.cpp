// The elementary functions of the boards (newlib) beside those of the host (glibc): a REAL has the same bits,
// an LREAL differs by one or two units in the last place now and then (firmware/README.md).

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "firmware/app/limits.h"
#include "ladder/driver/compile.h"
#include "tests/cells/firmware/rig.h"
#include "tests/support/lock_step/host_machine.h"

namespace stepwright::firmware_test {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::array<const char*, 11> kFunctions = {"SIN(x * 10.0)",
                                                    "COS(x * 10.0)",
                                                    "TAN(x)",
                                                    "ASIN(x)",
                                                    "ACOS(x)",
                                                    "ATAN(x * 4.0)",
                                                    "EXP(x * 20.0)",
                                                    "LN(ABS(x) + 1.0)",
                                                    "LOG(ABS(x) + 1.0)",
                                                    "EXPT(ABS(x) + 0.5, x * 9.0)",
                                                    "ATAN2(x, x + 0.3)"};

// Every function in double precision, then in single precision.
Bytes program() {
  std::string variables = "x AT %IL0 : LREAL;";
  std::string code;
  std::string single;
  for (std::size_t i = 0; i < kFunctions.size(); ++i) {
    const std::string n = std::to_string(i);
    variables += "d" + n + " AT %QL" + n + " : LREAL; f" + n + " AT %QD" +
                 std::to_string(2 * kFunctions.size() + i) + " : REAL;";
    code += "d" + n + " := " + kFunctions[i] + ";\n";
    std::string call = kFunctions[i];
    for (std::size_t at = 0; (at = call.find('x', at)) != std::string::npos; ++at) call[at] = 's';
    single += "f" + n + " := " + call + ";\n";
  }
  driver::CompileInput input;
  input.texts.push_back({"functions.st", "PROGRAM main VAR s : REAL; " + variables +
                                             " END_VAR\ns := LREAL_TO_REAL(x);\n" + code + single +
                                             "END_PROGRAM"});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return std::move(output->container);
}

TEST(Elementary, Functions_WhenArgumentsAreRandom_ThenRealsAreEqualAndLrealsNeighbours) {
  constexpr int kArguments = 300;
  Rig rig("mps2-an386");
  const Bytes container = program();
  rig.controller().download(container);
  rig.controller().start_lock_step();
  support::HostMachine host(container, host::EngineKind::Vm, app::kBudget);
  std::array<int, kFunctions.size()> different{};
  std::mt19937 random(1);
  for (int i = 0; i < kArguments; ++i) {
    const double x = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    Bytes inputs(sizeof(x));
    std::memcpy(inputs.data(), &x, sizeof(x));
    const auto outputs = rig.controller().turn(inputs).outputs;
    ASSERT_FALSE(host.scan(inputs).trap) << x;
    for (std::size_t f = 0; f < kFunctions.size(); ++f) {
      std::int64_t here = 0;
      std::int64_t there = 0;
      std::memcpy(&here, outputs.data() + 8 * f, 8);
      std::memcpy(&there, host.image().outputs().data() + 8 * f, 8);
      EXPECT_LE(std::abs(here - there), 2) << kFunctions[f] << " of " << x;
      different[f] += here != there ? 1 : 0;
      const std::size_t single = 8 * kFunctions.size() + 4 * f;
      EXPECT_EQ(std::memcmp(outputs.data() + single, host.image().outputs().data() + single, 4), 0)
          << kFunctions[f] << " of " << x << " as REAL";
    }
  }
  for (std::size_t f = 0; f < kFunctions.size(); ++f)
    std::printf("%-28s differs in its last bits for %3d of %d\n", kFunctions[f], different[f], kArguments);
}

}  // namespace
}  // namespace stepwright::firmware_test
