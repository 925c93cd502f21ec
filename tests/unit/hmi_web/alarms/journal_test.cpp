#include "hmi_web/alarms/journal.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::alarms {
namespace {

class AlarmJournalTest : public testing::Test {
 protected:
  AlarmJournalTest() {
    for (const char* name : {"a", "b", "c"}) {
      AlarmDefinition& one = definitions_.emplace_back();
      one.name = name;
      one.source = std::string("main.") + name;
      one.priority = *name == 'a' ? Priority::Critical : Priority::Low;
      one.group = "g";
    }
    engine_.emplace(AlarmEngine::create(definitions_).value());
  }
  void open(JournalOptions options = {}) {
    auto opened = AlarmJournal::open(file(), definitions_, options);
    ASSERT_TRUE(opened.has_value()) << result::to_string(opened.error());
    journal_ = std::move(*opened);
  }
  std::filesystem::path file() const { return folder_ / "alarms.db"; }
  void set(std::uint32_t alarm, std::int64_t time, double value) {
    engine_->offer(SourceId(alarm), time, value, true);
  }
  void keep() {
    journal_->append(engine_->take());
    ASSERT_TRUE(journal_->flush().has_value());
  }
  // Times of the entries, the newest first.
  std::vector<std::int64_t> times(const JournalQuery& query, std::size_t most = 100) {
    std::vector<std::int64_t> found;
    for (const JournalEntry& entry : journal_->find(query, most).value())
      found.push_back(entry.transition.time_ns);
    return found;
  }
  using Times = std::vector<std::int64_t>;

  support::TemporaryFolder folder_;
  std::vector<AlarmDefinition> definitions_;
  std::optional<AlarmEngine> engine_;
  std::unique_ptr<AlarmJournal> journal_;
};

TEST_F(AlarmJournalTest, WhenTransitionsAreAppended_ThenTheyAreFoundByWhatTheyAre) {
  open();
  set(0, 10, 1.5);
  set(1, 20, 1);
  set(0, 30, 0);
  ASSERT_TRUE(
      engine_->command({AlarmId(1), AlarmEvent::Acknowledge, 40, "anna", "it's 'seen'; --"}).has_value());
  keep();
  EXPECT_EQ(times({}), (Times{40, 30, 20, 10}));
  EXPECT_EQ(times({.from_ns = 20, .to_ns = 30}), (Times{30, 20}));
  EXPECT_EQ(times({.alarm = "a"}), (Times{30, 10}));
  EXPECT_EQ(times({.source = "main.b"}), (Times{40, 20}));
  EXPECT_EQ(times({.state = AlarmState::Unacknowledged}), (Times{20, 10}));
  EXPECT_EQ(times({.event = AlarmEvent::Acknowledge}), (Times{40}));
  EXPECT_EQ(times({.at_least = Priority::High}), (Times{30, 10}));
  EXPECT_EQ(times({.alarm = "a' OR 1=1 --"}), (Times{}));
  EXPECT_EQ(times({.from_ns = 5, .alarm = "a", .state = AlarmState::Unacknowledged}), (Times{10}));

  const auto entries = journal_->find({}, 100).value();
  EXPECT_EQ(entries[0].transition.user, "anna");
  EXPECT_EQ(entries[0].transition.comment, "it's 'seen'; --");
  EXPECT_EQ(entries[3].alarm, "a");
  EXPECT_EQ(entries[3].source, "main.a");
  EXPECT_EQ(entries[3].priority, Priority::Critical);
  EXPECT_EQ(entries[3].transition.value, 1.5);
  EXPECT_TRUE(entries[3].transition.first_out);
  EXPECT_FALSE(entries[2].transition.first_out);
  EXPECT_EQ(entries[3].transition.from, AlarmState::Normal);
}

TEST_F(AlarmJournalTest, WhenThereAreManyEntries_ThenTheyAreReadPageByPageInOrderWithoutGaps) {
  open();
  for (std::int64_t i = 0; i < 100; ++i)
    set(static_cast<std::uint32_t>(i % 3), i / 5, i / 3 % 2 == 0 ? 1 : 0);
  keep();
  JournalQuery query;
  std::vector<std::int64_t> numbers;
  while (true) {
    const auto page = journal_->find(query, 7).value();
    if (page.empty()) break;
    for (const JournalEntry& entry : page) numbers.push_back(entry.number);
    query.before = page.back().number;
  }
  ASSERT_EQ(numbers.size(), 100u);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], static_cast<std::int64_t>(100 - i));
}

TEST_F(AlarmJournalTest, WhenTheProcessStartsAgain_ThenTheEngineGoesOnWhereItEnded) {
  open();
  set(0, 10, 3.5);
  set(1, 20, 1);
  set(1, 25, 0);
  ASSERT_TRUE(engine_->command({AlarmId(0), AlarmEvent::Acknowledge, 30, "anna"}).has_value());
  ASSERT_TRUE(engine_->command({AlarmId(2), AlarmEvent::Shelve, 40, "anna", "", std::chrono::nanoseconds(60)})
                  .has_value());
  keep();
  journal_.reset();
  open();
  auto after = AlarmEngine::create(definitions_).value();
  ASSERT_TRUE(restore(after, *journal_).has_value());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const AlarmView &old = engine_->view(AlarmId(i)), &now = after.view(AlarmId(i));
    EXPECT_EQ(now.status, old.status) << i;
    EXPECT_EQ(now.since_ns, old.since_ns) << i;
    EXPECT_EQ(now.raised_ns, old.raised_ns) << i;
    EXPECT_EQ(now.shelved_until_ns, old.shelved_until_ns) << i;
    EXPECT_EQ(now.first_out, old.first_out) << i;
  }
  after.advance(1000);
  const auto transitions = after.take();
  ASSERT_EQ(transitions.size(), 1u);
  EXPECT_EQ(transitions[0].time_ns, 100);
  EXPECT_EQ(transitions[0].event, AlarmEvent::Unshelve);
}

TEST_F(AlarmJournalTest, WhenABurstComes_ThenEveryEntryIsThere) {
  open();
  for (std::int64_t i = 0; i < 20'000; ++i) {
    set(0, i, static_cast<double>(1 - i % 2));
    if (i % 100 == 99) journal_->append(engine_->take());
  }
  keep();
  const auto status = journal_->status();
  EXPECT_EQ(status.appended, 20'000u);
  EXPECT_EQ(status.written, 20'000u);
  EXPECT_EQ(status.dropped, 0u);
  EXPECT_EQ(times({}, 50'000).size(), 20'000u);
}

TEST_F(AlarmJournalTest, WhenThereAreTooManyEntries_ThenTheOldestGo) {
  open({.most_entries = 50});
  for (std::int64_t i = 0; i < 200; ++i) set(0, i, static_cast<double>(1 - i % 2));
  keep();
  const Times left = times({}, 1000);
  ASSERT_EQ(left.size(), 50u);
  EXPECT_EQ(left.back(), 150);
}

TEST_F(AlarmJournalTest, WhenTheDiskIsFull_ThenEntriesWaitAndAreWrittenLater) {
  open({.most_waiting = 5'000, .largest_file_bytes = 15 * 4096});
  for (std::int64_t i = 0; i < 4'000; ++i) set(0, i, static_cast<double>(1 - i % 2));
  journal_->append(engine_->take());
  const auto failed = journal_->flush();
  ASSERT_FALSE(failed.has_value());
  EXPECT_EQ(failed.error()[0].code, "S0003");
  EXPECT_TRUE(journal_->status().failing);
  EXPECT_EQ(journal_->status().dropped, 0u);
  for (std::int64_t i = 4'000; i < 8'000; ++i) set(0, i, static_cast<double>(1 - i % 2));
  journal_->append(engine_->take());
  EXPECT_FALSE(journal_->flush().has_value());
  EXPECT_EQ(journal_->status().dropped, 3'000u);
}

TEST_F(AlarmJournalTest, WhenTheFileIsDamaged_ThenItIsPutAsideAndToldOf) {
  std::ofstream(file()) << std::string(9'000, 'x');
  open();
  set(0, 10, 1);
  keep();
  EXPECT_EQ(times({}), (Times{10}));
  ASSERT_EQ(journal_->status().problems.size(), 1u);
  EXPECT_EQ(journal_->status().problems[0].code, "S0002");
  EXPECT_TRUE(std::filesystem::exists(file().string() + ".damaged-1"));
}

TEST_F(AlarmJournalTest, WhenItCannotBeOpened_ThenTheErrorSaysWhy) {
  EXPECT_EQ(AlarmJournal::open(folder_ / "none" / "a.db", definitions_).error()[0].code, "S0001");
  open();
  EXPECT_EQ(AlarmJournal::open(file(), definitions_).error()[0].code, "S0004");
}

}  // namespace
}  // namespace stepwright::alarms
