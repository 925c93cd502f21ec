#include "hmi_web/alarms/condition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace stepwright::alarms {
namespace {

using std::chrono::nanoseconds;

// "10+ 14-": raised at 10 ns, returned at 14. One value a nanosecond; "!" for one that is not usable.
std::string changes(ConditionSettings settings, const std::vector<double>& values) {
  Condition condition(settings);
  std::string text;
  const auto note = [&](const std::optional<ConditionChange>& change) {
    if (change) text += std::to_string(change->time_ns) + (change->active ? "+ " : "- ");
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto time = static_cast<std::int64_t>(i);
    note(condition.expire(time));
    note(condition.offer(time, values[i], !std::isinf(values[i])));
  }
  return text;
}

constexpr double kBad = HUGE_VAL;

TEST(Condition, WhenThereIsADeadband_ThenAValueAroundTheLimitIsOneAlarm) {
  const std::vector<double> values = {9, 9.5, 9.6, 9.4, 9.6, 9.31, 9.3, 9.5, 9.51};
  EXPECT_EQ(changes({ConditionKind::High, 9.5, 0.2}, values), "2+ 6- 8+ ");
  EXPECT_EQ(changes({ConditionKind::High, 9.5, 0.0}, values), "2+ 3- 4+ 5- 8+ ");
  EXPECT_EQ(changes({ConditionKind::Low, 9.5, 0.2}, {9.5, 9.4, 9.6, 9.69, 9.7, 9.5, 9}), "1+ 4- 6+ ");
}

TEST(Condition, WhenDelaysRun_ThenShortChangesAreNoneAndLongOnesHaveTheirOwnTime) {
  ConditionSettings settings;
  settings.on_delay = nanoseconds(3);
  settings.off_delay = nanoseconds(2);
  EXPECT_EQ(changes(settings, {0, 1, 1, 0, 1, 1, 1, 1, 1, 0, 1, 0, 0, 0}), "7+ 13- ");
}

TEST(Condition, WhenNobodyLooksForLong_ThenADelayStillEndsAtItsOwnInstant) {
  ConditionSettings settings;
  settings.on_delay = nanoseconds(5);
  Condition condition(settings);
  EXPECT_FALSE(condition.offer(100, 1.0, true).has_value());
  EXPECT_EQ(condition.deadline(), 105);
  const auto change = condition.expire(9000);
  ASSERT_TRUE(change.has_value());
  EXPECT_EQ(change->time_ns, 105);
  EXPECT_FALSE(condition.deadline().has_value());
  EXPECT_FALSE(condition.expire(9001).has_value());
}

TEST(Condition, WhenAValueIsNotUsable_ThenLimitsHoldWhatTheyKnowAndBadSaysSo) {
  const std::vector<double> values = {0, kBad, 1, kBad, std::nan(""), 0, kBad};
  EXPECT_EQ(changes({ConditionKind::On}, values), "2+ 5- ");
  EXPECT_EQ(changes({ConditionKind::Off}, values), "0+ 2- 5+ ");
  EXPECT_EQ(changes({ConditionKind::High, 0.5, 0}, values), "2+ 5- ");
  EXPECT_EQ(changes({ConditionKind::Bad}, values), "1+ 2- 3+ 4- 6+ ");
}

TEST(Condition, WhenTimeRunsBackwards_ThenItCountsAsTheNewest) {
  Condition condition({ConditionKind::On});
  EXPECT_EQ(condition.offer(100, 1.0, true)->time_ns, 100);
  EXPECT_EQ(condition.offer(50, 0.0, true)->time_ns, 100);
}

TEST(Condition, WhenItChangedWhileNobodySawIt_ThenTheChangeSaysSinceWhen) {
  Condition condition({.kind = ConditionKind::High, .limit = 10.0});
  EXPECT_EQ(condition.offer(1, 11.0, true)->unseen_since_ns, 0) << "it was seen";
  EXPECT_FALSE(condition.offer(5, 0.0, false));
  EXPECT_FALSE(condition.offer(7, 0.0, false)) << "what is not known changes nothing";
  const auto returned = condition.offer(9, 3.0, true);
  ASSERT_TRUE(returned);
  EXPECT_EQ(returned->unseen_since_ns, 5) << "from then on nothing was known";
  EXPECT_EQ(condition.offer(10, 11.0, true)->unseen_since_ns, 0);
  condition.blind_since(12);
  EXPECT_FALSE(condition.offer(20, 12.0, true)) << "it is as it was";
  EXPECT_EQ(condition.offer(21, 3.0, true)->unseen_since_ns, 0);
  condition.blind_since(22);
  EXPECT_EQ(condition.offer(30, 11.0, true, /*time_known=*/true)->unseen_since_ns, 0);
}

}  // namespace
}  // namespace stepwright::alarms
