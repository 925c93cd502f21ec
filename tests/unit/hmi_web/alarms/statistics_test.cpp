#include "hmi_web/alarms/statistics.h"

#include <gtest/gtest.h>

namespace stepwright::alarms {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

class AlarmStatisticsTest : public testing::Test {
 protected:
  AlarmStatisticsTest() {
    for (int i = 0; i < 20; ++i) {
      AlarmDefinition& one = definitions_.emplace_back();
      one.name = one.source = std::to_string(i);
      one.priority = i == 0 ? Priority::Critical : Priority::Low;
      one.traits.acknowledge_on_return = true;
    }
    engine_.emplace(AlarmEngine::create(definitions_).value());
    statistics_.emplace(definitions_);
  }
  void set(std::uint32_t alarm, double second, double value) {
    engine_->offer(SourceId(alarm), static_cast<std::int64_t>(second * kSecond), value, true);
    note();
  }
  void note() {
    for (const Transition& t : engine_->take()) statistics_->note(t);
  }
  void blink(std::uint32_t alarm, double second) {
    set(alarm, second, 1);
    set(alarm, second + 0.1, 0);
  }
  AlarmFigures at(double second) { return statistics_->figures(static_cast<std::int64_t>(second * kSecond)); }

  std::vector<AlarmDefinition> definitions_;
  std::optional<AlarmEngine> engine_;
  std::optional<AlarmStatistics> statistics_;
};

TEST_F(AlarmStatisticsTest, WhenTenMinutesPass_ThenTheRateForgets) {
  for (std::uint32_t i = 0; i < 6; ++i) blink(i, 100.0 * i);
  EXPECT_EQ(at(500).in_ten_minutes, 6u);
  EXPECT_EQ(at(600).in_ten_minutes, 5u);
  EXPECT_EQ(at(1000).in_ten_minutes, 1u);
  const AlarmFigures later = at(90'000);
  EXPECT_EQ(later.in_ten_minutes, 0u);
  EXPECT_EQ(later.most_in_ten_minutes, 6u);
  EXPECT_EQ(later.annunciated, 6u);
  EXPECT_EQ(later.floods, 0u);
}

TEST_F(AlarmStatisticsTest, WhenManyComeAtOnce_ThenItIsAFloodUntilFewerThanFiveAreLeft) {
  blink(0, 0);
  for (std::uint32_t i = 0; i < 12; ++i) blink(i, 100 + 10 * i);
  EXPECT_TRUE(at(230).flood);
  EXPECT_TRUE(at(769).flood);   // those of 170 s and later: 5
  EXPECT_FALSE(at(770).flood);  // 4
  const AlarmFigures figures = at(1560);
  EXPECT_EQ(figures.floods, 1u);
  // From the tenth (the first of all and nine more: 180 s) to 770 s.
  EXPECT_NEAR(figures.flood_share, 590.0 / 1560.0, 2.0 / 1560.0);
}

TEST_F(AlarmStatisticsTest, WhenAnAlarmComesThriceAMinute_ThenItChatters) {
  for (const double second : {0.0, 20.0, 40.0}) blink(3, second);
  for (const double second : {0.0, 40.0, 80.0}) blink(4, 100 + second);
  EXPECT_TRUE(at(185).chattering.empty()) << "one is quiet for more than a minute, the other one is slower";
  for (const double second : {190.0, 200.0, 210.0}) blink(3, second);
  EXPECT_EQ(at(215).chattering, (std::vector<AlarmId>{AlarmId(3)}));
  ASSERT_EQ(at(215).most_frequent.size(), 2u);
  EXPECT_EQ(at(215).most_frequent[0].alarm, AlarmId(3));
  EXPECT_EQ(at(215).most_frequent[0].count, 6u);
}

TEST_F(AlarmStatisticsTest, WhenAlarmsStand_ThenTheyAreCountedByPriorityAndGrowStale) {
  set(0, 0, 1);
  set(1, 0, 1);
  set(2, 50'000, 1);
  ASSERT_TRUE(engine_->command({AlarmId(1), AlarmEvent::Acknowledge, 60'000 * kSecond}).has_value());
  ASSERT_TRUE(
      engine_->command({AlarmId(5), AlarmEvent::Shelve, 60'000 * kSecond, "", "", std::chrono::hours(1)})
          .has_value());
  ASSERT_TRUE(engine_->command({AlarmId(6), AlarmEvent::RemoveFromService, 60'000 * kSecond}).has_value());
  note();
  const AlarmFigures figures = at(90'000);
  EXPECT_EQ(figures.standing, (std::array<std::uint32_t, kPriorities>{1, 0, 0, 2}));
  EXPECT_EQ(figures.unacknowledged, 2u);
  EXPECT_EQ(figures.shelved, 1u);
  EXPECT_EQ(figures.out_of_service, 1u);
  EXPECT_EQ(figures.stale, (std::vector<AlarmId>{AlarmId(0), AlarmId(1)}));
}

TEST_F(AlarmStatisticsTest, WhenNothingHasHappened_ThenThereIsNothing) {
  const AlarmFigures figures = at(5);
  EXPECT_EQ(figures.annunciated, 0u);
  EXPECT_EQ(figures.flood_share, 0.0);
  EXPECT_TRUE(figures.most_frequent.empty());
}

}  // namespace
}  // namespace stepwright::alarms
