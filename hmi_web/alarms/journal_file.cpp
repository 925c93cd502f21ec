#include "hmi_web/alarms/internal/journal_file.h"

#include <algorithm>
#include <string>
#include <utility>

namespace stepwright::alarms {
namespace {

constexpr std::int32_t kApplication = 0x53574A4C;  // "SWJL"
constexpr std::int32_t kSchemaVersion = 1;
constexpr std::int32_t kPageBytes = 4096;
constexpr std::int64_t kDeletedAtOnce = 1000;
// What fits no index of a journal of millions is read whole; others wait meanwhile.
constexpr std::chrono::seconds kLongestRead{5};

constexpr const char* kSchema = R"(
CREATE TABLE alarm(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, source TEXT NOT NULL, status INTEGER,
  since_ns INTEGER, raised_ns INTEGER, value REAL, first_out INTEGER, shelved_until_ns INTEGER);
CREATE TABLE entry(id INTEGER PRIMARY KEY, time_ns INTEGER NOT NULL, alarm INTEGER NOT NULL, priority INTEGER NOT NULL,
  event INTEGER NOT NULL, from_state INTEGER NOT NULL, to_state INTEGER NOT NULL, status INTEGER NOT NULL,
  value REAL, first_out INTEGER NOT NULL, shelved_until_ns INTEGER NOT NULL, sequence INTEGER NOT NULL,
  user TEXT NOT NULL, comment TEXT NOT NULL);
CREATE INDEX entry_time ON entry(time_ns);
CREATE INDEX entry_alarm ON entry(alarm, time_ns);
)";

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

// Six columns of the table of alarms.
AlarmView view_of(const storage::Statement& row, int column) {
  AlarmView view;
  view.status = unpack(row.integer(column));
  view.since_ns = row.integer(column + 1);
  view.raised_ns = row.integer(column + 2);
  view.value = row.real(column + 3);
  view.first_out = row.integer(column + 4) != 0;
  view.shelved_until_ns = row.integer(column + 5);
  return view;
}

}  // namespace

result::Result<JournalFile> JournalFile::open(const std::filesystem::path& file,
                                              const std::vector<AlarmDefinition>& definitions,
                                              const JournalOptions& options, LastViews views) {
  auto lock = storage::FileLock::take(file);
  if (!lock) return result::forward(lock);
  auto database = storage::Database::open(file, options_of(options, false), kSchema);
  if (!database) return result::forward(database);
  JournalFile made(std::move(*lock), std::move(*database), options);
  if (auto ready = made.prepare(); !ready) return result::forward(ready);
  for (const AlarmDefinition& one : definitions) made.priorities_.push_back(one.priority);
  made.views_ = std::move(views);
  made.views_.resize(definitions.size());
  for (const auto& view : made.views_) made.changed_.push_back(view.has_value());
  if (auto named = made.name_alarms(definitions); !named) {
    made.database_.roll_back();
    return result::forward(named);
  }
  return made;
}

result::Result<void> JournalFile::prepare() {
  constexpr const char* kTexts[] = {
      "INSERT INTO entry(time_ns, alarm, priority, event, from_state, to_state, status, value, first_out, "
      "shelved_until_ns, sequence, user, comment) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      "UPDATE alarm SET status = ?2, since_ns = ?3, raised_ns = ?4, value = ?5, first_out = ?6, "
      "shelved_until_ns = ?7 WHERE id = ?1",
      "SELECT min(id), max(id) FROM entry", "DELETE FROM entry WHERE id < ?",
      "DELETE FROM entry WHERE id IN (SELECT id FROM entry WHERE time_ns < ? ORDER BY time_ns LIMIT ?)"};
  auto made = database_.prepare_all(kTexts);
  if (!made) return result::forward(made);
  statements_.emplace(Statements{std::move((*made)[0]), std::move((*made)[1]), std::move((*made)[2]),
                                 std::move((*made)[3]), std::move((*made)[4])});
  return {};
}

// Gives every alarm its row, and takes from it what is known.
result::Result<void> JournalFile::name_alarms(const std::vector<AlarmDefinition>& definitions) {
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return begun;
  auto name = database_.prepare(
      "INSERT INTO alarm(name, source) VALUES(?, ?) ON CONFLICT(name) DO UPDATE SET source = excluded.source "
      "RETURNING id, status IS NOT NULL, status, since_ns, raised_ns, value, first_out, shelved_until_ns");
  if (!name) return result::forward(name);
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    auto row = name->bind(1, definitions[i].name).bind(2, definitions[i].source).step();
    if (!row) return result::forward(row);
    rows_.push_back(name->integer(0));
    if (name->integer(1) != 0 && !views_[i]) views_[i] = view_of(*name, 2);
    if (auto ended = name->run(); !ended) return ended;
  }
  return database_.execute("COMMIT");
}

result::Result<void> JournalFile::write(std::span<const Transition> transitions) {
  if (auto begun = database_.execute("BEGIN IMMEDIATE"); !begun) return begun;
  auto done = write_all(transitions);
  if (done) done = database_.execute("COMMIT");
  if (done) {
    changed_.assign(changed_.size(), false);
  } else {
    database_.roll_back();
  }
  return done;
}

result::Result<void> JournalFile::write_all(std::span<const Transition> transitions) {
  // Before anything is added: a file of its largest size has room again.
  if (auto done = retain(); !done) return done;
  for (const Transition& transition : transitions) {
    if (transition.alarm.value >= rows_.size()) continue;  // of another engine
    if (auto done = insert(transition); !done) return done;
  }
  if (auto done = update_alarms(); !done) return done;
  return retain();
}

result::Result<void> JournalFile::insert(const Transition& t) {
  const std::size_t alarm = t.alarm.value;
  storage::Statement& row = statements_->insert;
  row.bind(1, t.time_ns).bind(2, rows_[alarm]).bind(3, number(priorities_[alarm]));
  row.bind(4, number(t.event)).bind(5, number(t.from)).bind(6, number(t.to)).bind(7, pack(t.status));
  row.bind(8, t.value).bind(9, std::int64_t{t.first_out}).bind(10, t.shelved_until_ns);
  row.bind(11, static_cast<std::int64_t>(t.sequence)).bind(12, t.user).bind(13, t.comment);
  if (auto done = row.run(); !done) return done;
  if (!views_[alarm]) views_[alarm].emplace();
  AlarmView& view = *views_[alarm];
  view.status = t.status;
  view.value = t.value;
  view.first_out = t.first_out;
  view.shelved_until_ns = t.shelved_until_ns;
  if (t.from != t.to) view.since_ns = t.time_ns;
  if (t.event == AlarmEvent::Raise) view.raised_ns = t.time_ns;
  changed_[alarm] = true;
  return {};
}

result::Result<void> JournalFile::update_alarms() {
  storage::Statement& row = statements_->update;
  for (std::size_t alarm = 0; alarm < changed_.size(); ++alarm) {
    if (!changed_[alarm]) continue;
    const AlarmView& view = *views_[alarm];
    row.bind(1, rows_[alarm]).bind(2, pack(view.status)).bind(3, view.since_ns).bind(4, view.raised_ns);
    row.bind(5, view.value).bind(6, std::int64_t{view.first_out}).bind(7, view.shelved_until_ns);
    if (auto done = row.run(); !done) return done;
  }
  return {};
}

result::Result<void> JournalFile::retain() {
  if (options_.most_age.count() > 0 && options_.now_ns) {
    const std::int64_t oldest_ns = options_.now_ns() - std::chrono::nanoseconds(options_.most_age).count();
    auto done = statements_->delete_older.bind(1, oldest_ns).bind(2, kDeletedAtOnce).run();
    if (!done) return done;
  }
  if (options_.most_entries == 0) return {};
  storage::Statement& ends = statements_->ends;
  if (auto row = ends.step(); !row) return result::forward(row);
  const std::int64_t first = ends.integer(0), last = ends.integer(1);
  ends.reset();
  const std::int64_t excess = last - first + 1 - static_cast<std::int64_t>(options_.most_entries);
  if (last == 0 || excess <= 0) return {};
  return statements_->delete_before.bind(1, first + std::min(excess, kDeletedAtOnce)).run();
}

result::Result<JournalView> JournalView::open(const std::filesystem::path& file) {
  auto database = storage::Database::open(file, options_of({}, true));
  if (!database) return result::forward(database);
  database->end_after(kLongestRead);
  return JournalView(std::move(*database));
}

result::Result<std::vector<JournalEntry>> JournalView::find(const JournalQuery& query,
                                                            const std::string& named,
                                                            std::size_t most) const {
  std::string sql =
      "SELECT e.id, a.name, a.source, priority, time_ns, event, from_state, to_state, e.status, e.value, "
      "e.first_out, e.shelved_until_ns, sequence, user, comment FROM entry e JOIN alarm a ON a.id = e.alarm "
      "WHERE 1";
  // Only fixed texts: whatever comes from outside is a parameter.
  if (query.from_ns) sql += " AND time_ns >= ?1";
  if (query.to_ns) sql += " AND time_ns <= ?2";
  // instr, not LIKE: what somebody looks for has no wildcards.
  if (query.alarm) sql += " AND instr(lower(a.name), lower(?3)) > 0";
  if (query.source) sql += " AND e.alarm IN (SELECT id FROM alarm WHERE instr(lower(source), lower(?4)) > 0)";
  if (query.state) sql += " AND to_state = ?5 AND from_state <> to_state";
  if (query.event) sql += " AND event = ?6";
  if (query.at_least) sql += " AND priority <= ?7";
  if (query.before) sql += " AND (time_ns, e.id) < ((SELECT time_ns FROM entry WHERE id = ?8), ?8)";
  if (query.user) sql += " AND instr(lower(user), lower(?10)) > 0";
  if (query.text)
    sql +=
        " AND (instr(lower(a.name || char(10) || a.source || char(10) || user || char(10) || comment), "
        "lower(?11)) > 0 OR instr(?12, char(10) || a.name || char(10)) > 0)";
  sql += " ORDER BY time_ns DESC, e.id DESC LIMIT ?9";
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
  if (query.user) statement->bind(10, *query.user);
  if (query.text) statement->bind(11, *query.text).bind(12, named);
  std::vector<JournalEntry> entries;
  while (true) {
    auto more = statement->step();
    if (!more) return result::forward(more);
    if (!*more) return entries;
    entries.push_back(entry_of(*statement));
  }
}

result::Result<std::vector<AlarmJournal::Last>> JournalView::last() const {
  auto row = database_.prepare(
      "SELECT name, status, since_ns, raised_ns, value, first_out, shelved_until_ns FROM alarm "
      "WHERE status IS NOT NULL");
  if (!row) return result::forward(row);
  std::vector<AlarmJournal::Last> all;
  while (true) {
    auto more = row->step();
    if (!more) return result::forward(more);
    if (!*more) return all;
    all.push_back({std::string(row->text(0)), view_of(*row, 1)});
  }
}

}  // namespace stepwright::alarms
