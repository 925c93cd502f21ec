#include "runtime/ground/log/logger.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

namespace stepwright::log {
namespace {

class LoggerTest : public testing::Test {
 protected:
  LoggerTest() : folder_(testing::TempDir() + "logger." + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
    config_.file = folder_ / "cell.log";
    config_.format = LogFormat::Json;
  }
  ~LoggerTest() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<Logger> open() {
    auto log = Logger::open("runtime", config_);
    EXPECT_TRUE(log) << (log ? "" : result::to_string(log.error()));
    return std::move(*log);
  }
  static std::vector<nlohmann::json> lines(const std::filesystem::path& file) {
    std::vector<nlohmann::json> found;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) found.push_back(nlohmann::json::parse(line));
    return found;
  }

  std::filesystem::path folder_;
  LogConfig config_;
};

TEST_F(LoggerTest, WhenMessagesAreWritten_ThenEachIsOneObjectOnALine) {
  open()->info("listens", "it listens", {{"socket", "/s"}});
  const auto found = lines(config_.file);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].at("kind"), "listens");
  EXPECT_EQ(found[0].at("socket"), "/s");
}

TEST_F(LoggerTest, WhenTheLevelIsHigher_ThenLowerMessagesAreLeftOut) {
  config_.level = LogLevel::Warning;
  const auto log = open();
  log->debug("a", "no");
  log->info("b", "no");
  log->warning("c", "yes");
  log->error("d", "yes");
  EXPECT_EQ(lines(config_.file).size(), 2u);
}

TEST_F(LoggerTest, WhenOneKindFloods_ThenItIsLimitedAndTheRestIsCounted) {
  config_.limit_per_s = 5;
  {
    const auto log = open();
    for (int i = 0; i < 1'000; ++i) log->error("trap", "again");
    log->info("stopped", "another kind");
  }
  // A second may have ended in between on a busy machine: then there are more lines, but none is lost count
  // of.
  std::uint64_t traps = 0;
  std::uint64_t suppressed = 0;
  bool other = false;
  for (const auto& line : lines(config_.file)) {
    traps += line.at("kind") == "trap" ? 1 : 0;
    if (line.at("kind") == "suppressed") {
      EXPECT_EQ(line.at("of"), "trap");
      suppressed += line.at("count").get<std::uint64_t>();
    }
    other = other || line.at("kind") == "stopped";
  }
  EXPECT_EQ(traps + suppressed, 1'000u);
  EXPECT_LT(traps, 100u);
  EXPECT_TRUE(other);
}

TEST_F(LoggerTest, WhenItIsOpenedAgain_ThenTheNextLineGoesToTheNewFile) {
  const auto log = open();
  log->info("one", "first");
  std::filesystem::rename(config_.file, folder_ / "old.log");
  ASSERT_TRUE(log->reopen(config_));
  log->info("two", "second");
  EXPECT_EQ(lines(folder_ / "old.log").size(), 1u);
  EXPECT_EQ(lines(config_.file).size(), 1u);
}

TEST_F(LoggerTest, WhenTheFileCannotBeOpened_ThenTheErrorNamesItsPlaceAndTheOldOneStays) {
  const auto log = open();
  LogConfig wrong = config_;
  wrong.file = "/proc/no/such.log";
  wrong.where = {"cell.toml", 7, 8};
  const auto refused = log->reopen(wrong);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "C0463");
  EXPECT_EQ(refused.error()[0].where.line, 7u);
  log->info("one", "still here");
  EXPECT_EQ(lines(config_.file).size(), 1u);
}

TEST_F(LoggerTest, WhenSeveralThreadsWrite_ThenNoLineIsTorn) {
  config_.limit_per_s = 10'000;
  const auto log = open();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&log] {
      for (int i = 0; i < 200; ++i) log->info("burst", std::string(300, 'x'), {{"i", i}});
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(lines(config_.file).size(), 800u);
}

TEST_F(LoggerTest, WhenTheDiskIsFull_ThenLoggingGoesOnWithoutHarm) {
  config_.file = "/dev/full";
  const auto log = open();
  for (int i = 0; i < 20; ++i) log->info("one", "nowhere to go");
  config_.file = folder_ / "cell.log";
  ASSERT_TRUE(log->reopen(config_));
  log->info("two", "room again");
  EXPECT_FALSE(lines(config_.file).empty());
}

// Somebody else's link would have this user write where that one may not.
TEST_F(LoggerTest, WhenTheFileIsALink_ThenItIsFollowedOnlyWhereNotEverybodyMayPutOne) {
  std::filesystem::create_symlink(folder_ / "elsewhere.log", config_.file);
  open()->info("one", "followed");
  EXPECT_EQ(lines(folder_ / "elsewhere.log").size(), 1u);
  std::filesystem::permissions(folder_, std::filesystem::perms::all | std::filesystem::perms::sticky_bit);
  const auto refused = Logger::open("runtime", config_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].code, "C0463");
  std::filesystem::remove(config_.file);
  open()->info("two", "a file of its own");
  EXPECT_EQ(lines(config_.file).size(), 1u);
  EXPECT_EQ(lines(folder_ / "elsewhere.log").size(), 1u);
}

}  // namespace
}  // namespace stepwright::log
