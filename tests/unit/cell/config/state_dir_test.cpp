#include "cell/config/state_dir.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "cell/config/cell_config.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::config {
namespace {

// The temporary folder of everybody is the test's own.
class StateDir : public testing::Test {
 protected:
  StateDir() { setenv("TMPDIR", folder_.path().c_str(), 1); }
  ~StateDir() override { unsetenv("TMPDIR"); }

  CellConfig cell(const std::string& more = "") {
    std::ofstream(folder_ / "cell.toml") << "[cell]\nname = \"line\"\n" << more;
    return *load_cell_config(folder_ / "cell.toml");
  }
  std::string refusal(const CellConfig& config) {
    const auto claimed = claim_state_dir(config);
    return claimed ? "" : result::to_string(claimed.error());
  }
  static unsigned mode(const std::filesystem::path& path) {
    struct stat info {};
    EXPECT_EQ(stat(path.c_str(), &info), 0);
    return info.st_mode & 0777;
  }

  support::TemporaryFolder folder_;
};

TEST_F(StateDir, WhenTheCellNamesNone_ThenItIsBelowAFolderOfThisUserAlone) {
  const CellConfig config = cell();
  EXPECT_EQ(config.state_dir, folder_ / ("stepwright-" + std::to_string(geteuid())) / "line");
  const auto made = claim_state_dir(config);
  ASSERT_TRUE(made);
  EXPECT_TRUE(*made);
  EXPECT_EQ(mode(config.state_dir), 0700u);
  EXPECT_EQ(mode(config.state_dir.parent_path()), 0700u);
  const auto again = claim_state_dir(config);
  ASSERT_TRUE(again);
  EXPECT_FALSE(*again);
}

TEST_F(StateDir, WhenSomebodyElseMadeIt_ThenItIsRefusedWithTheReason) {
  const CellConfig config = cell();
  ASSERT_TRUE(claim_state_dir(config));
  for (const auto& each : {config.state_dir, config.state_dir.parent_path()}) {
    ASSERT_EQ(chmod(each.c_str(), 0777), 0);
    EXPECT_NE(refusal(config).find("everybody may write"), std::string::npos) << refusal(config);
    ASSERT_EQ(chmod(each.c_str(), 0700), 0);
    if (geteuid() != 0) continue;  // only root can give a folder away
    ASSERT_EQ(chown(each.c_str(), 65'534, 65'534), 0);
    EXPECT_NE(refusal(config).find("belongs to another user (65534)"), std::string::npos) << refusal(config);
    ASSERT_EQ(chown(each.c_str(), 0, 0), 0);
  }
  EXPECT_EQ(refusal(config), "");
}

TEST_F(StateDir, WhenALinkIsInThePlaceOfADefaultFolder_ThenItIsNotFollowed) {
  const CellConfig config = cell();
  std::filesystem::create_directory(folder_ / "elsewhere");
  std::filesystem::create_directory_symlink(folder_ / "elsewhere", config.state_dir.parent_path());
  EXPECT_NE(refusal(config).find("no folder"), std::string::npos) << refusal(config);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "elsewhere"));
}

TEST_F(StateDir, WhenTheCellNamesOne_ThenALinkOfItsOwnerIsAsGoodAsAFolder) {
  const CellConfig config = cell("state_dir = \"state\"\n");
  std::filesystem::create_directory(folder_ / "elsewhere");
  std::filesystem::create_directory_symlink(folder_ / "elsewhere", config.state_dir);
  EXPECT_EQ(refusal(config), "");
  ASSERT_EQ(chmod((folder_ / "elsewhere").c_str(), 0777), 0);
  EXPECT_NE(refusal(config).find("everybody may write"), std::string::npos);
}

// A client may be another user than the runtime, where the cell names the folder; nobody has to be there yet.
TEST_F(StateDir, WhenAClientLooks_ThenOnlyAFolderThatMayMisleadItIsRefused) {
  const auto look = [](const CellConfig& config) {
    const auto checked = check_state_dir(config);
    return checked ? "" : result::to_string(checked.error());
  };
  const CellConfig by_default = cell();
  EXPECT_EQ(look(by_default), "");
  EXPECT_FALSE(std::filesystem::exists(by_default.state_dir));
  ASSERT_TRUE(claim_state_dir(by_default));
  EXPECT_EQ(look(by_default), "");
  const CellConfig named = cell("state_dir = \"state\"\n");
  ASSERT_TRUE(claim_state_dir(named));
  if (geteuid() == 0) {  // only root can give a folder away
    ASSERT_EQ(chown(by_default.state_dir.c_str(), 65'534, 65'534), 0);
    EXPECT_NE(look(by_default).find("belongs to another user"), std::string::npos);
    ASSERT_EQ(chown(named.state_dir.c_str(), 65'534, 65'534), 0);
    EXPECT_EQ(look(named), "");
  }
  ASSERT_EQ(chmod(named.state_dir.c_str(), 0777), 0);
  EXPECT_NE(look(named).find("everybody may write"), std::string::npos);
  ASSERT_EQ(chmod(named.state_dir.c_str(), 0700), 0);
  std::filesystem::remove_all(by_default.state_dir);
  std::filesystem::create_directory_symlink(named.state_dir, by_default.state_dir);
  EXPECT_NE(look(by_default).find("no folder"), std::string::npos) << look(by_default);
}

}  // namespace
}  // namespace stepwright::config
