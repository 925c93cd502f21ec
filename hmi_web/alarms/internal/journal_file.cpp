#include "hmi_web/alarms/internal/journal_file.h"

#include <algorithm>
#include <utility>

namespace stepwright::alarms {
namespace {

constexpr std::int32_t kApplication = 0x53574A4C;  // "SWJL"
constexpr std::int32_t kSchemaVersion = 1;
constexpr std::int32_t kPageBytes = 4096;
constexpr std::int64_t kDeletedAtOnce = 1000;

constexpr const char* kSchema = R"(
CREATE TABLE alarm(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, source TEXT NOT NULL);
CREATE TABLE entry(id INTEGER PRIMARY KEY, time_ns INTEGER NOT NULL, alarm INTEGER NOT NULL, priority INTEGER NOT NULL,
  event INTEGER NOT NULL, from_state INTEGER NOT NULL, to_state INTEGER NOT NULL, status INTEGER NOT NULL,
  value REAL, first_out INTEGER NOT NULL, shelved_until_ns INTEGER NOT NULL, sequence INTEGER NOT NULL,
  user TEXT NOT NULL, comment TEXT NOT NULL);
CREATE INDEX entry_time ON entry(time_ns);
CREATE INDEX entry_alarm ON entry(alarm, time_ns);
)";

constexpr const char* kInsert =
    "INSERT INTO entry(time_ns, alarm, priority, event, from_state, to_state, status, value, first_out, "
    "shelved_until_ns, sequence, user, comment) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)";

storage::DatabaseOptions options_of(const JournalOptions& options, bool read_only) {
  storage::DatabaseOptions made;
  made.application = kApplication;
  made.schema_version = kSchemaVersion;
  made.read_only = read_only;
  made.durable = options.durable;
  made.page_bytes = kPageBytes;
  made.most_pages = static_cast<std::int64_t>(options.largest_file_bytes) / kPageBytes;
  return made;
}

template <typename Enum>
std::int64_t number(Enum value) {
  return static_cast<std::int64_t>(value);
}

std::int64_t pack(const AlarmStatus& status) {
  return number(status.annunciated) | (status.active ? 16 : 0) | (status.shelved ? 32 : 0) |
         (status.suppressed ? 64 : 0) | (status.out_of_service ? 128 : 0);
}

// Of a file that nobody vouches for: what is none becomes the first.
template <typename Enum>
Enum unpack_enum(std::int64_t value, std::uint8_t count) {
  return value >= 0 && value < count ? static_cast<Enum>(value) : Enum{};
}

AlarmStatus unpack(std::int64_t bits) {
  AlarmStatus status;
  status.annunciated = unpack_enum<AlarmState>(bits & 15, number(AlarmState::Shelved) & 15);
  status.active = (bits & 16) != 0;
  status.shelved = (bits & 32) != 0;
  status.suppressed = (bits & 64) != 0;
  status.out_of_service = (bits & 128) != 0;
  if (status.is_hidden()) status.annunciated = AlarmState::Normal;
  return status;
}

JournalEntry entry_of(const storage::Statement& row) {
  JournalEntry entry;
  entry.number = row.integer(0);
  entry.alarm = row.text(1);
  entry.source = row.text(2);
  entry.priority = unpack_enum<Priority>(row.integer(3), kPriorities);
  Transition& transition = entry.transition;
  transition.time_ns = row.integer(4);
  transition.event = unpack_enum<AlarmEvent>(row.integer(5), kAlarmEvents);
  transition.from = unpack_enum<AlarmState>(row.integer(6), kAlarmStates);
  transition.to = unpack_enum<AlarmState>(row.integer(7), kAlarmStates);
  transition.status = unpack(row.integer(8));
  transition.value = row.real(9);
  transition.first_out = row.integer(10) != 0;
  transition.shelved_until_ns = row.integer(11);
  transition.sequence = static_cast<std::uint64_t>(row.integer(12));
  transition.user = row.text(13);
  transition.comment = row.text(14);
  return entry;
}

}  // namespace

result::Result<JournalFile> JournalFile::open(const std::filesystem::path& file,
                                              const std::vector<AlarmDefinition>& definitions,
                                              const JournalOptions& options) {
  auto lock = storage::FileLock::take(file);
  if (!lock) return result::forward(lock);
  auto database = storage::Database::open(file, options_of(options, false), kSchema);
  if (!database) return result::forward(database);
  auto insert = database->prepare(kInsert);
  if (!insert) return result::forward(insert);
  std::vector<Priority> priorities;
  for (const AlarmDefinition& one : definitions) priorities.push_back(one.priority);
  JournalFile made(std::move(*lock), std::move(*database), std::move(*insert), std::move(priorities));
  if (auto named = made.name_alarms(definitions); !named) return result::forward(named);
  return made;
}

result::Result<void> JournalFile::name_alarms(const std::vector<AlarmDefinition>& definitions) {
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return begun;
  auto name = database_.prepare(
      "INSERT INTO alarm(name, source) VALUES(?, ?) ON CONFLICT(name) DO UPDATE SET source = excluded.source "
      "RETURNING id");
  if (!name) return result::forward(name);
  for (const AlarmDefinition& one : definitions) {
    auto row = name->bind(1, one.name).bind(2, one.source).step();
    if (!row) return result::forward(row);
    rows_.push_back(name->integer(0));
    if (auto ended = name->run(); !ended) return ended;
  }
  return database_.execute("COMMIT");
}

result::Result<void> JournalFile::write(std::span<const Transition> transitions) {
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return begun;
  auto done = insert_all(transitions);
  if (done) done = database_.execute("COMMIT");
  if (!done) database_.roll_back();
  return done;
}

result::Result<void> JournalFile::insert_all(std::span<const Transition> transitions) {
  for (const Transition& t : transitions) {
    if (t.alarm.value >= rows_.size()) continue;  // of another engine
    insert_.bind(1, t.time_ns).bind(2, rows_[t.alarm.value]).bind(3, number(priorities_[t.alarm.value]));
    insert_.bind(4, number(t.event)).bind(5, number(t.from)).bind(6, number(t.to)).bind(7, pack(t.status));
    insert_.bind(8, t.value).bind(9, std::int64_t{t.first_out}).bind(10, t.shelved_until_ns);
    insert_.bind(11, static_cast<std::int64_t>(t.sequence)).bind(12, t.user).bind(13, t.comment);
    if (auto done = insert_.run(); !done) return done;
  }
  return {};
}

result::Result<bool> JournalFile::retain(std::uint64_t most_entries) {
  // Numbers have no gaps but at the old end.
  auto ends = database_.prepare("SELECT min(id), max(id) FROM entry");
  if (!ends) return result::forward(ends);
  auto row = ends->step();
  if (!row) return row;
  const std::int64_t first = ends->integer(0), last = ends->integer(1);
  ends->reset();
  const std::int64_t excess = last - first + 1 - static_cast<std::int64_t>(most_entries);
  if (most_entries == 0 || last == 0 || excess <= 0) return false;
  const std::int64_t end = first + std::min(excess, kDeletedAtOnce);
  auto done = database_.execute("DELETE FROM entry WHERE id < " + std::to_string(end));
  if (!done) return result::forward(done);
  return excess > kDeletedAtOnce;
}

result::Result<JournalView> JournalView::open(const std::filesystem::path& file) {
  auto database = storage::Database::open(file, options_of({}, true));
  if (!database) return result::forward(database);
  return JournalView(std::move(*database));
}

result::Result<std::vector<JournalEntry>> JournalView::find(const JournalQuery& query,
                                                            std::size_t most) const {
  std::string sql =
      "SELECT entry.id, name, source, priority, time_ns, event, from_state, to_state, status, value, "
      "first_out, "
      "shelved_until_ns, sequence, user, comment FROM entry JOIN alarm ON alarm.id = entry.alarm WHERE 1";
  // Only fixed texts: whatever comes from outside is a parameter.
  if (query.from_ns) sql += " AND time_ns >= ?1";
  if (query.to_ns) sql += " AND time_ns <= ?2";
  if (query.alarm) sql += " AND entry.alarm = (SELECT id FROM alarm WHERE name = ?3)";
  if (query.source) sql += " AND entry.alarm IN (SELECT id FROM alarm WHERE source = ?4)";
  if (query.state) sql += " AND to_state = ?5 AND from_state <> to_state";
  if (query.event) sql += " AND event = ?6";
  if (query.at_least) sql += " AND priority <= ?7";
  if (query.before) sql += " AND (time_ns, entry.id) < ((SELECT time_ns FROM entry WHERE id = ?8), ?8)";
  sql += " ORDER BY time_ns DESC, entry.id DESC LIMIT ?9";
  auto statement = database_.prepare(sql);
  if (!statement) return result::forward(statement);
  if (query.from_ns) statement->bind(1, *query.from_ns);
  if (query.to_ns) statement->bind(2, *query.to_ns);
  if (query.alarm) statement->bind(3, *query.alarm);
  if (query.source) statement->bind(4, *query.source);
  if (query.state) statement->bind(5, number(*query.state));
  if (query.event) statement->bind(6, number(*query.event));
  if (query.at_least) statement->bind(7, number(*query.at_least));
  if (query.before) statement->bind(8, *query.before);
  statement->bind(9, static_cast<std::int64_t>(most));
  std::vector<JournalEntry> entries;
  while (true) {
    auto more = statement->step();
    if (!more) return result::forward(more);
    if (!*more) return entries;
    entries.push_back(entry_of(*statement));
  }
}

result::Result<std::vector<AlarmJournal::Last>> JournalView::last() const {
  // The newest entry of every alarm, when it came into its state, and when it was raised last.
  auto statement = database_.prepare(
      "SELECT name, status, value, first_out, shelved_until_ns, "
      "(SELECT time_ns FROM entry e WHERE e.alarm = alarm.id AND from_state <> to_state ORDER BY id DESC "
      "LIMIT 1), "
      "(SELECT time_ns FROM entry e WHERE e.alarm = alarm.id AND event = ?1 ORDER BY id DESC LIMIT 1) "
      "FROM alarm JOIN entry ON entry.id = (SELECT max(id) FROM entry e WHERE e.alarm = alarm.id)");
  if (!statement) return result::forward(statement);
  statement->bind(1, number(AlarmEvent::Raise));
  std::vector<AlarmJournal::Last> all;
  while (true) {
    auto more = statement->step();
    if (!more) return result::forward(more);
    if (!*more) return all;
    AlarmView view;
    view.status = unpack(statement->integer(1));
    view.value = statement->real(2);
    view.first_out = statement->integer(3) != 0;
    view.shelved_until_ns = statement->integer(4);
    view.since_ns = statement->integer(5);
    view.raised_ns = statement->integer(6);
    all.push_back({std::string(statement->text(0)), view});
  }
}

}  // namespace stepwright::alarms
