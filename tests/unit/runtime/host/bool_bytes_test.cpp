#include "runtime/host/bool_bytes.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/compiled_program.h"

namespace stepwright::host {
namespace {

constexpr const char* kProgram = R"(
PROGRAM main
VAR
  input AT %IX0.0 : BOOL;
  number : USINT;
  lamps : ARRAY[0..2] OF BOOL;
END_VAR
lamps[0] := input;
END_PROGRAM
)";

TEST(BoolBytes, WhenAWriteCoversBools_ThenEachOfThemIsZeroOrOne) {
  driver::CompileInput input;
  input.texts.push_back({"test.st", kProgram});
  const support::CompiledProgram program(input);
  const BoolBytes bools = BoolBytes::of(program.loaded().program(), "test").value();
  const std::uint32_t lamps = program.find("main.lamps[0]").address;
  EXPECT_EQ(bools.settled(lamps, 4, 0xFF008002) & 0xFFFFFF, 0x000101u);
  EXPECT_EQ(bools.settled(program.find("main.number").address, 1, 0x80), 0x80u);
  std::array in_place = {std::byte{2}, std::byte{0x80}, std::byte{0}};
  bools.settle(lamps, in_place);
  EXPECT_EQ(in_place, (std::array{std::byte{1}, std::byte{1}, std::byte{0}}));
  EXPECT_FALSE(bools.holds(program.find("main.input").address));  // bits of a byte of I/O
  EXPECT_FALSE(bools.holds(0xFFFFFFFF));
}

TEST(BoolBytes, WhenABoolLiesBehindAnyNumberOfValues_ThenItIsOneToo) {
  driver::CompileInput input;
  input.texts.push_back({"test.st",
                         "PROGRAM main VAR many : ARRAY[0..250000] OF BYTE; last : BOOL; END_VAR\n"
                         "last := TRUE; END_PROGRAM"});
  const support::CompiledProgram program(input);
  const BoolBytes bools = BoolBytes::of(program.loaded().program(), "test").value();
  const std::uint32_t last = program.find("main.last").address;
  EXPECT_TRUE(bools.holds(last));
  EXPECT_FALSE(bools.holds(last - 1));
  EXPECT_EQ(bools.settled(last, 1, 0x80), 1u);
}

}  // namespace
}  // namespace stepwright::host
