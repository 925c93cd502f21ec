#include "hmi_web/recorder/calendar.h"

#include <gtest/gtest.h>

namespace stepwright::recorder {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kWall = 1'700'000'000 * kSecond;
constexpr std::int64_t kDay = 86'400 * kSecond;

TEST(Calendar, WhenItIsFarAheadAtTheStart_ThenTimeGoesOnFromTheNewestRecord) {
  Calendar calendar(kWall);
  EXPECT_EQ(calendar.at(kWall + 400 * kDay, 7 * kSecond), kWall);
  EXPECT_EQ(calendar.at(kWall + 400 * kDay + 5 * kSecond, 12 * kSecond), kWall + 5 * kSecond);
  EXPECT_EQ(calendar.ahead_ns(), 400 * kDay);
  EXPECT_EQ(calendar.at(kWall + 7 * kSecond, 14 * kSecond), kWall + 7 * kSecond)
      << "somebody has set it right";
  EXPECT_EQ(calendar.ahead_ns(), 0);
  EXPECT_FALSE(calendar.accept());
}

TEST(Calendar, WhenItJumpsWhileTheServerRuns_ThenTimeGoesOnUntilSomebodyAcceptsIt) {
  Calendar calendar(0);
  EXPECT_EQ(calendar.at(kWall, kSecond), kWall) << "nothing was recorded: any calendar will do";
  EXPECT_EQ(calendar.at(kWall + 60 * kDay, 2 * kSecond), kWall + kSecond);
  EXPECT_TRUE(calendar.accept());
  EXPECT_EQ(calendar.at(kWall + 60 * kDay, 3 * kSecond), kWall + 60 * kDay);
  EXPECT_EQ(calendar.ahead_ns(), 0);
}

TEST(Calendar, WhenItIsSetBackOrTheMachineWasOff_ThenItIsBelieved) {
  Calendar calendar(kWall);
  EXPECT_EQ(calendar.at(kWall + 40 * kDay, kSecond), kWall + 40 * kDay) << "a long holiday";
  EXPECT_EQ(calendar.at(kWall, 2 * kSecond), kWall)
      << "the history's clock never goes back (history_clock.h)";
  EXPECT_EQ(calendar.at(kWall + 40 * kDay + 2 * kSecond, 3 * kSecond), kWall + 40 * kDay + 2 * kSecond);
}

}  // namespace
}  // namespace stepwright::recorder
