#include "ladder/graphic/condition.h"

#include <gtest/gtest.h>

namespace stepwright::graphic {
namespace {

TEST(Condition, WhenGroupsOfOneKindNest_ThenTheyAreFlattened) {
  const Condition nested = all({contact("a"), all({contact("b"), all({contact("c")})})});
  EXPECT_EQ(nested, all({contact("a"), contact("b"), contact("c")}));
  EXPECT_EQ(nested.children.size(), 3U);
}

TEST(Condition, WhenGroupHasOneOrNoChild_ThenItIsThatChildOrTrue) {
  EXPECT_EQ(all({contact("a")}), contact("a"));
  EXPECT_EQ(any({contact("a")}), contact("a"));
  EXPECT_EQ(all({}), always());
  EXPECT_EQ(any({}), always());
}

TEST(Condition, WhenAClosedWireIsAmongTheChildren_ThenSeriesDropsItAndParallelIsTrue) {
  EXPECT_EQ(all({always(), contact("a"), always()}), contact("a"));
  EXPECT_EQ(any({contact("a"), always()}), always());
}

TEST(Condition, WhenWrittenAsSt_ThenGroupsAndComparisonsHaveParentheses) {
  EXPECT_EQ(to_st(all({contact("fc1"), compare("S1", CompareOp::GreaterEqual, "3784")})),
            "fc1 AND (S1 >= 3784)");
  EXPECT_EQ(to_st(any({all({contact("a"), contact("b", true)}), contact("c")})), "(a AND NOT b) OR c");
  EXPECT_EQ(to_st(always()), "TRUE");
  Condition expression;
  expression.kind = ConditionKind::Expression;
  expression.name = "f(x) > 1";
  expression.negated = true;
  EXPECT_EQ(to_st(expression), "NOT (f(x) > 1)");
}

TEST(Condition, WhenNegated_ThenEdgesStayContacts) {
  Condition edge = contact("a");
  edge.edge = Edge::Rising;
  Condition not_edge = edge;
  not_edge.negated = true;
  EXPECT_EQ(negation(edge), not_edge);
  EXPECT_EQ(negation(all({edge, contact("b")})), any({not_edge, contact("b", true)}));
  EXPECT_EQ(negation(negation(any({all({edge, contact("b")}), contact("c")}))),
            any({all({edge, contact("b")}), contact("c")}));
  EXPECT_EQ(to_st(negation(all({contact("a"), contact("b")}))), "NOT (a AND b)");
  EXPECT_EQ(to_st(negation(compare("x", CompareOp::Less, "y"))), "NOT ((x < y))");
  EXPECT_EQ(to_st(negation(always())), "NOT (TRUE)");
  EXPECT_EQ(negation(negation(contact("a"))), contact("a"));
}

TEST(Condition, WhenOperatorIsWritten_ThenItIsThatOfSt) {
  std::string text;
  for (int i = 0; i < 6; ++i) text += std::string(to_st(static_cast<CompareOp>(i))) + " ";
  EXPECT_EQ(text, "= <> < <= > >= ");
}

}  // namespace
}  // namespace stepwright::graphic
