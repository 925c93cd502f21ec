#include "hmi_web/notify/schedule.h"

#include <gtest/gtest.h>

namespace stepwright::notify {
namespace {

using alarms::Priority;
using std::chrono::seconds;

class ScheduleTest : public testing::Test {
 protected:
  static Channel channel() {
    Channel channel;
    channel.at_least = Priority::High;
    channel.delay = seconds(60);
    channel.repeat = seconds(900);
    return channel;
  }
  static StandingAlarm alarm(const std::string& name, Priority priority = Priority::High,
                             std::int64_t raised_ns = 1) {
    StandingAlarm one;
    one.name = name;
    one.priority = priority;
    one.raised_ns = raised_ns;
    return one;
  }
  // Names of those that are due `at` seconds after the beginning, with a blank behind each.
  std::string due(int at, const std::vector<StandingAlarm>& standing) {
    std::string names;
    for (const StandingAlarm& each : schedule_.due(standing, begin_ + seconds(at))) names += each.name + " ";
    return names;
  }
  void sent(int at, bool arrived = true) { schedule_.sent(arrived, begin_ + seconds(at)); }

  Schedule::Time begin_{};
  Schedule schedule_{channel()};
};

TEST_F(ScheduleTest, WhenAnAlarmStandsForTheDelay_ThenItIsToldOnceAndAgainAfterTheRepetition) {
  EXPECT_EQ(due(0, {alarm("a")}), "");
  EXPECT_EQ(due(59, {alarm("a")}), "");
  EXPECT_EQ(due(60, {alarm("a")}), "a ");
  sent(61);
  EXPECT_EQ(due(62, {alarm("a")}), "");
  EXPECT_EQ(due(960, {alarm("a")}), "");
  EXPECT_EQ(due(961, {alarm("a")}), "a ");
}

// A restart of the page's server, while nobody has acknowledged.
TEST_F(ScheduleTest, WhenAnEarlierOneHasToldOnce_ThenTheSameOccurrenceIsNotToldAgain) {
  Channel once = channel();
  once.repeat = seconds(0);
  Schedule first(once);
  EXPECT_TRUE(first.due({alarm("a")}, begin_).empty());
  EXPECT_EQ(first.due({alarm("a")}, begin_ + seconds(60)).size(), 1u);
  const Schedule::WallTime wall{std::chrono::hours(24)};
  first.sent(true, begin_ + seconds(60), wall);
  const Notifications told = first.told();
  EXPECT_EQ(told, (Notifications{{"a", {1, 86'400'000}}}));
  Schedule next(once, told, wall);
  const auto due_of_next = [&](int at, const std::vector<StandingAlarm>& standing) {
    std::string names;
    for (const StandingAlarm& each : next.due(standing, begin_ + seconds(at))) names += each.name + " ";
    next.sent(true, begin_ + seconds(at), wall);
    return names;
  };
  EXPECT_EQ(due_of_next(100, {alarm("a"), alarm("b")}), "");
  EXPECT_EQ(due_of_next(5'000, {alarm("a"), alarm("b")}), "b ");
  EXPECT_EQ(next.told(), (Notifications{{"a", {1, 86'400'000}}, {"b", {1, 86'400'000}}}));
  EXPECT_EQ(due_of_next(5'001, {alarm("a", Priority::High, 2)}), "") << "it has come again";
  EXPECT_EQ(due_of_next(5'061, {alarm("a", Priority::High, 2)}), "a ");
}

TEST_F(ScheduleTest, WhenAnEarlierOneHasToldMinutesAgo_ThenItsRepetitionGoesOn) {
  const Schedule::WallTime wall{std::chrono::hours(24)};
  const auto told_s_ago = [&](int s) {
    const std::int64_t ms = 86'400'000 - s * 1'000;
    return Schedule(channel(), {{"a", {1, ms}}}, wall);
  };
  for (const auto& [ago, first_due] :
       {std::pair{0, 900}, {300, 600}, {899, 1}, {900, 0}, {5'000, 0}, {-50, 900}}) {
    Schedule next = told_s_ago(ago);
    std::vector<int> due;
    for (int at = 0; at <= 1'000 && due.empty(); ++at)
      if (!next.due({alarm("a")}, begin_ + seconds(at)).empty()) due.push_back(at);
    EXPECT_EQ(due, std::vector{first_due}) << ago;
  }
}

TEST_F(ScheduleTest, WhenItIsAcknowledgedBeforeTheDelay_ThenNobodyIsTold) {
  EXPECT_EQ(due(0, {alarm("a")}), "");
  EXPECT_EQ(due(30, {}), "");
  EXPECT_EQ(due(70, {}), "");
  EXPECT_EQ(due(80, {alarm("a", Priority::High, 2)}), "") << "it has come again: its delay begins anew";
  EXPECT_EQ(due(139, {alarm("a", Priority::High, 2)}), "");
  EXPECT_EQ(due(140, {alarm("a", Priority::High, 2)}), "a ");
}

TEST_F(ScheduleTest, WhenItComesAgainBetweenTwoLooks_ThenItsDelayBeginsAnew) {
  EXPECT_EQ(due(0, {alarm("a", Priority::High, 1)}), "");
  EXPECT_EQ(due(60, {alarm("a", Priority::High, 2)}), "");
  EXPECT_EQ(due(120, {alarm("a", Priority::High, 2)}), "a ");
}

TEST_F(ScheduleTest, WhenPrioritiesDiffer_ThenOnlyThoseOfTheChannelAreTold) {
  const std::vector<StandingAlarm> all = {alarm("critical", Priority::Critical), alarm("high"),
                                          alarm("medium", Priority::Medium), alarm("low", Priority::Low)};
  EXPECT_EQ(due(0, all), "");
  EXPECT_EQ(due(60, all), "critical high ") << "and together";
}

TEST_F(ScheduleTest, WhenItCannotBeSent_ThenItIsTriedAgainLessAndLessOftenAndNothingIsForgotten) {
  EXPECT_EQ(due(0, {alarm("a")}), "");
  EXPECT_EQ(due(60, {alarm("a")}), "a ");
  sent(60, false);
  EXPECT_EQ(due(119, {alarm("a")}), "");
  EXPECT_EQ(due(120, {alarm("a"), alarm("b")}), "a ");
  sent(120, false);
  EXPECT_EQ(due(239, {alarm("a"), alarm("b")}), "");
  EXPECT_EQ(due(240, {alarm("a"), alarm("b")}), "a b ");
  sent(240);
  EXPECT_EQ(due(241, {alarm("a"), alarm("b")}), "");
}

TEST_F(ScheduleTest, WhenTheOtherSideIsGoneForLong_ThenItIsTriedEveryQuarterOfAnHour) {
  int at = 60;
  EXPECT_EQ(due(0, {alarm("a")}), "");
  for (const int pause : {60, 120, 240, 480, 900, 900, 900}) {
    EXPECT_EQ(due(at, {alarm("a")}), "a ") << at;
    sent(at, false);
    EXPECT_EQ(due(at + pause - 1, {alarm("a")}), "") << at;
    at += pause;
  }
}

TEST_F(ScheduleTest, WhenThereIsNoRepetition_ThenItIsToldOnce) {
  Channel once = channel();
  once.repeat = seconds(0);
  once.delay = seconds(0);
  Schedule schedule(once);
  const auto count = [&](int at, std::int64_t raised_ns) {
    return schedule.due({alarm("a", Priority::High, raised_ns)}, begin_ + seconds(at)).size();
  };
  EXPECT_EQ(count(0, 1), 1u);
  schedule.sent(true, begin_);
  EXPECT_EQ(count(1'000'000, 1), 0u);
  EXPECT_EQ(count(1'000'001, 2), 1u);
}

}  // namespace
}  // namespace stepwright::notify
