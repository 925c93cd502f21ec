#include "hmi_web/recorder/calendar.h"

#include <gtest/gtest.h>

namespace stepwright::recorder {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr std::int64_t kWallNs = 1'700'000'000 * kSecondNs;
constexpr std::int64_t kDayNs = 86'400 * kSecondNs;

TEST(Calendar, WhenItIsFarAheadAtTheStart_ThenTimeGoesOnFromTheNewestRecord) {
  Calendar calendar(kWallNs);
  EXPECT_EQ(calendar.at(kWallNs + 400 * kDayNs, 7 * kSecondNs), kWallNs);
  EXPECT_EQ(calendar.at(kWallNs + 400 * kDayNs + 5 * kSecondNs, 12 * kSecondNs), kWallNs + 5 * kSecondNs);
  EXPECT_EQ(calendar.ahead_ns(), 400 * kDayNs);
  EXPECT_EQ(calendar.at(kWallNs + 7 * kSecondNs, 14 * kSecondNs), kWallNs + 7 * kSecondNs)
      << "somebody has set it right";
  EXPECT_EQ(calendar.ahead_ns(), 0);
  EXPECT_FALSE(calendar.accept());
}

TEST(Calendar, WhenItJumpsWhileTheServerRuns_ThenTimeGoesOnUntilSomebodyAcceptsIt) {
  Calendar calendar(0);
  EXPECT_EQ(calendar.at(kWallNs, kSecondNs), kWallNs) << "nothing was recorded: any calendar will do";
  EXPECT_EQ(calendar.at(kWallNs + 60 * kDayNs, 2 * kSecondNs), kWallNs + kSecondNs);
  EXPECT_TRUE(calendar.accept());
  EXPECT_EQ(calendar.at(kWallNs + 60 * kDayNs, 3 * kSecondNs), kWallNs + 60 * kDayNs);
  EXPECT_EQ(calendar.ahead_ns(), 0);
}

TEST(Calendar, WhenItIsSetBackOrTheMachineWasOff_ThenItIsBelieved) {
  Calendar calendar(kWallNs);
  EXPECT_EQ(calendar.at(kWallNs + 40 * kDayNs, kSecondNs), kWallNs + 40 * kDayNs) << "a long holiday";
  EXPECT_EQ(calendar.at(kWallNs, 2 * kSecondNs), kWallNs)
      << "the history's clock never goes back (history_clock.h)";
  EXPECT_EQ(calendar.at(kWallNs + 40 * kDayNs + 2 * kSecondNs, 3 * kSecondNs),
            kWallNs + 40 * kDayNs + 2 * kSecondNs);
}

}  // namespace
}  // namespace stepwright::recorder
