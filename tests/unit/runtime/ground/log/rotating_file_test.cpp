#include "runtime/ground/log/rotating_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace stepwright::log {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(RotatingFile, WhenItIsFull_ThenOlderOnesAreKeptAndTheOldestGoes) {
  const support::TemporaryFolder folder;
  const auto file = folder / "cell.log";
  auto log = RotatingFile::open(file, {.max_bytes = 11, .keep = 2});
  ASSERT_TRUE(log);
  for (const char* line :
       {"one..\n", "two\n", "three\n", "four\n", "a line that is longer than all of it\n", "six\n"})
    EXPECT_EQ((*log)->append(line), 0);
  EXPECT_EQ(content(file), "six\n");
  EXPECT_EQ(content(folder / "cell.log.1"), "a line that is longer than all of it\n");
  EXPECT_EQ(content(folder / "cell.log.2"), "three\nfour\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "cell.log.3"));
}

TEST(RotatingFile, WhenNoneIsKeptOrThereIsNoLimit_ThenThatHolds) {
  const support::TemporaryFolder folder;
  auto none = RotatingFile::open(folder / "none", {.max_bytes = 4, .keep = 0});
  EXPECT_EQ((*none)->append("one\n"), 0);
  EXPECT_EQ((*none)->append("two\n"), 0);
  EXPECT_EQ(content(folder / "none"), "two\n");
  auto any = RotatingFile::open(folder / "any", {.max_bytes = 0});
  for (int i = 0; i < 100; ++i) EXPECT_EQ((*any)->append("0123456789\n"), 0);
  EXPECT_EQ(std::filesystem::file_size(folder / "any"), 1'100u);
  EXPECT_FALSE(std::filesystem::exists(folder / "any.1"));
}

// As logrotate does, or a person.
TEST(RotatingFile, WhenSomebodyMovesItAway_ThenTheNextLineIsInANewOne) {
  const support::TemporaryFolder folder;
  auto log = RotatingFile::open(folder / "cell.log", {});
  EXPECT_EQ((*log)->append("one\n"), 0);
  std::filesystem::rename(folder / "cell.log", folder / "moved");
  EXPECT_EQ((*log)->append("two\n"), 0);
  EXPECT_EQ(content(folder / "moved"), "one\n");
  EXPECT_EQ(content(folder / "cell.log"), "two\n");
}

TEST(RotatingFile, WhenItCannotBeOpenedOrWritten_ThenTheReasonIsTold) {
  const auto refused = RotatingFile::open("/nonexistent/cell.log", {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), ENOENT);
  auto full = RotatingFile::open("/dev/full", {.max_bytes = 1});
  ASSERT_TRUE(full);
  EXPECT_EQ((*full)->append("one\n"), ENOSPC);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full")) << "it is renamed";
}

// Each process rotates when it finds the file full; every line is in one of the files, once and whole.
TEST(RotatingFile, WhenSeveralProcessesWrite_ThenNoLineIsLostOrTorn) {
  constexpr int kProcesses = 4;
  constexpr int kLines = 500;
  const support::TemporaryFolder folder;
  const auto file = folder / "cell.log";
  std::vector<pid_t> children;
  for (int process = 0; process < kProcesses; ++process) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      auto log = RotatingFile::open(file, {.max_bytes = 2'000, .keep = 200});
      int failed = log ? 0 : 1;
      for (int i = 0; log && i < kLines; ++i)
        failed += (*log)->append("process " + std::to_string(process) + " line " + std::to_string(i) + "\n");
      _exit(failed == 0 ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  std::map<std::string, int> lines;
  int files = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder.path())) {
    ++files;
    std::ifstream in(each.path());
    for (std::string line; std::getline(in, line);) ++lines[line];
  }
  EXPECT_GT(files, 10);
  EXPECT_EQ(lines.size(), static_cast<std::size_t>(kProcesses * kLines));
  for (const auto& [line, count] : lines) EXPECT_EQ(count, 1) << line;
}

}  // namespace
}  // namespace stepwright::log
