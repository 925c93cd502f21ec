#include "hmi_web/trends/trend_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hmi_web/trends/codes.h"

namespace stepwright::trends {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

class TrendStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::unique_ptr<TrendStore> open() const {
    auto store = TrendStore::open(folder_ / "trends.json");
    EXPECT_TRUE(store);
    return std::move(*store);
  }
  static TrendGroup group(const std::string& name) {
    return {.name = name,
            .series = {{"points/a1.level", "0..100"}, {"Main.pump", ""}, {"Main.flow", "own"}},
            .span_s = 600,
            .saved_by = "ada",
            .saved = system_clock::time_point(std::chrono::seconds(1'700'000'000))};
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "trend_store_test";
};

TEST_F(TrendStoreTest, WhenGroupsAreSaved_ThenTheNextServerHasThem) {
  {
    const auto store = open();
    EXPECT_TRUE(store->list().empty());
    ASSERT_TRUE(store->save(group("filling")));
    ASSERT_TRUE(store->save(group("drives")));
  }
  const auto groups = open()->list();
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].name, "drives");
  EXPECT_EQ(groups[1].saved_by, "ada");
  EXPECT_EQ(groups[1].saved, group("").saved);
  EXPECT_EQ(groups[1].span_s, 600);
  ASSERT_EQ(groups[1].series.size(), 3u);
  EXPECT_EQ(groups[1].series[0].tag, "points/a1.level");
  EXPECT_EQ(groups[1].series[0].axis, "0..100");
  EXPECT_EQ(groups[1].series[2].axis, "own");
}

TEST_F(TrendStoreTest, WhenAGroupIsSavedAgainOrRemoved_ThenTheOneBeforeIsTold) {
  const auto store = open();
  EXPECT_FALSE(*store->save(group("filling")));
  TrendGroup other = group("filling");
  other.span_s = 60;
  const auto before = store->save(other);
  ASSERT_TRUE(before && *before);
  EXPECT_EQ((*before)->span_s, 600);
  const auto removed = store->remove("filling");
  ASSERT_TRUE(removed);
  EXPECT_EQ(removed->span_s, 60);
  const auto again = store->remove("filling");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().front().code, kNoSuchGroup);
  EXPECT_TRUE(open()->list().empty());
}

TEST_F(TrendStoreTest, WhenNoAddressLeadsToAName_ThenItIsRefused) {
  const auto store = open();
  for (const char* name : {"", ".", "..", " ", "   ", " filling", "filling ", "a\nb"}) {
    const auto saved = store->save(group(name));
    ASSERT_FALSE(saved) << name;
    EXPECT_EQ(saved.error().front().code, kNoGroup) << name;
  }
  for (const char* name : {"...", ".a", "a/b", "50 %"}) EXPECT_TRUE(store->save(group(name))) << name;
}

TEST_F(TrendStoreTest, WhenAnEarlierServerTookSuchAName_ThenItIsCalledOtherwiseAndNothingIsLost) {
  std::ofstream(folder_ / "trends.json") << R"({"groups": [
    {"name": "..", "series": [{"tag": "a", "axis": ""}], "span_s": 60, "saved_by": "", "saved_s": 0},
    {"name": "  ", "series": [{"tag": "b", "axis": ""}], "span_s": 60, "saved_by": "", "saved_s": 0}]})";
  const auto store = open();
  ASSERT_EQ(store->list().size(), 2u);
  EXPECT_EQ(store->list()[0].name, "group");
  EXPECT_EQ(store->list()[1].name, "group ..");
  EXPECT_TRUE(store->remove("group .."));
}

TEST_F(TrendStoreTest, WhenThereAreTooMany_ThenOneMoreIsRefusedAndOneOfThemIsStillReplaced) {
  const auto store = open();
  for (std::size_t i = 0; i < kMostGroups; ++i) ASSERT_TRUE(store->save(group("g" + std::to_string(i))));
  const auto refused = store->save(group("more"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, kNoRoomForGroup);
  EXPECT_TRUE(store->save(group("g0")));
}

TEST_F(TrendStoreTest, WhenTheFileIsDamaged_ThenItIsPutAsideAndToldAndNothingStops) {
  for (const char* text :
       {"{", "{}", R"({"groups": [{"name": "x"}]})",
        R"({"groups": [{"name": "x", "series": [{"tag": "a", "axis": "5..1"}], "span_s": 60,
                              "saved_by": "", "saved_s": 0}]})"}) {
    std::ofstream(folder_ / "trends.json") << text;
    const auto store = open();
    EXPECT_TRUE(store->list().empty()) << text;
    EXPECT_NE(store->found_at_start(), "") << text;
    EXPECT_TRUE(fs::exists(folder_ / "trends.json.damaged"));
    EXPECT_TRUE(store->save(group("new")));
  }
  EXPECT_TRUE(fs::exists(folder_ / "trends.json.damaged-4")) << "the ones before stay";
}

TEST_F(TrendStoreTest, WhenAFolderHasTheName_ThenItStaysAndIsRefused) {
  fs::create_directory(folder_ / "trends.json");
  const auto refused = TrendStore::open(folder_ / "trends.json");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "H0021");
  EXPECT_TRUE(fs::is_directory(folder_ / "trends.json"));
}

TEST(TrendGroup, WhenSomethingOfItCannotBe_ThenItIsRefusedWithWhatIsMeant) {
  const auto refused = [](auto change) {
    TrendGroup group{.name = "x", .series = {{"a", ""}}};
    change(group);
    const auto checked = check_group(group);
    return !checked && checked.error().front().code == kNoGroup && !checked.error().front().hint.empty();
  };
  EXPECT_FALSE(refused([](TrendGroup&) {}));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.name = ""; }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.name = "a\nb"; }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.name = std::string(65, 'x'); }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.series.clear(); }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.series.push_back({"a", "own"}); }));
  EXPECT_TRUE(refused([](TrendGroup& g) {
    for (int i = 0; i < 12; ++i) g.series.push_back({"t" + std::to_string(i), ""});
  }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.series[0].tag = ""; }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.span_s = 0; }));
  EXPECT_TRUE(refused([](TrendGroup& g) { g.span_s = NAN; }));
  for (const char* axis : {"5..5", "1..", "..1", "1", "a..b", "1..inf", "nan..1"})
    EXPECT_FALSE(is_axis(axis)) << axis;
  for (const char* axis : {"", "own", "0..100", "-1.5..2e3", "0..0.5"}) EXPECT_TRUE(is_axis(axis)) << axis;
}

}  // namespace
}  // namespace stepwright::trends
