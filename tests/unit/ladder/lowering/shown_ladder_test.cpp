// Rungs as a reader sees them: no wires, each contact where it was drawn.

#include "ladder/lowering/shown_ladder.h"

#include <gtest/gtest.h>

namespace stepwright::lowering {
namespace {

using graphic::all;
using graphic::any;
using graphic::Block;
using graphic::Coil;
using graphic::CoilKind;
using graphic::Condition;
using graphic::contact;
using graphic::LadderProgram;
using graphic::Rung;

constexpr const char* kWire = "__W0_";

Rung rung(Condition condition, const std::string& coil, bool goes_on = true) {
  Rung result;
  result.condition = std::move(condition);
  result.coils.push_back({CoilKind::Normal, coil});
  result.goes_on = goes_on;
  return result;
}

LadderProgram with_wire(std::vector<Rung> rungs, bool keeps = false) {
  return {std::move(rungs), {{kWire, "BOOL", keeps}}};
}

TEST(ShownLadder, WhenOneContactReadsAWire_ThenItsLineStandsThere) {
  Rung first = rung(all({contact("a"), contact("b", true)}), kWire, false);
  first.comment = "the pump";
  first.label = "again";
  const LadderProgram shown = shown_ladder(
      with_wire({std::move(first), rung(contact("c"), "x"), rung(any({contact(kWire), contact("d")}), "y")}));
  ASSERT_EQ(shown.rungs.size(), 2u);
  EXPECT_EQ(shown.rungs[0].coils[0].variable, "x");
  EXPECT_EQ(shown.rungs[0].comment, "the pump");
  EXPECT_EQ(shown.rungs[0].label, "again");
  EXPECT_FALSE(shown.rungs[0].goes_on);
  EXPECT_TRUE(shown.rungs[1].goes_on);
  EXPECT_EQ(shown.rungs[1].condition, any({all({contact("a"), contact("b", true)}), contact("d")}));
  EXPECT_TRUE(shown.wires.empty());
}

TEST(ShownLadder, WhenAWireIsReadNegated_ThenItsLineIsTheNegation) {
  const LadderProgram shown = shown_ladder(
      with_wire({rung(all({contact("a"), contact("b")}), kWire, false), rung(contact(kWire, true), "x")}));
  ASSERT_EQ(shown.rungs.size(), 1u);
  EXPECT_EQ(shown.rungs[0].condition, graphic::negation(all({contact("a"), contact("b")})));
}

TEST(ShownLadder, WhenLinesFollowEachOther_ThenTheyAreOne) {
  LadderProgram ladder{
      {rung(contact("a"), "__W0_", false), rung(all({contact("__W0_"), contact("b")}), "__W1_"),
       rung(all({contact("__W1_"), contact("c")}), "x")},
      {{"__W0_", "BOOL", false}, {"__W1_", "BOOL", false}}};
  const LadderProgram shown = shown_ladder(std::move(ladder));
  ASSERT_EQ(shown.rungs.size(), 1u);
  EXPECT_EQ(shown.rungs[0].condition, all({contact("a"), contact("b"), contact("c")}));
}

TEST(ShownLadder, WhenAWireIsReadTwice_ThenItIsAConnector) {
  const LadderProgram shown = shown_ladder(
      with_wire({rung(contact("a"), kWire, false), rung(all({contact(kWire), contact("b")}), "x"),
                 rung(contact(kWire, true), "y")}));
  ASSERT_EQ(shown.rungs.size(), 3u);
  EXPECT_EQ(shown.rungs[0].coils[0].variable, ">1>");
  EXPECT_EQ(shown.rungs[1].condition, all({contact(">1>"), contact("b")}));
  EXPECT_EQ(shown.rungs[2].condition, contact(">1>", true));
}

TEST(ShownLadder, WhenATextReadsAWire_ThenItIsAConnector) {
  Rung counter = rung(graphic::always(), "z");
  Block block;
  block.type = "CTU";
  block.instance = "c";
  block.inputs = {{"CU", kWire}, {"PV", "x__W0_ + 1"}};
  counter.blocks.push_back(block);
  const LadderProgram shown = shown_ladder(with_wire({rung(contact("a"), kWire, false), std::move(counter)}));
  ASSERT_EQ(shown.rungs.size(), 2u);
  EXPECT_EQ(shown.rungs[0].coils[0].variable, ">1>");
  EXPECT_EQ(shown.rungs[1].blocks[0].inputs[0].second, ">1>");
  EXPECT_EQ(shown.rungs[1].blocks[0].inputs[1].second, "x__W0_ + 1");
}

TEST(ShownLadder, WhenAWireKeepsItsValue_ThenItIsAConnector) {
  const LadderProgram shown =
      shown_ladder(with_wire({rung(contact(kWire), "x", false), rung(contact("a"), kWire)}, true));
  ASSERT_EQ(shown.rungs.size(), 2u);
  EXPECT_EQ(shown.rungs[0].condition, contact(">1>"));
  EXPECT_EQ(shown.rungs[1].coils[0].variable, ">1>");
}

}  // namespace
}  // namespace stepwright::lowering
