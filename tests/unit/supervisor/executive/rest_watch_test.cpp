#include "supervisor/executive/rest_watch.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/executive/bench_fixture.h"

namespace stepwright::executive {
namespace {

// The bench with 2 in every tank and the vehicle at f1.
class RestWatchTest : public ::testing::Test {
 protected:
  RestWatchTest() {
    model::NamedState start;
    start.facts = {"(is-at v1 f1)"};
    start.fluents = {{"(lev v1)", 2.0}, {"(level a1)", 2.0}, {"(level a2)", 2.0}};
    watch_.emplace(bench_desk().binding(), translate::Tare{}, start);
  }

  std::optional<std::string> see(double s2_level) {
    const auto& sensors = bench_desk().binding().sensors;
    values_["S1"] = sensors[0].calibration.counts_at(2.0);
    values_["S2"] = sensors[1].calibration.counts_at(s2_level);
    values_["S3"] = sensors[2].calibration.counts_at(2.0);
    return watch_->see(values_, ++scan_);
  }

  std::map<std::string, double> values_ = {{"fc1", 1.0}, {"fc2", 0.0}, {"fc3", 0.0}};
  std::optional<RestWatch> watch_;
  std::uint64_t scan_ = 0;
};

TEST_F(RestWatchTest, WhenNothingMoves_ThenThereIsNoNews) {
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(see(2.0 + (i % 2 == 0 ? 0.3 : -0.3)));
}

TEST_F(RestWatchTest, WhenALevelWalksAway_ThenItIsNamed) {
  std::optional<std::string> news;
  int i = 0;
  for (; i < 100 && !news; ++i) news = see(2.0 - 0.02 * i);
  ASSERT_TRUE(news);
  EXPECT_NE(news->find("level of a1"), std::string::npos) << *news;
  EXPECT_LT(i, 45);
}

TEST_F(RestWatchTest, WhenASwitchBounces_ThenOnlyALastingChangeIsNews) {
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  values_["fc1"] = 1.0;
  EXPECT_FALSE(see(2.0));
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  const auto news = see(2.0);
  ASSERT_TRUE(news);
  EXPECT_EQ(*news, "'vehicle at f1' is not observed now");
}

TEST_F(RestWatchTest, WhenAScanIsSeenTwice_ThenItCountsOnce) {
  values_["fc1"] = 0.0;
  EXPECT_FALSE(see(2.0));
  --scan_;
  EXPECT_FALSE(see(2.0));
}

}  // namespace
}  // namespace stepwright::executive
