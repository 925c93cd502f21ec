#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "hmi_web/historian/historian.h"
#include "hmi_web/storage/database.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/historian/brute_force.h"

namespace stepwright::historian {
namespace {

constexpr std::int64_t kHour = 3'600'000'000'000;
constexpr Window kAlways = {0, std::numeric_limits<std::int64_t>::max()};
constexpr SuppressionSettings kAll = {SuppressionKind::None};

std::vector<Sample> stored(Historian& historian, TagId tag) {
  return historian.range(tag, kAlways, 10'000'000).value().samples;
}

TEST(Retention, WhenSamplesAreTooOld_ThenTheirBlocksGoAndTheRestIsExact) {
  const support::TemporaryFolder folder;
  std::atomic<std::int64_t> now = 0;
  HistorianOptions options;
  options.commit_period = std::chrono::milliseconds(5);
  options.most_age = std::chrono::hours(10);
  options.now_ns = [&] { return now.load(); };
  auto historian = Historian::open(folder / "history.db", options).value();
  const TagId level = *historian->tag("level", kAll);
  const auto samples = random_walk(60'000, 8);  // 17 hours
  for (const Sample& sample : samples) historian->append(level, sample);
  ASSERT_TRUE(historian->flush().has_value());
  EXPECT_EQ(stored(*historian, level).size(), samples.size());

  now = samples.back().time_ns;
  std::vector<Sample> left = stored(*historian, level);
  while (left.front().time_ns < now - 10 * kHour - kHour) {  // a test that does not end says what is wrong
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    left = stored(*historian, level);
  }
  EXPECT_EQ(left,
            std::vector<Sample>(samples.end() - static_cast<std::ptrdiff_t>(left.size()), samples.end()));
  EXPECT_GE(left.size(), within(samples, {now - 10 * kHour, now}).size()) << "nothing younger goes";
  // Extremes are not those of deleted blocks, before and after more has come and the file was opened again.
  const Window window = {0, samples.back().time_ns};
  for (int round = 0; round < 2; ++round) {
    const auto trend = historian->trend(level, window, 7);
    EXPECT_EQ(trend->buckets, buckets_of(left, window, *trend));
    historian.reset();
    options.most_age = std::chrono::hours(0);
    historian = Historian::open(folder / "history.db", options).value();
  }
}

TEST(Retention, WhenTheFileIsTooLarge_ThenTheOldestOfAllTagsGo) {
  const support::TemporaryFolder folder;
  HistorianOptions options;
  options.commit_period = std::chrono::milliseconds(5);
  options.most_bytes = 250'000;
  auto historian = Historian::open(folder / "history.db", options).value();
  const std::vector<TagId> tags = {*historian->tag("a", kAll), *historian->tag("b", kAll)};
  const auto samples = random_walk(100'000, 9);
  for (const Sample& sample : samples)
    for (const TagId tag : tags) historian->append(tag, sample);
  ASSERT_TRUE(historian->flush().has_value());
  while (historian->status().file_bytes > options.most_bytes) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    historian->append(tags[0], samples.back());
    ASSERT_TRUE(historian->flush().has_value());
  }
  std::vector<std::int64_t> oldest;
  for (const TagId tag : tags) {
    const auto left = stored(*historian, tag);
    ASSERT_FALSE(left.empty());
    oldest.push_back(left.front().time_ns);
    const Window window = {left.front().time_ns, samples.back().time_ns - 1};
    EXPECT_EQ(within(left, window), within(samples, window));
  }
  EXPECT_LT(std::abs(oldest[0] - oldest[1]), kHour);
}

TEST(Retention, WhenEveryBlockOfATagIsGone_ThenARestartStillFindsItsNewestSamples) {
  const support::TemporaryFolder folder;
  std::atomic<std::int64_t> now = 0;
  HistorianOptions options;
  options.commit_period = std::chrono::milliseconds(5);
  options.most_age = std::chrono::hours(10);
  options.now_ns = [&] { return now.load(); };
  auto historian = Historian::open(folder / "history.db", options).value();
  const TagId level = *historian->tag("level", kAll);
  for (std::int64_t i = 0; i < 600; ++i) historian->append(level, {i, static_cast<double>(i % 7)});
  ASSERT_TRUE(historian->flush().has_value());
  now = 20 * kHour;
  historian->append(level, {now, 3.0});
  while (stored(*historian, level).front().time_ns == 0)  // a test that does not end says what is wrong
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_TRUE(historian->flush().has_value());
  const auto before = stored(*historian, level);
  ASSERT_EQ(before.size(), 89u);
  for (int round = 0; round < 2; ++round) {
    historian.reset();
    historian = Historian::open(folder / "history.db", options).value();
    EXPECT_EQ(stored(*historian, level), before) << round;
  }
  // And numbers go on behind those that are gone.
  ASSERT_EQ(*historian->tag("level", kAll), level);
  for (std::int64_t i = 1; i <= 600; ++i) historian->append(level, {now + i, static_cast<double>(i)});
  ASSERT_TRUE(historian->flush().has_value());
  historian.reset();
  historian = Historian::open(folder / "history.db", options).value();
  EXPECT_EQ(stored(*historian, level).size(), 689u);
}

}  // namespace
}  // namespace stepwright::historian
