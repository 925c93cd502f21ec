#include "runtime/ground/log/rate_limit.h"

#include <gtest/gtest.h>

namespace stepwright::log {
namespace {

using namespace std::chrono_literals;
const RateLimit::Clock::time_point kStart = RateLimit::Clock::time_point{} + 1h;

TEST(RateLimit, WhenTheBudgetIsSpent_ThenTheRestIsCountedAndToldOfOnce) {
  RateLimit limit(3);
  int written = 0;
  for (int i = 0; i < 10; ++i) written += limit.admit("trap", kStart + i * 1ms) ? 1 : 0;
  EXPECT_EQ(written, 3);
  EXPECT_TRUE(limit.due(kStart + 999ms).empty());
  const auto told = limit.due(kStart + 1s);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, "trap");
  EXPECT_EQ(told[0].count, 7u);
  EXPECT_TRUE(limit.due(kStart + 2s).empty());
}

TEST(RateLimit, WhenAKindIsLimited_ThenOthersAreNot) {
  RateLimit limit(1);
  EXPECT_TRUE(limit.admit("trap", kStart));
  EXPECT_FALSE(limit.admit("trap", kStart));
  EXPECT_TRUE(limit.admit("client", kStart));
}

TEST(RateLimit, WhenASecondIsOver_ThenTheBudgetIsThereAgain) {
  RateLimit limit(1);
  EXPECT_TRUE(limit.admit("trap", kStart));
  EXPECT_FALSE(limit.admit("trap", kStart + 500ms));
  EXPECT_TRUE(limit.admit("trap", kStart + 1s));
}

TEST(RateLimit, WhenItEnds_ThenWhatIsLeftIsTold) {
  RateLimit limit(1);
  static_cast<void>(limit.admit("trap", kStart));
  static_cast<void>(limit.admit("trap", kStart));
  ASSERT_EQ(limit.rest().size(), 1u);
  EXPECT_TRUE(limit.rest().empty());
}

TEST(RateLimit, WhenThereAreTooManyKinds_ThenTheNewOnesShareABudget) {
  RateLimit limit(1);
  for (std::size_t i = 0; i < RateLimit::kMaxKinds; ++i)
    EXPECT_TRUE(limit.admit("k" + std::to_string(i), kStart));
  EXPECT_TRUE(limit.admit("one more", kStart));
  EXPECT_FALSE(limit.admit("and another", kStart));
}

}  // namespace
}  // namespace stepwright::log
