// Conditions and actions of a drawn chart as a reader sees them: no wires.

#include <gtest/gtest.h>

#include "ladder/lowering/shown_conditions.h"
#include "ladder/lowering/shown_ladder.h"
#include "ladder/lowering/shown_text.h"

namespace stepwright::lowering {
namespace {

using graphic::all;
using graphic::any;
using graphic::Block;
using graphic::CoilKind;
using graphic::Condition;
using graphic::contact;
using graphic::LadderProgram;
using graphic::Rung;

Rung line(Condition condition, const std::string& wire) {
  Rung rung;
  rung.condition = std::move(condition);
  rung.coils.push_back({CoilKind::Normal, wire});
  return rung;
}

Rung boxed(Block block, Condition condition = {}) {
  Rung rung;
  rung.condition = std::move(condition);
  rung.blocks.push_back(std::move(block));
  return rung;
}

Rung called(const std::string& type, std::vector<std::pair<std::string, std::string>> inputs,
            const std::string& wire, Condition condition = {}) {
  Block block;
  block.type = type;
  block.inputs = std::move(inputs);
  block.outputs = {{"", wire}};
  return boxed(std::move(block), std::move(condition));
}

Rung held(const std::string& wire, const std::string& value) {
  Block block;
  block.st_body = wire + " := " + value;
  return boxed(std::move(block));
}

LadderProgram networks(std::vector<Rung> rungs, const std::string& keeps = "") {
  LadderProgram program{std::move(rungs), {}};
  for (const char* name : {"__W0_", "__W1_", "__W2_"}) program.wires.push_back({name, "BOOL", name == keeps});
  return program;
}

std::string shown(const LadderProgram& program, const Condition& condition = contact("__W1_")) {
  return to_st(ShownConditions(program).drawn(condition));
}

Condition expression(const std::string& text, bool negated = false) {
  Condition condition = contact(text, negated);
  condition.kind = graphic::ConditionKind::Expression;
  return condition;
}

TEST(ShownConditions, WhenALineHoldsThem_ThenItStandsThere) {
  const LadderProgram program =
      networks({line(any({contact("a"), contact("b", true)}), "__W0_"), line(contact("__W0_"), "__W1_")});
  EXPECT_EQ(shown(program), "a OR NOT b");
  EXPECT_EQ(shown(program, all({contact("__W1_"), contact("c")})), "(a OR NOT b) AND c");
  EXPECT_EQ(shown(program, contact("__W1_", true)), "NOT (a OR NOT b)");
  EXPECT_EQ(shown(program, expression("n > 3 AND __W0_")), "(n > 3 AND (a OR NOT b))");
  EXPECT_EQ(shown(program, graphic::compare("__W0_", graphic::CompareOp::Equal, "__W1_")),
            "((a OR NOT b) = (a OR NOT b))");
  EXPECT_EQ(shown(program, all({contact("x"), contact("y")})), "x AND y");
  EXPECT_EQ(shown(program, {}), "TRUE");
}

TEST(ShownConditions, WhenAnEdgeIsSensed_ThenItIsThatOfItsLine) {
  Condition rising = contact("__W0_");
  rising.edge = graphic::Edge::Rising;
  EXPECT_EQ(shown(networks({line(all({contact("a"), contact("b")}), "__W0_")}), rising), "R_EDGE(a AND b)");
  Condition drawn = contact("a");
  drawn.edge = graphic::Edge::Falling;
  EXPECT_EQ(shown(networks({line(drawn, "__W0_")}), contact("__W0_", true)), "NOT F_EDGE(a)");
}

TEST(ShownConditions, WhenFunctionsHoldThem_ThenTheyAreCalls) {
  const LadderProgram program = networks({called("DIV", {{"IN1", "10"}, {"IN2", "d"}}, "__W0_"),
                                          called("GT", {{"IN1", "__W0_"}, {"IN2", "n + 1"}}, "__W1_")});
  EXPECT_EQ(shown(program), "GT(DIV(10, d), n + 1)");
  EXPECT_EQ(shown(program, all({contact("__W1_", true), contact("c")})), "NOT GT(DIV(10, d), n + 1) AND c");
  const LadderProgram limit =
      networks({line(all({contact("a"), contact("b")}), "__W0_"),
                called("LIMIT", {{"MN", "0"}, {"IN", "__W0_"}, {"MX", ""}}, "__W1_")});
  EXPECT_EQ(shown(limit), "LIMIT(MN := 0, IN := a AND b)");
  EXPECT_EQ(shown(networks({held("__W0_", "timer.Q"), held("__W1_", "NOT __W0_")})), "(NOT timer.Q)");
}

// Feedback, a call under an EN, what is not known.
TEST(ShownConditions, WhenTheirValueCannotBeWritten_ThenTheyAreConnectors) {
  EXPECT_EQ(shown(networks({line(contact("a"), "__W1_")}, "__W1_")), ">1>");
  EXPECT_EQ(shown(networks({called("GT", {{"", "1"}, {"", "2"}}, "__W1_", contact("en"))})), ">1>");
  EXPECT_EQ(shown(networks({}), all({contact("__W2_"), contact("__W1_"), contact("__W2_")})),
            ">1> AND >2> AND >1>");
}

TEST(ShownConditions, WhenWiresDoubleFromOneToTheNext_ThenTheTextEnds) {
  LadderProgram program;
  for (int i = 0; i < 60; ++i) {
    const std::string before = i == 0 ? "a" : "__W" + std::to_string(i - 1) + "_";
    program.wires.push_back({"__W" + std::to_string(i) + "_", "BOOL", false});
    program.rungs.push_back(
        line(all({contact(before), any({contact(before), contact("b")})}), program.wires.back().name));
  }
  const std::string text = shown(program, contact("__W59_"));
  EXPECT_LT(text.size(), 2'100u);
  EXPECT_EQ(text.find("__"), std::string::npos) << text;
}

TEST(ShownText, WhenRungsPowerSomething_ThenItStandsUnderItsCondition) {
  Rung rung = line(all({contact("a"), contact("b", true)}), "x");
  rung.coils.push_back({CoilKind::Set, "s"});
  rung.coils.push_back({CoilKind::Reset, "r"});
  rung.coils.push_back({CoilKind::Negated, "n"});
  rung.coils.push_back({CoilKind::RisingEdge, "p"});
  EXPECT_EQ(shown_text({{rung}}),
            "x := a AND NOT b;\nIF a AND NOT b THEN s := TRUE; END_IF;\nIF a AND NOT b THEN r := FALSE; "
            "END_IF;\nn := NOT (a AND NOT b);\np := R_EDGE(a AND NOT b);\n");
  EXPECT_EQ(shown_text({{line({}, "x")}}), "x := TRUE;\n");
}

TEST(ShownText, WhenBlocksAreCalled_ThenTheyAreCalls) {
  Block timer{"TON", "t1", "IN", {{"PT", "T#1s"}}, {{"Q", "ready"}}, ""};
  EXPECT_EQ(shown_text({{boxed(timer, contact("a"))}}), "t1(IN := a, PT := T#1s, Q => ready);\n");
  Block counter{"Counter", "k", "", {{"limit", "3"}, {"more", ""}}, {}, ""};
  EXPECT_EQ(shown_text({{boxed(counter, contact("a"))}}), "IF a THEN k(limit := 3); END_IF;\n");
  EXPECT_EQ(shown_text({{boxed(counter)}}), "k(limit := 3);\n");
  EXPECT_EQ(shown_text({{called("GT", {{"", "n"}, {"", "2"}}, ">1>"), line(contact(">1>"), "x")}}),
            ">1> := GT(n, 2);\nx := >1>;\n");
  EXPECT_EQ(shown_text({{held("n", "n + 1")}}), "n := n + 1;\n");
}

}  // namespace
}  // namespace stepwright::lowering
