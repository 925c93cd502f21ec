#include "ladder/graphic/externals.h"

#include <gtest/gtest.h>

namespace stepwright::graphic {
namespace {

TEST(Externals, WhenATextMentionsGlobals_ThenExactlyThoseAreDeclared) {
  std::vector<Variable> globals(3);
  globals[0] = {.name = "arc", .type = "REAL"};
  globals[1] = {.name = "arc_2", .type = "INT"};
  globals[2] = {.name = "done", .type = "BOOL"};
  const auto declared =
      externals(globals, "IF arc_2 > 3 THEN\n  undone := TRUE; done := x.arc_2 = 1;\nEND_IF;");
  ASSERT_EQ(declared.size(), 2u);
  EXPECT_EQ(declared[0].name, "arc_2");
  EXPECT_EQ(declared[0].type, "INT");
  EXPECT_EQ(declared[0].section, VariableSection::External);
  EXPECT_EQ(declared[1].name, "done");
  EXPECT_FALSE(mentions("arc_", "arc"));
  EXPECT_FALSE(mentions("", "arc"));
  EXPECT_TRUE(mentions("arc", "arc"));
}

TEST(Externals, WhenAChartIsRead_ThenActionsTargetsAndConditionsAreThere) {
  SfcChart chart;
  chart.steps.emplace_back().actions.push_back({.target = "pump"});
  chart.actions.push_back({.name = "GO", .st_body = "way := 1.0;"});
  chart.transitions.emplace_back().condition = contact("full");
  const std::string text = text_of(chart);
  for (const char* name : {"pump", "way", "full"}) EXPECT_TRUE(mentions(text, name)) << name;
}

}  // namespace
}  // namespace stepwright::graphic
