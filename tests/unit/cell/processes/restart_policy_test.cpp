#include "cell/processes/restart_policy.h"

#include <gtest/gtest.h>

namespace stepwright::processes {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const RestartPolicy::Time kStart{};

TEST(RestartPolicy, WhenItEndsAgainAndAgain_ThenTheRestIsDoubledUpToItsLongest) {
  RestartPolicy policy({.first = milliseconds(100), .longest = milliseconds(350)});
  for (const int rest : {100, 200, 350, 350, 350, 350, 350}) {
    policy.ready(kStart);
    EXPECT_EQ(policy.ended(kStart + milliseconds(1)), milliseconds(rest));
  }
}

TEST(RestartPolicy, WhenItWasReadyForLong_ThenItIsStartedSoonAgain) {
  RestartPolicy policy;
  policy.ready(kStart);
  EXPECT_EQ(policy.ended(kStart), milliseconds(100));
  policy.ready(kStart);
  EXPECT_EQ(policy.ended(kStart + milliseconds(9'999)), milliseconds(200));
  policy.ready(kStart);
  EXPECT_EQ(policy.ended(kStart + seconds(10)), milliseconds(100));
}

TEST(RestartPolicy, WhenItFailsFiveTimesBeforeItIsReady_ThenItIsLeftAlone) {
  RestartPolicy policy;
  for (int i = 1; i < 5; ++i) EXPECT_TRUE(policy.ended(kStart)) << i;
  EXPECT_FALSE(policy.ended(kStart));
  EXPECT_EQ(policy.failures(), 5);
}

TEST(RestartPolicy, WhenItWasReadyBetween_ThenFailuresAreCountedAnew) {
  RestartPolicy policy;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(policy.ended(kStart));
  policy.ready(kStart);
  EXPECT_TRUE(policy.ended(kStart)) << "it was ready: no failure";
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(policy.ended(kStart));
  EXPECT_FALSE(policy.ended(kStart));
}

}  // namespace
}  // namespace stepwright::processes
