#include "supervisor/ltl/drawing/automaton_svg.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/drawing/guard_text.h"
#include "tests/unit/supervisor/ltl/dwyer_patterns.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

TEST(AutomatonSvg, Picture_WhenDrawn_ThenEveryStateAndEdgeIsThere) {
  int drawn = 0;
  for (const char* text : test::kDwyerPatterns) {
    const auto monitor = monitor_automaton(*parse_formula(text));
    if (!monitor) continue;
    const auto svg = automaton_svg(monitor->automaton);
    ASSERT_TRUE(svg) << text;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg->c_str())) << *svg;
    const auto count = [&](const char* path) { return document.select_nodes(path).size(); };
    EXPECT_EQ(count("//circle[not(contains(@class, 'ring'))]"), monitor->automaton.size()) << text;
    EXPECT_EQ(svg->find("nan"), std::string::npos);
    ++drawn;
  }
  EXPECT_GE(drawn, 40);
}

TEST(AutomatonSvg, Names_WhenTheyHaveSigns_ThenTheyAreEscaped) {
  const auto monitor = monitor_automaton(*parse_formula("F \"a<b & \\\"c\\\"\""));
  const auto svg = automaton_svg(monitor->automaton);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg->c_str())) << *svg;
  EXPECT_NE(svg->find("a&lt;b &amp; "), std::string::npos);
}

TEST(AutomatonSvg, Refusal_WhenThereAreTooManyStates_ThenTheBoundIsNamed) {
  const auto task = task_automaton(*parse_formula(test::coverage(8)));
  const auto svg = automaton_svg(*task);
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().front().code, "L0032");
}

TEST(GuardText, Letters_WhenAnEdgeIsRead_ThenInWords) {
  const auto task = task_automaton(*parse_formula("!b U a"));
  const auto texts = guard_texts(*task, task->initial, 100);
  EXPECT_EQ(texts.at(task->next(0, 0)), "!b & !a");
  EXPECT_EQ(guard_texts(*task, task->next(0, 1), 100).begin()->second, "always");
  EXPECT_EQ(guard_texts(*task, task->initial, 2).at(task->next(0, 0)), "!b...");
}

}  // namespace
}  // namespace stepwright::ltl
