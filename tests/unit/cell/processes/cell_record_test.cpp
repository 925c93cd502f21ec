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

}  // namespace
}  // namespace stepwright::processes
