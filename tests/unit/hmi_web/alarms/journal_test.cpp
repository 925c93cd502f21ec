#include "hmi_web/alarms/journal.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "hmi_web/storage/database.h"
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
    const auto entries = journal_->find(query, most);
    EXPECT_TRUE(entries.has_value());
    std::vector<std::int64_t> found;
    if (!entries) return found;
    for (const JournalEntry& entry : *entries) found.push_back(entry.transition.time_ns);
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
  ASSERT_TRUE(engine_->command({AlarmId(1), AlarmEvent::Acknowledge, 40, "Änne", "it's 'seen'; ÜBERPRÜFT --"})
                  .has_value());
  keep();
  EXPECT_EQ(times({}), (Times{40, 30, 20, 10}));
  EXPECT_EQ(times({.from_ns = 20, .to_ns = 30}), (Times{30, 20}));
  EXPECT_EQ(times({.alarm = "A"}), (Times{30, 10})) << "in any case";
  EXPECT_EQ(times({.source = "main.b"}), (Times{40, 20}));
  EXPECT_EQ(times({.source = "MAIN.B"}), (Times{40, 20})) << "as the program has it";
  EXPECT_EQ(times({.source = "IN.b"}), (Times{40, 20})) << "and by a part of it";
  EXPECT_EQ(times({.source = "ain.%"}), (Times{}));
  EXPECT_EQ(times({.user = "änne"}), (Times{40}));
  EXPECT_EQ(times({.user = "NN"}), (Times{40}));
  EXPECT_EQ(times({.user = "Annette"}), (Times{}));
  EXPECT_EQ(times({.text = "SEEN"}), (Times{40}));
  EXPECT_EQ(times({.text = "überprüft"}), (Times{40}));
  EXPECT_EQ(times({.text = "main.a"}), (Times{30, 10}));
  EXPECT_EQ(times({.text = "%"}), (Times{})) << "what is looked for has no wildcards";
  EXPECT_EQ(times({.to_ns = 30, .text = "main."}), (Times{30, 20, 10}));
  EXPECT_EQ(times({.state = AlarmState::Unacknowledged}), (Times{20, 10}));
  EXPECT_EQ(times({.event = AlarmEvent::Acknowledge}), (Times{40}));
  EXPECT_EQ(times({.at_least = Priority::High}), (Times{30, 10}));
  EXPECT_EQ(times({.alarm = "a' OR 1=1 --"}), (Times{}));
  EXPECT_EQ(times({.from_ns = 5, .alarm = "a", .state = AlarmState::Unacknowledged}), (Times{10}));

  const auto entries = journal_->find({}, 100).value();
  EXPECT_EQ(entries[0].transition.user, "Änne");
  EXPECT_EQ(entries[0].transition.comment, "it's 'seen'; ÜBERPRÜFT --");
  EXPECT_EQ(entries[3].alarm, "a");
  EXPECT_EQ(entries[3].source, "main.a");
  EXPECT_EQ(entries[3].priority, Priority::Critical);
  EXPECT_EQ(entries[3].transition.value, 1.5);
  EXPECT_TRUE(entries[3].transition.first_out);
  EXPECT_FALSE(entries[2].transition.first_out);
  EXPECT_EQ(entries[3].transition.from, AlarmState::Normal);
}

TEST_F(AlarmJournalTest, WhenATextIsLookedFor_ThenWhatPeopleReadIsSearchedInEveryLanguage) {
  definitions_[0].text = "First alarm";
  definitions_[0].words["de"].text = "Erster Überlauf";
  definitions_[1].text = "Second 100% alarm";
  open();
  set(0, 10, 1);
  set(1, 20, 1);
  set(2, 30, 1);
  keep();
  EXPECT_EQ(times({.text = "first"}), (Times{10}));
  EXPECT_EQ(times({.text = "erster überLAUF"}), (Times{10}));
  EXPECT_EQ(times({.text = "ALARM"}), (Times{20, 10}));
  EXPECT_EQ(times({.text = "100%"}), (Times{20}));
  EXPECT_EQ(times({.text = "main."}), (Times{30, 20, 10}));
  EXPECT_EQ(times({.from_ns = 15, .text = "alarm"}), (Times{20}));
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

TEST_F(AlarmJournalTest, WhenEntriesAreTooOld_ThenTheyGoAndTheirAlarmsStayAsTheyWere) {
  constexpr std::int64_t kHour = 3'600'000'000'000;
  std::atomic<std::int64_t> now = 0;
  open({.most_age = std::chrono::hours(10), .now_ns = [&] { return now.load(); }});
  set(0, kHour, 1);
  ASSERT_TRUE(engine_->command({AlarmId(1), AlarmEvent::RemoveFromService, 2 * kHour, "anna"}).has_value());
  keep();
  EXPECT_EQ(times({}).size(), 2u);
  now = 13 * kHour;
  set(0, now, 0);
  keep();
  EXPECT_EQ(times({}), (Times{13 * kHour}));
  journal_.reset();
  open();
  auto after = AlarmEngine::create(definitions_).value();
  ASSERT_TRUE(restore(after, *journal_).has_value());
  EXPECT_EQ(after.view(AlarmId(1)).status.state(), AlarmState::OutOfService);
  EXPECT_EQ(after.view(AlarmId(1)).since_ns, 2 * kHour);
  EXPECT_EQ(after.view(AlarmId(0)).raised_ns, kHour);
}

// Raises and returns alarm after alarm, each change in the file before it is told, until it is killed.
[[noreturn]] void journal_until_killed(const std::filesystem::path& file,
                                       const std::vector<AlarmDefinition>& definitions, int pipe) {
  auto engine = AlarmEngine::create(definitions).value();
  const auto journal = AlarmJournal::open(file, definitions).value();
  for (std::int64_t i = 0;; ++i) {
    engine.offer(SourceId(static_cast<std::uint32_t>(i % 3)), i, i / 3 % 2 == 0 ? 1 : 0, true);
    journal->append(engine.take());
    if (i % 10 != 0) continue;
    if (!journal->flush()) _exit(1);
    const std::int64_t flushed = i + 1;
    if (::write(pipe, &flushed, sizeof flushed) != sizeof flushed) _exit(1);
  }
}

TEST_F(AlarmJournalTest, WhenTheProcessIsKilled_ThenNoEntryThatWasFlushedIsLostAndStatesFitTheEntries) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  if (child == 0) journal_until_killed(file(), definitions_, pipe[1]);
  ::close(pipe[1]);
  std::int64_t flushed = 0;
  for (int i = 0; i < 5; ++i)
    ASSERT_EQ(::read(pipe[0], &flushed, sizeof flushed), static_cast<ssize_t>(sizeof flushed));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  while (::read(pipe[0], &flushed, sizeof flushed) > 0) {
  }
  ::close(pipe[0]);
  open();
  EXPECT_TRUE(journal_->status().problems.empty());
  const auto entries = journal_->find({}, 1'000'000).value();
  ASSERT_GE(entries.size(), static_cast<std::size_t>(flushed));
  for (std::size_t i = 0; i < entries.size(); ++i)
    ASSERT_EQ(entries[i].transition.time_ns, static_cast<std::int64_t>(entries.size() - 1 - i));
  const auto last = journal_->last().value();
  ASSERT_EQ(last.size(), 3u);
  for (const AlarmJournal::Last& one : last) {
    const auto newest = journal_->find({.alarm = one.alarm}, 1).value();
    EXPECT_EQ(one.view.status, newest.at(0).transition.status) << one.alarm;
  }
}

TEST_F(AlarmJournalTest, WhenItsPagesAreDamagedWhileItRuns_ThenANewFileHasWhatCameAndEveryState) {
  open();
  ASSERT_TRUE(engine_->command({AlarmId(2), AlarmEvent::RemoveFromService, 5, "anna"}).has_value());
  for (std::int64_t i = 0; i < 2'000; ++i) set(0, i, static_cast<double>(1 - i % 2));
  keep();
  journal_.reset();
  std::int64_t page = 0;
  {
    storage::DatabaseOptions options;
    options.application = 0x53574A4C;
    auto database = storage::Database::open(file(), options).value();
    auto root = database.prepare("SELECT rootpage FROM sqlite_schema WHERE name = 'entry'").value();
    ASSERT_TRUE(root.step().value());
    page = root.integer(0);
    root.reset();
    ASSERT_TRUE(database.execute("PRAGMA wal_checkpoint(TRUNCATE)").has_value());
  }
  {
    std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp((page - 1) * 4096);
    stream << std::string(4096, '\x5A');
  }
  open();
  for (std::int64_t i = 2'000; i < 2'010; ++i) set(0, i, static_cast<double>(1 - i % 2));
  journal_->append(engine_->take());
  (void)journal_->flush();  // fails, or not if the new file is there already
  set(1, 2'010, 1);
  keep();
  EXPECT_TRUE(std::filesystem::exists(file().string() + ".damaged-1"));
  EXPECT_EQ(times({}).size(), 11u);
  auto after = AlarmEngine::create(definitions_).value();
  ASSERT_TRUE(restore(after, *journal_).has_value());
  EXPECT_EQ(after.view(AlarmId(2)).status.state(), AlarmState::OutOfService) << "of the file that is lost";
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
