#include "cell/processes/cell_record.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::processes {
namespace {

TEST(CellRecord, WhenItIsWritten_ThenItIsReadTheSame) {
  const support::TemporaryFolder folder;
  CellRecord record;
  record.cell = "line";
  record.config = "/cells/line/cell.toml";
  record.pid = 41;
  record.address = "http://127.0.0.1:8080/";
  record.ready = true;
  record.processes = {{"runtime", 42, "ready", 3, "ended with 5"}, {"link", 0, "failed", 5, "ended with 1"}};
  record.clock = "simulated";
  record.killed = {"link"};
  ASSERT_TRUE(write_record(folder.path() / "up.json", record).empty());
  const auto read = read_record(folder.path() / "up.json");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, record);
}

TEST(CellRecord, WhenItIsNoRecord_ThenItIsRefused) {
  const support::TemporaryFolder folder;
  for (const char* text : {"", "[]", "{\"cell\": 3}", "{\"cell\": \"line\"}"}) {
    std::ofstream(folder.path() / "up.json") << text;
    const auto read = read_record(folder.path() / "up.json");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().front().code, "M0015");
  }
}

TEST(CellRecord, WhenTheStateFolderIsThatOfAnotherCell_ThenBothFilesAreNamed) {
  const support::TemporaryFolder folder;
  for (const char* name : {"here", "there"}) {
    std::filesystem::create_directories(folder.path() / name / "state");
    std::ofstream(folder.path() / name / "cell.toml") << "";
  }
  config::CellConfig config;
  config.file = folder.path() / "here/cell.toml";
  config.state_dir = folder.path() / "here/state";
  CellRecord record;
  record.cell = "line";
  record.config = (folder.path() / "there/cell.toml").string();
  const auto checked = check_same_cell(record, config);
  ASSERT_FALSE(checked);
  const result::Diagnostic& told = checked.error().front();
  EXPECT_EQ(told.code, "M0023");
  EXPECT_NE(told.message.find(record.config), std::string::npos);
  EXPECT_EQ(told.where.file, config.file.string());
  EXPECT_NE(told.hint.find("state_dir"), std::string::npos);
}

TEST(CellRecord, WhenTheFileIsReachedAnotherWayOrWasMoved_ThenItIsTheSameCell) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "here/state");
  std::filesystem::create_directories(folder.path() / "elsewhere");
  std::ofstream(folder.path() / "here/cell.toml") << "";
  std::filesystem::create_directory_symlink(folder.path() / "here", folder.path() / "link");
  config::CellConfig config;
  config.file = folder.path() / "link/../link/cell.toml";
  config.state_dir = folder.path() / "link/state";
  CellRecord record;
  record.config = (folder.path() / "here/cell.toml").string();
  EXPECT_TRUE(check_same_cell(record, config));
  record.config = (folder.path() / "before/cell.toml").string();
  EXPECT_TRUE(check_same_cell(record, config)) << "the folder was called so";
  config.state_dir = folder.path() / "elsewhere";
  EXPECT_FALSE(check_same_cell(record, config)) << "a state folder that others may have";
}

}  // namespace
}  // namespace stepwright::processes
