#include "cell/config/change_config.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cell/config/cell_config.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::config {
namespace {

result::Result<CellConfig> read(const std::string& text) {
  const support::TemporaryFolder folder;  // of its own: tests run beside each other
  const std::filesystem::path file = folder / "cell.toml";
  std::ofstream(file) << text;
  return load_cell_config(file);
}

TEST(ChangeConfig, WhenNothingIsSaid_ThenATrialHasTenScans) {
  const auto config = read("");
  ASSERT_TRUE(config) << result::to_string(config.error());
  EXPECT_EQ(config->change.trial_scans, 10u);
}

TEST(ChangeConfig, WhenANumberIsGiven_ThenItHoldsAndZeroIsPossible) {
  EXPECT_EQ(read("[change]\ntrial_scans = 250\n")->change.trial_scans, 250u);
  EXPECT_EQ(read("[change]\ntrial_scans = 0\n")->change.trial_scans, 0u);
}

TEST(ChangeConfig, WhenItIsWrong_ThenItsPlaceIsNamed) {
  const std::pair<const char*, const char*> wrong[] = {
      {"[change]\ntrial_scans = -1\n", ":2:15: C0004"},
      {"[change]\ntrial_scans = \"ten\"\n", ":2:15: C0003"},
      {"[change]\ntrial_scan = 5\n", ":2:1: C0002"},
  };
  for (const auto& [text, place] : wrong) {
    const auto config = read(text);
    ASSERT_FALSE(config) << text;
    EXPECT_NE(result::to_string(config.error()).find(place), std::string::npos)
        << result::to_string(config.error());
  }
}

}  // namespace
}  // namespace stepwright::config
