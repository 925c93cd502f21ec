#include "hmi_web/historian/historian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/historian/brute_force.h"

namespace stepwright::historian {
namespace {

constexpr Window kAlways = {std::numeric_limits<std::int64_t>::min(),
                            std::numeric_limits<std::int64_t>::max()};
constexpr SuppressionSettings kAll = {SuppressionKind::None};

class HistorianTest : public testing::Test {
 protected:
  void open(HistorianOptions options = {}) {
    auto opened = Historian::open(folder_ / "history.db", std::move(options));
    ASSERT_TRUE(opened.has_value()) << result::to_string(opened.error());
    historian_ = std::move(*opened);
  }
  void append(TagId tag, const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) historian_->append(tag, sample);
    ASSERT_TRUE(historian_->flush().has_value());
  }
  std::string exported(const std::vector<TagId>& tags) {
    std::string text;
    const auto damage = historian_->export_csv(tags, kAlways, [&](std::string_view piece) {
      text += piece;
      return true;
    });
    EXPECT_TRUE(damage.has_value());
    return text;
  }
  std::vector<Sample> all(TagId tag) { return historian_->range(tag, kAlways, 10'000'000).value().samples; }

  support::TemporaryFolder folder_;
  std::unique_ptr<Historian> historian_;
};

TEST_F(HistorianTest, WhenSamplesAreAppended_ThenARangeGivesThemBack) {
  open();
  const TagId level = *historian_->tag("level", kAll), other = *historian_->tag("other", kAll);
  const auto samples = random_walk(3000, 1);
  append(level, samples);
  append(other, {{7, 1.0}});
  EXPECT_EQ(all(level), samples);
  const Window window = {samples[700].time_ns, samples[1900].time_ns};
  const auto range = historian_->range(level, window);
  EXPECT_EQ(range->samples, within(samples, window));
  EXPECT_EQ(range->before, samples[699]);
  EXPECT_FALSE(range->truncated);
  EXPECT_TRUE(range->damage.empty());
  EXPECT_EQ(all(other).size(), 1u);
}

TEST_F(HistorianTest, WhenATimeIsNoted_ThenItIsKnownWithWhatWasAppendedBefore) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  EXPECT_EQ(historian_->known_until_ns(), kAlways.from_ns);
  historian_->append(level, {7, 1.0});
  historian_->note_until(9);
  historian_->note_until(8);
  ASSERT_TRUE(historian_->flush().has_value());
  EXPECT_EQ(historian_->known_until_ns(), 9) << "never back";
  EXPECT_EQ(all(level).size(), 1u);
  EXPECT_EQ(historian_->status().dropped, 0u) << "a time is of no tag";
}

TEST_F(HistorianTest, WhenMoreIsStoredThanAskedFor_ThenTheRangeSaysSo) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  const auto samples = random_walk(2000, 1);
  append(level, samples);
  const auto range = historian_->range(level, kAlways, 600);
  EXPECT_TRUE(range->truncated);
  EXPECT_EQ(range->samples, std::vector<Sample>(samples.begin(), samples.begin() + 600));
}

TEST_F(HistorianTest, WhenATrendIsDrawn_ThenEveryBucketHasTheExtremesOfItsSamples) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  const auto samples = random_walk(50'000, 2);
  append(level, samples);
  std::mt19937_64 random(3);
  const auto end = static_cast<std::uint64_t>(samples.back().time_ns);
  for (int round = 0; round < 20; ++round) {
    auto from = static_cast<std::int64_t>(random() % end), to = static_cast<std::int64_t>(random() % end);
    if (from > to) std::swap(from, to);
    const Window window = round == 0 ? Window{0, samples.back().time_ns} : Window{from, to};
    const auto trend = historian_->trend(level, window, 1 + random() % 2000);
    ASSERT_TRUE(trend.has_value());
    ASSERT_EQ(trend->buckets, buckets_of(samples, window, *trend)) << round;
  }
}

TEST_F(HistorianTest, WhenTheWindowIsExtreme_ThenATrendIsStillExact) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  const std::vector<Sample> samples = {{kAlways.from_ns, 1.0}, {0, 2.0}, {kAlways.to_ns, 3.0}};
  append(level, samples);
  const auto trend = historian_->trend(level, kAlways, 1);
  ASSERT_EQ(trend->buckets.size(), 1u);
  EXPECT_EQ(trend->buckets[0], summary_of(samples));
  const auto many = historian_->trend(level, kAlways, 1000);
  EXPECT_EQ(many->buckets.front().count, 1u);
  EXPECT_EQ(many->buckets.back().count, 1u);
  EXPECT_EQ(historian_->trend(level, {5, 5}, 100)->buckets.size(), 1u);
}

TEST_F(HistorianTest, WhenItIsOpenedAgain_ThenEverythingIsThereAndGoesOn) {
  const auto samples = random_walk(5000, 4);
  for (std::size_t part = 0; part < 5; ++part) {
    open();
    const TagId level = *historian_->tag("level", kAll);
    append(level, {samples.begin() + static_cast<std::ptrdiff_t>(part * 1000),
                   samples.begin() + static_cast<std::ptrdiff_t>(part * 1000 + 1000)});
    EXPECT_EQ(all(level).size(), (part + 1) * 1000);
    historian_.reset();
  }
  open();
  ASSERT_TRUE(historian_->find("level").has_value());
  EXPECT_EQ(all(*historian_->find("level")), samples);
  EXPECT_EQ(historian_->names(), (std::vector<std::string>{"level"}));
}

TEST_F(HistorianTest, WhenSamplesComeLate_ThenTheyStandInTheirPlace) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  auto samples = random_walk(4000, 5);
  const auto in_order = samples;
  std::mt19937 random(6);
  for (std::size_t i = 0; i + 20 < samples.size(); i += 20)
    std::shuffle(samples.begin() + static_cast<std::ptrdiff_t>(i),
                 samples.begin() + static_cast<std::ptrdiff_t>(i + 20), random);
  std::rotate(samples.begin(), samples.begin() + 1000, samples.end());  // the oldest quarter comes last
  append(level, samples);
  EXPECT_EQ(all(level), in_order);
  const Window window = {0, in_order.back().time_ns};
  const auto trend = historian_->trend(level, window, 50);
  EXPECT_EQ(trend->buckets, buckets_of(in_order, window, *trend));
}

TEST_F(HistorianTest, WhenALineIsKeptByASwingingDoor_ThenItsNewestPointIsReadAndSurvives) {
  open();
  const TagId level = *historian_->tag("level", {SuppressionKind::SwingingDoor, 0.1});
  std::vector<Sample> samples;
  for (std::int64_t t = 0; t <= 1000; ++t) samples.push_back({t, static_cast<double>(t)});
  append(level, samples);
  const std::vector<Sample> ends = {samples.front(), samples.back()};
  EXPECT_EQ(all(level), ends);
  historian_.reset();
  open();
  EXPECT_EQ(all(*historian_->find("level")), ends);
}

TEST_F(HistorianTest, WhenSettingsChange_ThenTheyHoldFromTheNextSampleOn) {
  open();
  const TagId level = *historian_->tag("level", {SuppressionKind::SwingingDoor, 1.0});
  append(level, {{0, 0}, {1, 0}, {2, 0}});
  EXPECT_EQ(*historian_->tag("level", kAll), level);
  append(level, {{3, 0}, {4, 0}});
  EXPECT_EQ(all(level), (std::vector<Sample>{{0, 0}, {2, 0}, {3, 0}, {4, 0}}));
}

TEST_F(HistorianTest, WhenExported_ThenEverySampleIsALineOfCsv) {
  open();
  const TagId level = *historian_->tag("level", kAll), odd = *historian_->tag("say \"a\",b", kAll);
  append(level, {{0, 0.1}, {1'500'000'000, -3.0, Quality::Bad}, {1'800'000'000'000'000'001, 1e300}});
  append(odd, {{-1, 2.0}});
  EXPECT_EQ(exported({level, odd}),
            "tag,time,value,quality\r\n"
            "level,1970-01-01T00:00:00Z,0.1,good\r\n"
            "level,1970-01-01T00:00:01.5Z,-3,bad\r\n"
            "level,2027-01-15T08:00:00.000000001Z,1e+300,good\r\n"
            "\"say \"\"a\"\",b\",1969-12-31T23:59:59.999999999Z,2,good\r\n");
}

TEST_F(HistorianTest, WhenANumberBeyond2To53IsExported_ThenItSaysNoDigitsThatWereNotKept) {
  open();
  const TagId count = *historian_->tag("count", kAll);
  append(count, {{0, 9007199254740992.0}, {1'000'000'000, 18446744073709551615.0}});
  EXPECT_EQ(exported({count}),
            "tag,time,value,quality\r\n"
            "count,1970-01-01T00:00:00Z,9007199254740992,good\r\n"
            "count,1970-01-01T00:00:01Z,1.8446744073709552e+19,good\r\n");
}

TEST_F(HistorianTest, WhenTheSinkWantsNoMore_ThenTheExportEnds) {
  open();
  const TagId level = *historian_->tag("level", kAll);
  append(level, random_walk(20'000, 7));
  int pieces = 0;
  const std::vector<TagId> tags = {level, level};
  ASSERT_TRUE(
      historian_->export_csv(tags, kAlways, [&](std::string_view) { return ++pieces < 3; }).has_value());
  EXPECT_EQ(pieces, 3);
}

TEST_F(HistorianTest, WhenAskedForWhatIsNot_ThenTheErrorSaysIt) {
  open();
  const TagId level = *historian_->tag("level");
  EXPECT_EQ(historian_->range(TagId(99), kAlways).error()[0].code, "S0013");
  EXPECT_EQ(historian_->range(level, {5, 4}).error()[0].code, "S0014");
  EXPECT_EQ(historian_->trend(level, kAlways, 0).error()[0].code, "S0014");
  EXPECT_EQ(historian_->tag("").error()[0].code, "S0012");
  EXPECT_EQ(historian_->tag("x", {SuppressionKind::SwingingDoor, -1.0}).error()[0].code, "S0012");
  EXPECT_EQ(historian_->tag("x", {SuppressionKind::Repeats, 0.0, 0}).error()[0].code, "S0012");
  EXPECT_FALSE(historian_->find("x").has_value());
  historian_->append(TagId(99), {1, 1.0});
  ASSERT_TRUE(historian_->flush().has_value());
  EXPECT_EQ(historian_->status().dropped, 1u);
}

TEST_F(HistorianTest, WhenAnotherProcessWritesTheFile_ThenOpeningSaysSo) {
  open();
  const auto second = Historian::open(folder_ / "history.db");
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error()[0].code, "S0004");
}

TEST_F(HistorianTest, WhenReadersLookWhileItWrites_ThenTheySeeAPrefix) {
  open({.commit_period = std::chrono::milliseconds(1)});
  const TagId level = *historian_->tag("level", kAll);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 20'000; ++i) historian_->append(level, {i, static_cast<double>(i)});
    EXPECT_TRUE(historian_->flush().has_value());
    done = true;
  });
  std::size_t before = 0;
  while (!done) {
    const auto samples = all(level);
    ASSERT_GE(samples.size(), before);
    before = samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_EQ(samples[i].value, static_cast<double>(i));
  }
  writer.join();
  EXPECT_EQ(all(level).size(), 20'000u);
}

}  // namespace
}  // namespace stepwright::historian
