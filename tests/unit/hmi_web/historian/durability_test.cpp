#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "hmi_web/historian/historian.h"
#include "hmi_web/storage/database.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/hmi_web/historian/brute_force.h"

namespace stepwright::historian {
namespace {

constexpr Window kAlways = {std::numeric_limits<std::int64_t>::min(),
                            std::numeric_limits<std::int64_t>::max()};
constexpr SuppressionSettings kAll = {SuppressionKind::None};
constexpr std::int32_t kApplication = 0x53574849;

Sample numbered(std::int64_t i) {
  return {i * 1000, static_cast<double>(i % 977)};
}

std::vector<Sample> stored(Historian& historian, const char* tag) {
  return historian.range(historian.find(tag).value(), kAlways, 10'000'000).value().samples;
}

storage::Database raw(const std::filesystem::path& file) {
  storage::DatabaseOptions options;
  options.application = kApplication;
  return storage::Database::open(file, options).value();
}

void overwrite(const std::filesystem::path& file, std::int64_t at, std::size_t count) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(at);
  stream << std::string(count, '\x5A');
}

// Writes, tells through the pipe how much is flushed, and goes on until it is killed.
[[noreturn]] void write_until_killed(const std::filesystem::path& file, int pipe) {
  auto historian = Historian::open(file, {.commit_period = std::chrono::milliseconds(1)}).value();
  const TagId tag = *historian->tag("level", kAll);
  for (std::int64_t i = 0;; ++i) {
    historian->append(tag, numbered(i));
    if (i % 700 != 0) continue;
    if (!historian->flush()) _exit(1);
    const std::int64_t flushed = i + 1;
    if (::write(pipe, &flushed, sizeof flushed) != sizeof flushed) _exit(1);
  }
}

TEST(Durability, WhenTheProcessIsKilled_ThenOnlyTheTailThatWasNotWrittenIsLost) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove(file);
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(file, pipe[1]);
    ::close(pipe[1]);
    std::int64_t flushed = 0;
    for (int i = 0; i < 3 + 4 * round; ++i)
      ASSERT_EQ(::read(pipe[0], &flushed, sizeof flushed), static_cast<ssize_t>(sizeof flushed));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(pipe[0], &flushed, sizeof flushed) > 0) {
    }
    ::close(pipe[0]);
    auto historian = Historian::open(file).value();
    const auto samples = stored(*historian, "level");
    ASSERT_GE(samples.size(), static_cast<std::size_t>(flushed));
    for (std::size_t i = 0; i < samples.size(); ++i)
      ASSERT_EQ(samples[i], numbered(static_cast<std::int64_t>(i)));
    EXPECT_TRUE(historian->status().problems.empty());
    historian.reset();
    EXPECT_TRUE(raw(file).check().has_value());
  }
}

TEST(Durability, WhenABlockIsDamaged_ThenItIsToldAndTheOthersAreRead) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  std::vector<Sample> samples;
  for (std::int64_t i = 0; i < 5000; ++i) samples.push_back(numbered(i));
  {
    auto historian = Historian::open(file).value();
    const TagId tag = *historian->tag("level", kAll);
    for (const Sample& sample : samples) historian->append(tag, sample);
  }
  ASSERT_TRUE(
      raw(file).execute("UPDATE block SET data = zeroblob(100) WHERE id = 3;"
                        "UPDATE node SET data = x'00' WHERE block = 5"));
  auto historian = Historian::open(file).value();
  const TagId tag = historian->find("level").value();
  const auto range = historian->range(tag, kAlways);
  ASSERT_TRUE(range.has_value());
  ASSERT_EQ(range->damage.size(), 1u);
  EXPECT_EQ(range->damage[0].samples, 512u);
  EXPECT_EQ(range->damage[0].first_ns, samples[1024].time_ns);
  EXPECT_EQ(range->damage[0].last_ns, samples[1535].time_ns);
  auto expected = samples;
  expected.erase(expected.begin() + 1024, expected.begin() + 1536);
  EXPECT_EQ(range->samples, expected);
  EXPECT_EQ(historian->trend(tag, {0, samples.back().time_ns}, 100)->damage.size(), 1u);
  EXPECT_TRUE(historian->range(tag, {0, samples[1000].time_ns})->damage.empty());
}

// A summary that cannot be read must not make the ones above it tell less than there is.
TEST(Durability, WhenASummaryIsDamaged_ThenNoneAboveItIsWrittenFromTheRest) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  std::vector<Sample> samples;
  for (std::int64_t i = 0; i < 512 * 20; ++i) samples.push_back(numbered(i));
  samples[512 * 4 + 5].value = 1e6;  // the greatest of all, in the block whose summary goes
  const auto write = [&](std::size_t begin, std::size_t end) {
    auto historian = Historian::open(file).value();
    const TagId tag = *historian->tag("level", kAll);
    for (std::size_t i = begin; i < end; ++i) historian->append(tag, samples[i]);
  };
  write(0, 512 * 10);
  ASSERT_TRUE(
      raw(file).execute("UPDATE node SET data = x'00' WHERE block = 5;"
                        "INSERT INTO node(key, last_ns, data) VALUES((1 << 32), 0, x'00')"));
  write(512 * 10, samples.size());
  auto historian = Historian::open(file).value();
  const TagId tag = historian->find("level").value();
  EXPECT_FALSE(historian->status().failing);
  const Window window = {0, samples.back().time_ns};
  EXPECT_EQ(historian->range(tag, window, samples.size())->samples, samples);
  EXPECT_EQ(historian->trend(tag, window, 1)->buckets[0].greatest.value, 1e6);
}

TEST(Durability, WhenTheTailIsDamaged_ThenItIsToldAndTheRestIsKept) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  {
    auto historian = Historian::open(file).value();
    const TagId tag = *historian->tag("level", kAll);
    for (std::int64_t i = 0; i < 600; ++i) historian->append(tag, numbered(i));
  }
  ASSERT_TRUE(
      raw(file).execute("UPDATE open SET data = zeroblob(50); INSERT INTO tail(data) VALUES(zeroblob(9));"
                        "INSERT INTO tag(id, name) VALUES(-4, 'impossible'), (100000000, 'far away')"));
  auto historian = Historian::open(file).value();
  EXPECT_EQ(stored(*historian, "level").size(), 512u);
  const auto status = historian->status();
  EXPECT_EQ(status.problems.size(), 4u);
  for (const auto& problem : status.problems) EXPECT_EQ(problem.code, "S0011");
  EXPECT_FALSE(status.failing);
}

TEST(Durability, WhenTheFileIsDamaged_ThenItIsPutAsideAndANewOneBegun) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  for (int round = 1; round <= 2; ++round) {
    std::ofstream(file) << std::string(20'000, 'x');
    auto historian = Historian::open(file).value();
    const TagId tag = *historian->tag("level", kAll);
    historian->append(tag, numbered(1));
    EXPECT_TRUE(historian->flush().has_value());
    ASSERT_EQ(historian->status().problems.size(), 1u);
    const auto problem = historian->status().problems[0];
    EXPECT_EQ(problem.code, "S0002");
    const std::string aside = file.string() + ".damaged-" + std::to_string(round);
    EXPECT_NE(problem.hint.find(aside), std::string::npos) << problem.hint;
    EXPECT_EQ(std::filesystem::file_size(aside), 20'000u);
  }
  std::ofstream(file) << std::string(20'000, 'x');
  const auto refused = Historian::open(file, {.replace_damaged = false});
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error()[0].code, "S0002");
}

TEST(Durability, WhenThePagesOfTheFileAreDamagedWhileItRuns_ThenItGoesOnInANewOne) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  {
    auto historian = Historian::open(file).value();
    const TagId tag = *historian->tag("level", kAll);
    for (std::int64_t i = 0; i < 600; ++i) historian->append(tag, numbered(i));
  }
  std::int64_t page = 0;
  {
    auto database = raw(file);
    auto root = database.prepare("SELECT rootpage FROM sqlite_schema WHERE name = 'block'").value();
    ASSERT_TRUE(root.step().value());
    page = root.integer(0);
    root.reset();
    ASSERT_TRUE(database.execute("PRAGMA wal_checkpoint(TRUNCATE)").has_value());
  }
  overwrite(file, (page - 1) * 8192, 8192);

  auto historian = Historian::open(file).value();
  const TagId tag = historian->find("level").value();
  ASSERT_EQ(*historian->tag("level", kAll), tag);
  for (std::int64_t i = 600; i < 2000; ++i) historian->append(tag, numbered(i));
  (void)historian->flush();  // fails, or not if the new file is there already
  historian->append(tag, numbered(2000));
  ASSERT_TRUE(historian->flush().has_value());
  EXPECT_TRUE(std::filesystem::exists(file.string() + ".damaged-1"));
  const auto samples = stored(*historian, "level");
  ASSERT_EQ(samples.size(), 2001u - 512u) << "what was in memory is in the new file";
  EXPECT_EQ(samples.front(), numbered(512));
  historian.reset();
  historian = Historian::open(file).value();
  EXPECT_EQ(stored(*historian, "level"), samples);
}

TEST(Durability, WhenTheDiskIsFull_ThenTheCallerGoesOnAndIsToldAndItEndsWithTheFullness) {
  const support::TemporaryFolder folder;
  const auto file = folder / "history.db";
  HistorianOptions options;
  options.largest_file_bytes = 20 * 8192;
  options.most_waiting_bytes = 100'000;
  std::mt19937_64 random(1);
  {
    auto historian = Historian::open(file, options).value();
    const TagId tag = *historian->tag("noise", kAll);
    for (int part = 0; part < 20; ++part) {
      for (int i = 0; i < 10'000; ++i)
        historian->append(tag, {part * 10'000 + i, static_cast<double>(random()) * 1e-3});
      (void)historian->flush();
    }
    const auto failed = historian->flush();
    ASSERT_FALSE(failed.has_value());
    EXPECT_EQ(failed.error()[0].code, "S0003");
    const auto status = historian->status();
    EXPECT_TRUE(status.failing);
    EXPECT_GT(status.lost, 0u);
    EXPECT_EQ(status.kept, 200'000u);
    const auto samples = stored(*historian, "noise");
    EXPECT_EQ(samples.size() + status.lost, 200'000u) << "what is not counted as lost is read";
    EXPECT_EQ(samples.back().time_ns, 199'999);
  }
  options.largest_file_bytes = 0;
  auto historian = Historian::open(file, options).value();
  historian->append(historian->find("noise").value(), {300'000, 1.0});
  EXPECT_TRUE(historian->flush().has_value());
  EXPECT_GT(stored(*historian, "noise").size(), 1000u);
}

}  // namespace
}  // namespace stepwright::historian
