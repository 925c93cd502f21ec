#include "runtime/record/state_layout.h"

#include <gtest/gtest.h>

#include "runtime/record/retain_area.h"
#include "tests/unit/runtime/record/two_programs.h"

namespace stepwright::record {
namespace {

StateLayout layout_of(const std::string& text) {
  const support::CompiledProgram program({{{"test.st", text}}});
  return StateLayout::of(program.loaded().program()).value();
}

TEST(StateLayout, WhenVariablesAreOfManyKinds_ThenEachHasPathTypeAndPlace) {
  const StateLayout layout = layout_of(
      "TYPE Point : STRUCT x : REAL; y : REAL; END_STRUCT; END_TYPE\n" +
      program("VAR n : DINT; p : Point; a : ARRAY[2..4] OF INT; s : STRING[10]; t : TON; END_VAR\n"
              "VAR CONSTANT c : INT := 7; END_VAR VAR RETAIN r : LINT; END_VAR VAR_TEMP x : INT; END_VAR"));
  ASSERT_NE(layout.find("main.N"), nullptr);
  ASSERT_NE(layout.find("MAIN.p.x"), nullptr);
  EXPECT_EQ(layout.find("MAIN.p"), nullptr);
  const StateVariable* array = layout.find("MAIN.a");
  ASSERT_NE(array, nullptr);
  EXPECT_TRUE(array->is_array);
  EXPECT_EQ(array->count, 3u);
  EXPECT_EQ(array->lower, 2);
  EXPECT_EQ(layout.type_of(*array).size, 2u);
  EXPECT_EQ(layout.type_of(*layout.find("MAIN.s")).capacity, 10u);
  EXPECT_NE(layout.find("MAIN.t.ET"), nullptr);
  EXPECT_NE(layout.find("MAIN.c")->flags & kStateConstant, 0);
  EXPECT_NE(layout.find("MAIN.r")->flags & kStateRetain, 0);
  EXPECT_EQ(layout.find("MAIN.n")->flags, 0);
  EXPECT_EQ(layout.find("MAIN.x"), nullptr);
}

TEST(StateLayout, WhenAnInputSensesAnEdge_ThenItsMemoryIsListedAsHidden) {
  const StateLayout layout = layout_of(
      "FUNCTION_BLOCK Count VAR_INPUT go : BOOL R_EDGE; END_VAR VAR_OUTPUT n : INT; END_VAR\n"
      "IF go THEN n := n + 1; END_IF; END_FUNCTION_BLOCK\n" +
      program("VAR c : Count; END_VAR"));
  const StateVariable* memory = layout.find("MAIN.c.go#BEFORE");
  ASSERT_NE(memory, nullptr);
  EXPECT_NE(memory->flags & kStateHidden, 0);
}

TEST(StateLayout, WhenEncoded_ThenDecodeGivesItBack) {
  const StateLayout layout = layout_of(
      "TYPE Mode : (IDLE, RUN := 5); Level : INT(0..100); END_TYPE\n" +
      program("VAR m : Mode; l : Level; s : WSTRING[3]; o AT %QX0.3 : BOOL; r : REF_TO INT; END_VAR"));
  const auto decoded = StateLayout::decode(layout.encoded());
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, layout);
  EXPECT_EQ(decoded->digest(), layout.digest());
  EXPECT_NE(decoded->find("main.L"), nullptr);
}

// Whatever the bytes are, the answer is a layout whose variables lie inside of it, or a refusal.
TEST(StateLayout, WhenBytesAreCutOrChanged_ThenDecodeRefusesOrStaysInside) {
  const std::vector<std::byte> good =
      layout_of(program("VAR a : ARRAY[0..3] OF INT; b : BOOL; END_VAR")).encoded();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(StateLayout::decode(std::span(good).first(size))) << size;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const int value : {0, 1, 0x7F, 0xFF}) {
      std::vector<std::byte> bytes = good;
      bytes[at] = static_cast<std::byte>(value);
      const auto decoded = StateLayout::decode(bytes);
      if (!decoded) continue;
      for (const StateVariable& each : decoded->variables()) {
        const std::uint64_t end =
            std::uint64_t{each.address} + std::uint64_t{each.count} * decoded->type_of(each).size;
        EXPECT_LE(end, decoded->size());
      }
    }
  }
}

TEST(RetainArea, WhenVariablesAreRetained_ThenThePayloadHoldsThemAndNothingElse) {
  support::CompiledProgram machine({{{"test.st", program("VAR RETAIN a : DINT; b : DINT; END_VAR\n"
                                                         "VAR free : DINT; END_VAR\n"
                                                         "VAR RETAIN c : INT; END_VAR")}}});
  const auto& loaded = machine.loaded().program();
  const RetainArea area = RetainArea::of(loaded);
  EXPECT_EQ(area.size(), 10u);
  machine.set("MAIN.a", 1);
  machine.set("MAIN.b", 2);
  machine.set("MAIN.free", 3);
  machine.set("MAIN.c", 4);
  std::vector<std::byte> payload(area.size());
  area.gather(machine.image().bytes(), payload);
  const StateLayout stored = area.in_payload(StateLayout::of(loaded).value());
  EXPECT_EQ(stored.variables().size(), 3u);
  EXPECT_EQ(stored.size(), 10u);
  EXPECT_EQ(std::to_integer<int>(payload[stored.find("MAIN.b")->address]), 2);
  EXPECT_EQ(std::to_integer<int>(payload[stored.find("MAIN.c")->address]), 4);
}

}  // namespace
}  // namespace stepwright::record
