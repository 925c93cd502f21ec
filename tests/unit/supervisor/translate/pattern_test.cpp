#include "supervisor/translate/pattern.h"

#include <gtest/gtest.h>

namespace stepwright::translate {
namespace {

TEST(ParsePattern, WhenWrittenWithSpacesAndCapitals_ThenIsReadAsPddlMeansIt) {
  const auto pattern = parse_pattern("  ( Move ?V  F1\tA1 ) ");
  ASSERT_TRUE(pattern);
  EXPECT_EQ(to_string(*pattern), "(move ?v f1 a1)");
}

TEST(ParsePattern, WhenMalformed_ThenIsRefused) {
  for (const char* text : {"", "move", "()", "(move ?v", "move ?v)", "(?a b)", "(move (at v))", "(move ?)"}) {
    EXPECT_FALSE(parse_pattern(text)) << text;
  }
}

TEST(Match, WhenActionFits_ThenBindsVariables) {
  const auto bound = match(*parse_pattern("(move ?v ?from a1)"), {"move", {"v1", "f1", "a1"}});
  ASSERT_TRUE(bound);
  EXPECT_EQ(instantiate(*parse_pattern("(is-at ?v ?from)"), *bound), "(is-at v1 f1)");
}

TEST(Match, WhenNameArityConstantOrRepetitionDiffers_ThenFails) {
  const auto pattern = *parse_pattern("(move ?v ?p ?p)");
  EXPECT_FALSE(match(pattern, {"load", {"v1", "f1", "f1"}}));
  EXPECT_FALSE(match(pattern, {"move", {"v1", "f1"}}));
  EXPECT_FALSE(match(pattern, {"move", {"v1", "f1", "a1"}}));
  EXPECT_TRUE(match(pattern, {"move", {"v1", "f1", "f1"}}));
  EXPECT_FALSE(match(*parse_pattern("(move v2 ?p ?q)"), {"move", {"v1", "f1", "a1"}}));
}

TEST(Covers, WhenGeneralPatternMeetsSpecialOne_ThenSaysWhichShadowsWhich) {
  const auto any = *parse_pattern("(move ?v ?from ?to)");
  const auto one = *parse_pattern("(move ?x f1 a1)");
  EXPECT_TRUE(covers(any, one));
  EXPECT_FALSE(covers(one, any));
  EXPECT_TRUE(covers(any, any));
}

}  // namespace
}  // namespace stepwright::translate
