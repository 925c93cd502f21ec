#include "hmi_web/access/audit_log.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_files.h"
#include "hmi_web/access/audit_text.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::access {
namespace {

using nlohmann::json;

class AuditLogTest : public testing::Test {
 protected:
  std::unique_ptr<AuditLog> open() {
    auto log = AuditLog::open(file_, [] {
      return std::chrono::system_clock::time_point(std::chrono::milliseconds(1'700'000'000'123));
    });
    EXPECT_TRUE(log) << result::to_string(log.error());
    return log ? std::move(*log) : nullptr;
  }
  std::string text() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  void append_three() {
    const auto log = open();
    ASSERT_TRUE(log->append(
        {.user = "ada", .role = "operator", .action = "plan.abort", .reason = "smoke", .result = "done"}));
    ASSERT_TRUE(log->append({.user = "bob",
                             .action = "tag.force",
                             .target = "P.X",
                             .before = "0",
                             .after = "1",
                             .result = "done"}));
    ASSERT_TRUE(log->append({.action = "session.login", .result = "refused: H0026"}));
  }

  support::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "access" / "audit.jsonl";
};

TEST_F(AuditLogTest, WhenEntriesAreAppended_ThenEachHasWhoWhenWhatAndTheChainHolds) {
  append_three();
  const json first = json::parse(text().substr(0, text().find('\n')));
  EXPECT_EQ(first["seq"], 1);
  EXPECT_EQ(first["time"], "2023-11-14T22:13:20.123Z");
  EXPECT_EQ(first["user"], "ada");
  EXPECT_EQ(first["role"], "operator");
  EXPECT_EQ(first["action"], "plan.abort");
  EXPECT_EQ(first["reason"], "smoke");
  EXPECT_EQ(first["prev"], first_hash());
  const ChainCheck check = check_chain(text());
  EXPECT_EQ(check.entries, 3u);
  EXPECT_EQ(check.broken_line, 0u);
  EXPECT_EQ(check.head, json::parse(text().substr(text().rfind('\n', text().size() - 2) + 1))["hash"]);
}

TEST_F(AuditLogTest, WhenAnyByteIsChanged_ThenItsLineIsFound) {
  append_three();
  const std::string right = text();
  std::uint64_t line = 1;
  for (std::size_t i = 0; i < right.size(); ++i) {
    std::string wrong = right;
    wrong[i] = static_cast<char>(wrong[i] ^ 1);
    const ChainCheck check = check_chain(wrong);
    EXPECT_EQ(check.broken_line, line) << "byte " << i;
    if (right[i] == '\n') ++line;
  }
}

TEST_F(AuditLogTest, WhenALineIsLeftOutOrMovedOrPutIn_ThenTheFirstWrongLineIsFound) {
  append_three();
  const std::string all = text();
  const std::size_t one = all.find('\n') + 1;
  const std::size_t two = all.find('\n', one) + 1;
  const std::string a = all.substr(0, one);
  const std::string b = all.substr(one, two - one);
  const std::string c = all.substr(two);
  EXPECT_EQ(check_chain(a + c).broken_line, 2u);
  EXPECT_EQ(check_chain(b + c).broken_line, 1u);
  EXPECT_EQ(check_chain(a + c + b).broken_line, 2u);
  EXPECT_EQ(check_chain(a + a + b + c).broken_line, 2u);
  EXPECT_EQ(check_chain(a + b).broken_line, 0u) << "what is cut off at the end shows in the head only";
  EXPECT_NE(check_chain(a + b).head, check_chain(all).head);
  EXPECT_EQ(check_chain(a + "\n" + b).broken_line, 2u);
  EXPECT_EQ(check_chain("").entries, 0u);
}

TEST_F(AuditLogTest, WhenItIsOpenedAgain_ThenTheChainGoesOn) {
  append_three();
  append_three();
  EXPECT_EQ(check_chain(text()).entries, 6u);
  EXPECT_EQ(check_chain(text()).broken_line, 0u);
}

TEST_F(AuditLogTest, WhenACrashLeftHalfALine_ThenItIsCutOffAndTold) {
  append_three();
  const std::string right = text();
  for (const std::size_t cut :
       {right.size() - 1, right.size() - 40, right.rfind('\n', right.size() - 2) + 2}) {
    write(right.substr(0, cut));
    EXPECT_TRUE(check_chain(text()).torn);
    const auto log = open();
    EXPECT_NE(log->found_at_start(), "");
    const ChainCheck check = check_chain(text());
    EXPECT_EQ(check.broken_line, 0u) << check.why;
    EXPECT_EQ(check.entries, 3u) << "two whole ones, and the one that tells of it";
  }
}

TEST_F(AuditLogTest, WhenTheChainIsBroken_ThenTheFileIsKeptAsideAndANewOneTellsOfIt) {
  append_three();
  std::string wrong = text();
  wrong[wrong.find("smoke")] = 'S';
  write(wrong);
  ASSERT_TRUE(open()->append({.action = "plan.abort", .result = "done"}));
  EXPECT_EQ(check_chain(text()).entries, 2u);
  EXPECT_NE(text().find("line 1 was wrong"), std::string::npos);
  std::ifstream aside(file_.string() + ".broken-1", std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(aside), {}), wrong);
}

// A child appends and says so, and is killed in the middle of it: what it has confirmed is in the file.
TEST_F(AuditLogTest, WhenTheProcessIsKilled_ThenEveryConfirmedEntryIsThere) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto log = open();
    for (std::uint32_t count = 1; log && log->append({.action = "x", .target = std::string(300, 'y')});
         ++count) {
      if (::write(ends[1], &count, sizeof count) != sizeof count) break;
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  std::uint32_t confirmed = 0;
  while (confirmed < 40 && ::read(ends[0], &confirmed, sizeof confirmed) == sizeof confirmed) {
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  for (std::uint32_t more = 0; ::read(ends[0], &more, sizeof more) == sizeof more;) confirmed = more;
  ::close(ends[0]);
  EXPECT_GE(confirmed, 40u);
  const ChainCheck check = check_chain(text());
  EXPECT_GE(check.entries, confirmed);
  EXPECT_TRUE(check.broken_line == 0 || check.torn) << check.why;
}

TEST_F(AuditLogTest, WhenItCannotBeWritten_ThenTheEntryFails) {
  auto log = AuditLog::open("/dev/full/audit.jsonl");
  EXPECT_FALSE(log);
}

// Entries of some 550 bytes in files of 2 kB, of which 8 kB are kept.
constexpr AuditLimits kSmall{2'000, 8'000};

class AuditSegments : public AuditLogTest {
 protected:
  std::unique_ptr<AuditLog> open_small() {
    auto log = AuditLog::open(file_, std::chrono::system_clock::now, kSmall);
    EXPECT_TRUE(log) << result::to_string(log.error());
    return log ? std::move(*log) : nullptr;
  }
  void append(AuditLog& log, int count) {
    for (int i = 0; i < count; ++i) {
      ASSERT_TRUE(log.append({.user = "ada",
                              .action = "plan.goal",
                              .target = std::to_string(log.entries() + 1),
                              .reason = std::string(200, 'x'),
                              .result = "done"}));
    }
  }
  TrailCheck check() const { return *check_trail(file_); }
};

TEST_F(AuditSegments, WhenTheFileHasGrown_ThenTheChainGoesOnInTheNextAndAfterARestart) {
  for (int run = 0; run < 4; ++run) append(*open_small(), 3);
  EXPECT_GT(segments_of(file_).size(), 2u);
  for (const Segment& each : segments_of(file_)) EXPECT_LE(each.bytes, kSmall.segment_bytes);
  EXPECT_EQ(check().first, 1u);
  EXPECT_EQ(check().chain.entries, 12u);
  EXPECT_EQ(check().chain.broken_line, 0u);
  EXPECT_EQ(check().chain.head, open_small()->head());
}

TEST_F(AuditSegments, WhenAllIsTooMuch_ThenTheOldestGoAndTheTrailSaysSo) {
  const auto log = open_small();
  append(*log, 100);
  std::uint64_t bytes = 0;
  for (const Segment& each : segments_of(file_)) bytes += each.bytes;
  EXPECT_LE(bytes, kSmall.most_bytes + kSmall.segment_bytes);
  const TrailCheck all = check();
  EXPECT_GT(all.first, 1u);
  EXPECT_EQ(all.chain.entries, log->entries());
  EXPECT_EQ(all.chain.broken_line, 0u) << all.chain.why;
  const std::string lines = *lines_before(file_, 0, {1'000, 1 << 20});
  EXPECT_NE(lines.find("audit.trimmed"), std::string::npos);
  EXPECT_NE(lines.find("to " + std::to_string(all.first - 1) + "\""), std::string::npos) << lines;
  append(*open_small(), 1);
  EXPECT_EQ(check().chain.broken_line, 0u) << "a trail that begins later goes on, too";
}

TEST_F(AuditSegments, WhenItIsReadByPages_ThenEveryEntryIsThereOnce) {
  const auto log = open_small();
  append(*log, 17);
  for (const std::size_t most : {1u, 2u, 5u, 100u}) {
    std::uint64_t before = 0, expected = log->entries();
    while (true) {
      const std::string lines = *lines_before(file_, before, {most, 1 << 20});
      if (lines.empty()) break;
      const auto start = start_of(lines);
      ASSERT_TRUE(start);
      EXPECT_EQ(check_chain(lines, *start).entries, expected);
      EXPECT_LE(std::count(lines.begin(), lines.end(), '\n'), static_cast<std::ptrdiff_t>(most));
      before = start->sequence + 1;
      expected = start->sequence;
    }
    EXPECT_EQ(expected, check().first - 1);
  }
  EXPECT_EQ(*lines_before(file_, 1, {10, 1 << 20}), "");
  EXPECT_EQ(start_of(*lines_before(file_, 9'999, {1, 1 << 20}))->sequence + 1, log->entries());
}

TEST_F(AuditSegments, WhenAnEntryOfAClosedSegmentIsChanged_ThenTheCheckNamesFileAndEntry) {
  append(*open_small(), 12);
  ASSERT_GT(segments_of(file_).size(), 3u);
  const Segment second = segments_of(file_)[1];
  std::ifstream in(second.file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  text[text.find("ada")] = 'b';
  std::ofstream(second.file, std::ios::binary) << text;
  EXPECT_EQ(check().chain.broken_line, second.first);
  EXPECT_EQ(check().file, second.file);
  std::filesystem::remove(second.file);
  EXPECT_EQ(check().file, segments_of(file_)[1].file) << "a segment that is missing in the middle shows";
}

TEST_F(AuditSegments, WhenTheProcessEndedBetweenTwoFiles_ThenTheChainGoesOn) {
  append(*open_small(), 4);
  std::filesystem::rename(file_, segment_name(file_, segments_of(file_).back().first));
  append(*open_small(), 1);
  EXPECT_EQ(check().chain.entries, 5u);
  EXPECT_EQ(check().chain.broken_line, 0u) << check().chain.why;
}

TEST_F(AuditSegments, WhenAnEarlierVersionLeftALargeFile_ThenItsEndIsReadAndItBecomesASegment) {
  { append(*open(), 40); }
  append(*open_small(), 2);
  EXPECT_EQ(segments_of(file_).size(), 2u);
  EXPECT_EQ(check().chain.entries, 42u);
  EXPECT_EQ(check().chain.broken_line, 0u);
}

TEST_F(AuditLogTest, WhenEntriesMayNotWait_ThenTheyAreWrittenBehind) {
  const auto log = open();
  for (int i = 0; i < 20; ++i)
    log->append_later({.action = "plan.abort", .target = std::to_string(i), .result = "begun"});
  for (int i = 0; i < 100 && check_chain(text()).entries < 20; ++i) log->settle();
  EXPECT_EQ(check_chain(text()).entries, 20u);
  EXPECT_NE(text().find("\"target\":\"19\""), std::string::npos);
}

TEST_F(AuditLogTest, WhenTextsAreNoUtf8_ThenTheyAreRepaired) {
  ASSERT_TRUE(open()->append({.user = "\xff\xfe\n\"", .action = "x"}));
  EXPECT_EQ(check_chain(text()).broken_line, 0u);
  EXPECT_TRUE(json::accept(text()));
}

TEST_F(AuditLogTest, WhenThePageAsks_ThenTheNewestComeFirst) {
  append_three();
  const json list = json::parse(newest_entries(text(), 2));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["seq"], 3);
  EXPECT_EQ(list[1]["seq"], 2);
  const json older = json::parse(newest_entries(text(), 10, 2));
  ASSERT_EQ(older.size(), 1u);
  EXPECT_EQ(older[0]["seq"], 1);
  EXPECT_EQ(newest_entries("", 5), "[]");
}

TEST_F(AuditLogTest, WhenItIsATable_ThenCellsAreQuotedAndNoneIsAFormula) {
  ASSERT_TRUE(open()->append({.user = "=1+1", .action = "a,b", .reason = "say \"so\"\nplease"}));
  const std::string table = entries_csv(text());
  EXPECT_TRUE(
      table.starts_with("seq,time,user,role,address,action,target,before,after,reason,result,hash\r\n1,"));
  EXPECT_NE(table.find(",'=1+1,"), std::string::npos) << table;
  EXPECT_NE(table.find(",\"a,b\","), std::string::npos);
  EXPECT_NE(table.find(",\"say \"\"so\"\"\nplease\","), std::string::npos);
}

}  // namespace
}  // namespace stepwright::access
