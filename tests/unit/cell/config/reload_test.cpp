#include "cell/config/reload.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace stepwright::config {
namespace {

class ReloadTest : public testing::Test {
 protected:
  ReloadTest() : folder_(testing::TempDir() + "reload." + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~ReloadTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder_ / "cell.toml") << text;
    return folder_ / "cell.toml";
  }
  CellConfig running(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    auto config = load_cell_config(write(text), overrides);
    EXPECT_TRUE(config) << (config ? "" : result::to_string(config.error()));
    return *config;
  }

  const std::vector<std::string_view> reloadable_ = {"log.", "safe_state.supervisor_lost_after_ms"};
  std::filesystem::path folder_;
};

TEST_F(ReloadTest, WhenNothingChanged_ThenThereAreNoNotes) {
  const auto again = reload_cell(running("[log]\nlevel = \"info\"\n"), reloadable_);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->notes.empty());
}

TEST_F(ReloadTest, WhenAReloadableValueChanged_ThenItIsInForce) {
  const CellConfig before = running("[log]\nlevel = \"info\"\n");
  write("[log]\nlevel = \"error\"\n[safe_state]\nsupervisor_lost_after_ms = 250\n");
  const auto again = reload_cell(before, reloadable_);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->config.log.level, log::LogLevel::Error);
  EXPECT_EQ(again->config.supervisor_lost_after, std::chrono::milliseconds(250));
  ASSERT_EQ(again->notes.size(), 2u);
  EXPECT_EQ(again->notes[0].code, "C0464");
  EXPECT_EQ(again->notes[0].severity, result::Severity::Note);
  EXPECT_TRUE(reload_cell(again->config, reloadable_)->notes.empty());
}

TEST_F(ReloadTest, WhenAnotherValueChanged_ThenItNeedsARestartUntilThereIsOne) {
  const CellConfig before = running("[plant]\nseed = 1\n");
  write("[plant]\nseed = 2\n[[faults]]\nat_s = 1\nname = \"leak_a1\"\nvalue = 1\n");
  auto again = reload_cell(before, reloadable_);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->notes.size(), 4u) << result::to_string(again->notes);
  EXPECT_EQ(again->notes[3].code, "C0465");
  EXPECT_EQ(again->notes[3].where.line, 2u);
  EXPECT_NE(again->notes[3].message.find("plant.seed"), std::string::npos);
  EXPECT_EQ(again->config.plant.seed, 1u);
  EXPECT_EQ(again->wanted.plant.seed, 2u);
  again = reload_cell(again->config, reloadable_);
  EXPECT_EQ(again->notes.size(), 4u);
}

TEST_F(ReloadTest, WhenAValueIsLeftOut_ThenItTakesItsDefault) {
  const CellConfig before = running("[log]\nlevel = \"error\"\n");
  write("");
  const auto again = reload_cell(before, reloadable_);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->config.log.level, log::LogLevel::Info);
  ASSERT_EQ(again->notes.size(), 1u);
  EXPECT_NE(again->notes[0].message.find("left out"), std::string::npos);
}

TEST_F(ReloadTest, WhenTheFileIsWrong_ThenItsPlaceIsSaid) {
  const CellConfig before = running("[log]\nlevel = \"info\"\n");
  write("[log]\nlevel = \"loud\"\n");
  const auto again = reload_cell(before, reloadable_);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error()[0].where.line, 2u);
}

TEST_F(ReloadTest, WhenAValueWasGivenOnTheCommandLine_ThenItStillWins) {
  const CellConfig before = running("[plant]\nseed = 1\n", {"plant.seed=5"});
  write("[plant]\nseed = 2\n");
  const auto again = reload_cell(before, reloadable_);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->notes.empty());
}

}  // namespace
}  // namespace stepwright::config
