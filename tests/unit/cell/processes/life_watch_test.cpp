#include "cell/processes/life_watch.h"

#include <gtest/gtest.h>

namespace stepwright::processes {
namespace {

using std::chrono::milliseconds;

class LifeWatchTest : public testing::Test {
 protected:
  // Asks every 10 ms of the test's time; whether it was silent at the end.
  bool pass(milliseconds time) {
    bool silent = false;
    for (const auto end = now_ + time; now_ < end; now_ += milliseconds(10)) silent = watch_.silent(now_);
    return silent;
  }

  LifeWatch watch_{milliseconds(1'000)};
  LifeWatch::Time now_{std::chrono::hours(1)};
};

TEST_F(LifeWatchTest, WhenNothingWasEverHeard_ThenItIsNotWatched) {
  EXPECT_FALSE(pass(milliseconds(10'000)));
}

TEST_F(LifeWatchTest, WhenNothingIsHeardForLonger_ThenItIsSilent) {
  pass(milliseconds(10));
  watch_.heard(now_);
  EXPECT_FALSE(pass(milliseconds(1'000)));
  EXPECT_TRUE(pass(milliseconds(20)));
  watch_.heard(now_);
  EXPECT_FALSE(pass(milliseconds(500)));
  watch_.end();
  EXPECT_FALSE(pass(milliseconds(5'000)));
}

TEST_F(LifeWatchTest, WhenWhoAsksWasHeldUp_ThenThatTimeDoesNotCount) {
  pass(milliseconds(10));
  watch_.heard(now_);
  pass(milliseconds(900));
  now_ += milliseconds(30'000);
  EXPECT_FALSE(pass(milliseconds(1'000)));
  EXPECT_TRUE(pass(milliseconds(20)));
}

}  // namespace
}  // namespace stepwright::processes
