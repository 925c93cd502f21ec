#include "hmi_web/screens/screen_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace stepwright::screens {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using std::chrono::system_clock;
using testing::HasSubstr;

std::string svg(const std::string& inside, const std::string& more = "") {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10' " + more + ">\n" + inside + "</svg>";
}

class ScreenStoreTest : public testing::Test {
 protected:
  result::Result<Version> save(std::uint32_t based_on, const std::string& text,
                               const std::string& user = "emil") {
    return store_->save({.name = "Mixer", .svg = text, .based_on = based_on, .user = user, .comment = "why"},
                        system_clock::time_point{seconds(1'700'000'000)});
  }
  std::string shown() const {
    const auto screen = store_->find("Mixer");
    return store_->read("Mixer", screen->current()->number)->svg;
  }
  void open_again() { store_ = *ScreenStore::open(dir_); }
  void write(const fs::path& file, const std::string& text) { std::ofstream(dir_ / file) << text; }

  support::TemporaryFolder folder_;
  fs::path dir_ = folder_ / "screens";
  std::unique_ptr<ScreenStore> store_ = *ScreenStore::open(dir_);
};

TEST_F(ScreenStoreTest, WhenAScreenIsSaved_ThenEveryVersionIsKeptWithWhoAndWhen) {
  ASSERT_EQ(save(0, svg("<circle r='1'/>"))->number, 1u);
  ASSERT_EQ(save(1, svg("<circle r='2'/>", "data-least='operator'"), "ada")->number, 2u);
  open_again();
  const auto screen = store_->find("Mixer");
  ASSERT_TRUE(screen);
  ASSERT_EQ(screen->versions.size(), 2u);
  EXPECT_EQ(screen->current()->number, 2u);
  EXPECT_EQ(screen->current()->saved_by, "ada");
  EXPECT_EQ(screen->current()->least, "operator");
  EXPECT_EQ(screen->versions[0].saved_by, "emil");
  EXPECT_EQ(screen->versions[0].saved, system_clock::time_point{seconds(1'700'000'000)});
  EXPECT_EQ(screen->versions[0].comment, "why");
  EXPECT_THAT(shown(), HasSubstr("r=\"2\""));
  EXPECT_THAT(store_->read("Mixer", 1)->svg, HasSubstr("r=\"1\""));
}

TEST_F(ScreenStoreTest, WhenTwoPeopleBeganWithTheSameVersion_ThenTheSecondOnesIsKeptAside) {
  ASSERT_TRUE(save(0, svg("")));
  ASSERT_TRUE(save(1, svg("<circle r='2'/>"), "ada"));
  const auto mine = save(1, svg("<circle r='3'/>"), "emil");
  ASSERT_TRUE(mine);
  EXPECT_TRUE(mine->aside);
  EXPECT_EQ(mine->number, 3u);
  EXPECT_THAT(shown(), HasSubstr("r=\"2\"")) << "the other one is shown";
  EXPECT_THAT(store_->read("Mixer", 3)->svg, HasSubstr("r=\"3\"")) << "and mine is not lost";
  EXPECT_EQ(save(1, svg("<circle r='3'/>"), "emil")->number, 3u) << "who tries again gets no further copy";
  // On top of the other one it is shown.
  const auto chosen = save(2, svg("<circle r='3'/>"), "emil");
  EXPECT_FALSE(chosen->aside);
  EXPECT_THAT(shown(), HasSubstr("r=\"3\""));
}

TEST_F(ScreenStoreTest, WhenTwoPeopleMakeAScreenOfTheSameName_ThenTheSecondLiesAside) {
  ASSERT_TRUE(save(0, svg("<circle r='1'/>"), "ada"));
  EXPECT_TRUE(save(0, svg("<circle r='2'/>"), "emil")->aside);
}

TEST_F(ScreenStoreTest, WhenAScreenIsRemoved_ThenItsVersionsStayAndCanBeSavedAnew) {
  ASSERT_TRUE(save(0, svg("")));
  ASSERT_TRUE(save(1, svg("<circle r='2'/>")));
  EXPECT_EQ(store_->remove("Mixer", 1, "ada", {}).error()[0].code, "H0122")
      << "what nobody saw is not removed";
  ASSERT_TRUE(store_->remove("Mixer", 2, "ada", {}));
  EXPECT_TRUE(store_->find("Mixer")->current()->removed);
  EXPECT_EQ(store_->remove("Mixer", 3, "ada", {}).error()[0].code, "H0120");
  EXPECT_EQ(store_->read("Mixer", 3).error()[0].code, "H0120");
  open_again();
  EXPECT_TRUE(store_->find("Mixer")->current()->removed);
  ASSERT_TRUE(store_->read("Mixer", 2));
  EXPECT_FALSE(save(0, store_->read("Mixer", 2)->svg)->aside);
  EXPECT_THAT(shown(), HasSubstr("r=\"2\""));
}

TEST_F(ScreenStoreTest, WhenASvgCouldDoHarm_ThenItIsRefusedWithItsPlaceAndNothingIsKept) {
  const auto saved = save(0, svg("<rect/>\n<script>alert(1)</script>\n<rect onclick='x()'/>"
                                 "<use href='https://elsewhere/a.svg#b'/>"));
  ASSERT_FALSE(saved);
  ASSERT_EQ(saved.error().size(), 3u);
  EXPECT_EQ(saved.error()[0].code, "C0641");
  EXPECT_EQ(saved.error()[0].where.line, 3u);
  EXPECT_EQ(saved.error()[1].code, "C0642");
  EXPECT_EQ(saved.error()[1].where.line, 4u);
  EXPECT_FALSE(store_->find("Mixer"));
  EXPECT_FALSE(fs::exists(dir_ / "Mixer"));
}

TEST_F(ScreenStoreTest, WhenADrawingIsPutIntoTheFolder_ThenItIsAScreenThatPeopleGoOnWith) {
  write("Mixer.svg", svg("<circle r='7'/>"));
  write("Bad.svg", svg("<script/>"));
  open_again();
  EXPECT_THAT(shown(), HasSubstr("r=\"7\""));
  ASSERT_EQ(store_->damaged().size(), 1u);
  EXPECT_EQ(store_->damaged()[0].where.line, 2u);
  ASSERT_EQ(save(0, svg("<circle r='8'/>"))->number, 1u);
  open_again();
  EXPECT_THAT(shown(), HasSubstr("r=\"8\""));
  EXPECT_THAT(store_->read("Mixer", 0)->svg, HasSubstr("r=\"7\""));
}

TEST_F(ScreenStoreTest, WhenThereAreManyVersions_ThenTheOldestGo) {
  for (std::uint32_t i = 0; i < kMostVersions + 3; ++i) ASSERT_TRUE(save(i, svg("")));
  open_again();
  const auto screen = store_->find("Mixer");
  EXPECT_EQ(screen->versions.size(), kMostVersions);
  EXPECT_EQ(screen->versions.front().number, 4u);
  EXPECT_EQ(screen->current()->number, kMostVersions + 3);
}

TEST_F(ScreenStoreTest, WhenAFileIsDamaged_ThenItsVersionIsLeftOutAndTheOthersStay) {
  ASSERT_TRUE(save(0, svg("<circle r='1'/>")));
  ASSERT_TRUE(save(1, svg("")));
  write("Mixer/000002.json", "{");
  open_again();
  ASSERT_EQ(store_->damaged().size(), 1u);
  EXPECT_EQ(store_->damaged()[0].code, "H0124");
  EXPECT_THAT(shown(), HasSubstr("r=\"1\""));
}

TEST_F(ScreenStoreTest, WhenANameLeadsElsewhere_ThenNothingIsTouched) {
  for (const char* name : {"../secret", "..", "a/b", "", " a", "a."}) {
    const auto saved = store_->save({.name = name, .svg = svg("")}, {});
    ASSERT_FALSE(saved) << name;
    EXPECT_EQ(saved.error()[0].code, "H0121") << name;
  }
}

TEST_F(ScreenStoreTest, WhenAStartIsChosen_ThenItIsKept) {
  EXPECT_EQ(store_->set_start("Mixer").error()[0].code, "H0120");
  ASSERT_TRUE(save(0, svg("")));
  ASSERT_TRUE(store_->set_start("Mixer"));
  open_again();
  EXPECT_EQ(store_->start(), "Mixer");
}

TEST_F(ScreenStoreTest, WhenARoleHasAStartOfItsOwn_ThenItIsKeptBesideThatOfEverybody) {
  ASSERT_TRUE(save(0, svg("")));
  EXPECT_EQ(store_->set_start("Mixer", "../viewer").error()[0].code, "H0120");
  ASSERT_TRUE(store_->set_start("Mixer", "operator"));
  open_again();
  EXPECT_EQ(store_->start("operator"), "Mixer");
  EXPECT_EQ(store_->start(), "");
  ASSERT_TRUE(store_->set_start("", "operator"));
  ASSERT_TRUE(store_->set_start("", "operator")) << "there is none already";
  open_again();
  EXPECT_EQ(store_->start("operator"), "");
}

TEST_F(ScreenStoreTest, WhenScreensAreCalledStart_ThenTheyAndTheStartScreensAreKept) {
  for (const char* name : {"start", "start-viewer", "start-operator", "start-engineer"})
    ASSERT_TRUE(store_->save({.name = name, .svg = svg("")}, {})) << name;
  for (const char* role : {"", "viewer", "operator", "engineer"})
    ASSERT_TRUE(store_->set_start("start-viewer", role)) << role;
  ASSERT_TRUE(store_->save({.name = "start", .svg = svg("<circle r='2'/>"), .based_on = 1}, {}));
  open_again();
  EXPECT_TRUE(store_->damaged().empty());
  EXPECT_EQ(store_->list().size(), 4u);
  for (const char* role : {"", "viewer", "operator", "engineer"})
    EXPECT_EQ(store_->start(role), "start-viewer") << role;
}

TEST_F(ScreenStoreTest, WhenTheFolderIsOfBefore_ThenItsStartsAreMovedAndRestsGo) {
  ASSERT_TRUE(save(0, svg("")));
  write("start", "Mixer");
  write("start-viewer", "Mixer");
  write("start-viewer.new", "Mix");
  open_again();
  EXPECT_EQ(store_->start(), "Mixer");
  EXPECT_EQ(store_->start("viewer"), "Mixer");
  for (const char* old : {"start", "start-viewer", "start-viewer.new"})
    EXPECT_FALSE(fs::exists(dir_ / old)) << old;
  EXPECT_TRUE(store_->save({.name = "start", .svg = svg("")}, {}));
  ASSERT_TRUE(store_->set_start(""));
  open_again();
  EXPECT_EQ(store_->start(), "") << "what was moved does not come back";
}

TEST_F(ScreenStoreTest, WhenANameEndsAsAFile_ThenItIsRefusedInWords) {
  for (const char* name : {"Mixer.svg", "a.SVG"}) {
    const auto saved = store_->save({.name = name, .svg = svg("")}, {});
    ASSERT_FALSE(saved) << name;
    EXPECT_EQ(saved.error()[0].code, "H0121");
    EXPECT_THAT(saved.error()[0].message, HasSubstr("does not end in .svg"));
  }
  EXPECT_TRUE(store_->save({.name = "svg", .svg = svg("")}, {}));
  const auto of_the_server = store_->save({.name = "server.lock", .svg = svg("")}, {});
  ASSERT_FALSE(of_the_server);
  EXPECT_EQ(of_the_server.error()[0].code, "H0121");
}

}  // namespace
}  // namespace stepwright::screens
