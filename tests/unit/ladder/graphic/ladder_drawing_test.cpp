#include "ladder/graphic/ladder_drawing.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>

namespace stepwright::graphic {
namespace {

LadderProgram sample() {
  LadderProgram program;
  Rung rung;
  rung.label = "START";
  rung.comment = "Fill";
  rung.condition = all({contact("a"), any({contact("b", true), compare("S1", CompareOp::Less, "10")})});
  rung.coils = {{CoilKind::Normal, "q"}, {CoilKind::Set, "r"}};
  program.rungs.push_back(rung);
  Rung timer;
  timer.condition = contact("q");
  Block& block = timer.blocks.emplace_back();
  block.type = "TON";
  block.instance = "t1";
  block.power_input = "IN";
  block.inputs = {{"PT", "T#2s"}};
  block.outputs = {{"Q", "done"}};
  timer.jump_to = "START";
  program.rungs.push_back(timer);
  return program;
}

TEST(LadderDrawing, WhenProgramIsDrawnAsText_ThenSymbolsStandOnTheirWires) {
  const std::string text = draw_ladder_text(sample());
  EXPECT_NE(text.find("┤ ├"), std::string::npos) << text;
  EXPECT_NE(text.find("┤/├"), std::string::npos) << text;
  EXPECT_NE(text.find("[S1 < 10]"), std::string::npos) << text;
  EXPECT_NE(text.find("(S)"), std::string::npos) << text;
  EXPECT_NE(text.find("T#2s─│PT"), std::string::npos) << text;
  EXPECT_NE(text.find(">> START"), std::string::npos) << text;
  EXPECT_NE(text.find("─done"), std::string::npos) << text;
}

// IEC 61131-3, 8.1.3: no coil, and nothing leads on to the rail.
TEST(LadderDrawing, WhenALineEndsInAConnector_ThenItHasTheSymbolOfOne) {
  LadderProgram program;
  program.rungs.emplace_back().condition = contact("a");
  program.rungs.back().coils = {{CoilKind::Normal, ">1>"}, {CoilKind::Normal, "q"}};
  const std::string text = draw_ladder_text(program);
  EXPECT_NE(text.find("─>1> "), std::string::npos) << text;
  EXPECT_EQ(text.find("( )"), text.rfind("( )")) << text;
  const std::string svg = draw_ladder_svg(program);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str())) << svg;
  EXPECT_EQ(document.select_nodes("//g[@class='sw-coil']").size(), 1U);
  EXPECT_EQ(document.select_nodes("//text[.='>1>']").size(), 1U);
}

// A line that goes on begins with it, in every branch at the rail; elsewhere it is a contact of the line.
TEST(LadderDrawing, WhenALineBeginsWithAConnector_ThenItHasTheSymbolOfOne) {
  LadderProgram program;
  program.rungs.emplace_back().condition =
      all({any({all({contact(">1>"), contact("a")}), contact(">2>")}), contact(">1>")});
  program.rungs.back().coils = {{CoilKind::Normal, "q"}};
  program.rungs.emplace_back().condition = contact(">1>", true);
  program.rungs.back().coils = {{CoilKind::Normal, "r"}};
  program.rungs.emplace_back().condition = contact(">1>");
  program.rungs.back().coils = {{CoilKind::Normal, "s"}};
  const std::string text = draw_ladder_text(program);
  EXPECT_NE(text.find(" >1>─"), std::string::npos) << text;
  EXPECT_NE(text.find(" >2>─"), std::string::npos) << text;
  EXPECT_NE(text.find("┤/├"), std::string::npos) << text;
  EXPECT_EQ(text.find("─>"), std::string::npos) << text;
  pugi::xml_document document;
  const std::string svg = draw_ladder_svg(program);
  ASSERT_TRUE(document.load_string(svg.c_str())) << svg;
  EXPECT_EQ(document.select_nodes("//g[@class='sw-contact']").size(), 3U) << svg;
  EXPECT_EQ(document.select_nodes("//text[@class='sw-jump']").size(), 3U) << svg;
}

TEST(LadderDrawing, WhenAContactIsNegatedAndSensesAnEdge_ThenBothAreSeen) {
  LadderProgram program;
  Condition edge = contact("a", true);
  edge.edge = Edge::Falling;
  program.rungs.emplace_back().condition = all({edge, contact("b")});
  program.rungs.back().coils = {{CoilKind::Normal, "q"}};
  const std::string text = draw_ladder_text(program);
  EXPECT_NE(text.find("─┤/N├─"), std::string::npos) << text;
  const std::string svg = draw_ladder_svg(program);
  EXPECT_NE(svg.find(">N<"), std::string::npos);
}

TEST(LadderDrawing, WhenProgramIsDrawnAsSvg_ThenRungsAndVariablesCanBeFound) {
  const std::string svg = draw_ladder_svg(sample());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str())) << svg;
  EXPECT_EQ(document.select_nodes("//g[@data-rung]").size(), 2U);
  EXPECT_EQ(document.select_nodes("//g[@class='sw-contact'][@data-variable='b']").size(), 1U);
  EXPECT_EQ(document.select_nodes("//g[@class='sw-coil'][@data-variable='r']").size(), 1U);
  EXPECT_EQ(document.select_nodes("//g[@class='sw-block'][@data-variable='t1']").size(), 1U);
  EXPECT_EQ(svg, draw_ladder_svg(sample()));
}

TEST(LadderDrawing, WhenProgramIsEmpty_ThenOnlyTheRailsAreDrawn) {
  EXPECT_NE(draw_ladder_svg({}).find("sw-rail"), std::string::npos);
  EXPECT_FALSE(draw_ladder_text({}).empty());
}

}  // namespace
}  // namespace stepwright::graphic
