#include "hmi_web/server/trend_buffer.h"

#include <gtest/gtest.h>

namespace stepwright::server {
namespace {

TEST(TrendBuffer, WhenItIsFull_ThenTheOldestRowsGoAndNumbersStay) {
  TrendBuffer buffer(3);
  for (int i = 0; i < 5; ++i) buffer.add({static_cast<double>(i), {}});

  std::uint64_t from = 0;
  const auto rows = buffer.rows(from, 10);

  EXPECT_EQ(from, 2u);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows.front().time_s, 2);
  EXPECT_EQ(buffer.end(), 5u);
}

TEST(TrendBuffer, WhenTimeStandsStill_ThenNoRowIsAdded) {
  TrendBuffer buffer(3);
  buffer.add({1, {1.0}});
  buffer.add({1, {2.0}});

  EXPECT_EQ(buffer.end(), 1u);
}

TEST(TrendBuffer, WhenTimeRunsBackwards_ThenAnotherRunBegins) {
  TrendBuffer buffer(3);
  buffer.add({5, {}});
  buffer.add({1, {}});

  EXPECT_EQ(buffer.run(), 1u);
  EXPECT_EQ(buffer.end(), 1u);
}

TEST(TrendBuffer, WhenAskedBeyondTheEnd_ThenThereIsNothing) {
  TrendBuffer buffer(3);
  buffer.add({5, {}});

  std::uint64_t from = 99;
  EXPECT_TRUE(buffer.rows(from, 10).empty());
  EXPECT_EQ(from, 1u);
}

}  // namespace
}  // namespace stepwright::server
