#include "supervisor/translate/guard.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

using graphic::to_st;
using model::all_of;
using model::any_of;
using model::compare;
using model::Comparison;
using model::constant;
using model::Expression;
using model::fact;
using model::fluent;

Expression expression(model::ExpressionKind kind, std::vector<Expression> operands) {
  Expression result;
  result.kind = kind;
  result.operands = std::move(operands);
  return result;
}

class GuardTest : public ::testing::Test {
 protected:
  result::Result<Guard> guard(model::Condition precondition, const Offsets& offsets = {}) {
    model::PlannedAction planned;
    planned.action = {"load", {"v1", "f1", "level8"}};
    planned.precondition = std::move(precondition);
    planned.before = testing::bench_start();
    return make_guard(planned, binding_, tare_, offsets);
  }
  std::string text(model::Condition precondition, const Offsets& offsets = {}) {
    auto made = guard(std::move(precondition), offsets);
    return made ? to_st(made->condition) : to_string(made.error());
  }

  Binding binding_ = testing::bench_binding();
  Tare tare_;
};

TEST_F(GuardTest, WhenFactHasASwitch_ThenBecomesItsContact) {
  EXPECT_EQ(text(fact("(is-at v1 f1)")), "fc1");
  EXPECT_EQ(text(fact("(is-at v1 a1)", true)), "NOT fc2");
}

TEST_F(GuardTest, WhenNothingSeesAnAtom_ThenItIsAssumed) {
  const auto made = guard(
      all_of({fact("(serves a1 c1)"), compare(fluent("(received c1)"), Comparison::Equal, constant(0))}));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->condition, graphic::always());
  EXPECT_EQ(made->assumed, (std::vector<std::string>{"(serves a1 c1)", "(= (received c1) 0)"}));
}

TEST_F(GuardTest, WhenOneLevelIsLimited_ThenComparesCountsWithTolerance) {
  // lev + 8 <= 10: lev <= 2.2 with tolerance; 1322 + 0.2 * 307.75 = 1383.55
  const auto sum = expression(model::ExpressionKind::Sum, {fluent("(lev v1)"), constant(8)});
  EXPECT_EQ(text(compare(sum, Comparison::LessEqual, constant(10))), "(S1_filtered <= 1384)");
  // The same the other way round: 10 - lev >= 8.
  const auto rest = expression(model::ExpressionKind::Difference, {constant(10), fluent("(lev v1)")});
  EXPECT_EQ(text(compare(rest, Comparison::GreaterEqual, constant(8))), "(S1_filtered <= 1384)");
  const auto twice = expression(model::ExpressionKind::Product, {constant(2), fluent("(lev v1)")});
  EXPECT_EQ(text(compare(twice, Comparison::Greater, constant(3))), "(S1_filtered >= 1107)");
}

TEST_F(GuardTest, WhenLevelMustBeEqual_ThenStaysWithinTolerance) {
  EXPECT_EQ(text(compare(fluent("(lev v1)"), Comparison::Equal, constant(2))),
            "(S1_filtered >= 1260) AND (S1_filtered <= 1384)");
}

TEST_F(GuardTest, WhenSensorIsTared_ThenThresholdMovesByTheBias) {
  tare_["S1"] = 40.0;
  EXPECT_EQ(text(compare(fluent("(lev v1)"), Comparison::GreaterEqual, constant(2))),
            "(S1_filtered >= 1300)");
}

TEST_F(GuardTest, WhenPlanRoundedTheLevel_ThenTheOffsetWidensTheTolerance) {
  EXPECT_EQ(text(compare(fluent("(lev v1)"), Comparison::LessEqual, constant(2)), {{"(lev v1)", 0.4}}),
            "(S1_filtered <= 1507)");
}

TEST_F(GuardTest, WhenSeveralLevelsAreCompared_ThenReadsTheirCalibratedValues) {
  const auto both = expression(model::ExpressionKind::Sum, {fluent("(lev v1)"), fluent("(level a1)")});
  const auto made = guard(compare(both, Comparison::LessEqual, constant(10)));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->values, (std::set<std::string>{"S1", "S2"}));
  EXPECT_EQ(made->condition.name, "-10.0 + 1.0 * S1_value + 1.0 * S2_value <= 0.4");
}

TEST_F(GuardTest, WhenOneAlternativeIsKnownFalse_ThenOnlyTheOtherIsChecked) {
  EXPECT_EQ(text(any_of({fact("(serves a2 c1)"), fact("(is-at v1 f1)")})), "fc1");
  EXPECT_EQ(text(any_of({fact("(serves a1 c1)"), fact("(is-at v1 a2)")})), "TRUE");
  EXPECT_EQ(text(any_of({fact("(is-at v1 f1)"), fact("(is-at v1 a1)")})), "fc1 OR fc2");
}

TEST_F(GuardTest, WhenNotLinear_ThenIsAssumed) {
  const auto square = expression(model::ExpressionKind::Product, {fluent("(lev v1)"), fluent("(lev v1)")});
  const auto made = guard(compare(square, Comparison::LessEqual, constant(10)));
  ASSERT_TRUE(made);
  EXPECT_EQ(made->condition, graphic::always());
  EXPECT_EQ(made->assumed.size(), 1U);
}

TEST_F(GuardTest, WhenPlanItselfViolatesThePrecondition_ThenFails) {
  const auto made = guard(compare(fluent("(lev v1)"), Comparison::Greater, constant(3)));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "T0005");
  EXPECT_FALSE(guard(compare(fluent("(no such)"), Comparison::Equal, constant(3))));
}

TEST(Negation, WhenNested_ThenFollowsDeMorgan) {
  const auto condition = graphic::all(
      {graphic::contact("a"),
       graphic::any({graphic::contact("b", true), graphic::compare("x", graphic::CompareOp::Less, "3")})});
  EXPECT_EQ(to_st(*inverse(condition)), "NOT a OR (b AND (x >= 3))");
  EXPECT_FALSE(inverse(graphic::always()));
  EXPECT_FALSE(inverse(graphic::all({})));
}

TEST(RealLiteral, WhenWritten_ThenIsALiteralOfIec61131) {
  EXPECT_EQ(real_literal(3), "3.0");
  EXPECT_EQ(real_literal(-2.5), "-2.5");
  EXPECT_EQ(real_literal(1e-7), "1.0e-07");
  EXPECT_EQ(real_literal(1.5e20), "1.5e+20");
}

}  // namespace
}  // namespace stepwright::translate
