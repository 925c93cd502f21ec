#include "supervisor/run/operator_hold.h"

#include <gtest/gtest.h>

namespace stepwright::run {
namespace {

TEST(OperatorHold, WhenItIsWantedTwice_ThenOnlyTheFirstOneCounts) {
  OperatorHold hold("the arms are");
  Cause cause;
  EXPECT_TRUE(hold.want(cause));
  EXPECT_FALSE(hold.want(cause));
  EXPECT_EQ(cause.kind, IncidentKind::Operator);
  EXPECT_EQ(cause.evidence, (std::vector<std::string>{"held by the operator", "the arms are held already"}));
  EXPECT_TRUE(hold.wanted());
  EXPECT_FALSE(hold.holds());
}

TEST(OperatorHold, WhenItIsTakenBackBeforeItRests_ThenNothingHasToGoOn) {
  OperatorHold hold("the fleet is");
  Cause cause;
  hold.want(cause);
  EXPECT_FALSE(hold.resume(cause, /*estop_ok=*/false));
  EXPECT_EQ(cause.evidence.back(), "the fleet may go on");
  EXPECT_FALSE(hold.wanted());
}

TEST(OperatorHold, WhenItRests_ThenItGoesOnOnceNothingElseHoldsIt) {
  OperatorHold hold("the fleet is");
  Cause cause;
  hold.want(cause);
  hold.begin();
  EXPECT_TRUE(hold.holds());
  EXPECT_FALSE(hold.wanted());
  EXPECT_FALSE(hold.want(cause));
  EXPECT_FALSE(hold.resume(cause, /*estop_ok=*/false));
  EXPECT_EQ(cause.evidence.back(), "the fleet cannot go on: the emergency stop is still pressed");
  EXPECT_TRUE(hold.holds());
  EXPECT_TRUE(hold.resume(cause, /*estop_ok=*/true));
  EXPECT_FALSE(hold.holds());
}

TEST(OperatorHold, WhenNothingHoldsIt_ThenThatIsSaid) {
  OperatorHold hold("the fleet is");
  Cause cause;
  EXPECT_FALSE(hold.resume(cause, /*estop_ok=*/true));
  EXPECT_EQ(cause.evidence.back(), "nothing holds the fleet that could be resumed");
  hold.want(cause);
  hold.begin();
  hold.forget();
  EXPECT_FALSE(hold.holds());
}

}  // namespace
}  // namespace stepwright::run
