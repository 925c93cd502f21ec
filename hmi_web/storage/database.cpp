#include "hmi_web/storage/database.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <system_error>
#include <utility>

#include "hmi_web/storage/codes.h"
#include "runtime/ground/naming/folded_text.h"

namespace stepwright::storage {
namespace {

using result::fail;

tl::unexpected<result::Diagnostics> failure(sqlite3* handle, int code, const std::string& file) {
  const std::string said = handle != nullptr ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  switch (code & 0xFF) {
    case SQLITE_CORRUPT:
      return fail(kDamaged, {file}, "the file is damaged: " + said,
                  "keep it for `sqlite3 FILE .recover` and begin a new one");
    case SQLITE_NOTADB:
      return fail(kDamaged, {file}, "the file is no database: " + said,
                  "name another file, or move this one");
    case SQLITE_FULL:
      return fail(kDiskFull, {file}, "the disk is full, or the file has its largest size: " + said,
                  "free some space; writing is tried again");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return fail(kInUse, {file}, "another process uses the file: " + said, "end the other process");
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return fail(kReadOnly, {file}, "the file must not be written: " + said, "see its rights and its owner");
    case SQLITE_CANTOPEN:
      return fail(kCannotOpen, {file}, "the file cannot be opened: " + said, "see that its folder exists");
    case SQLITE_IOERR:
      return fail(kInputOutput, {file}, "input or output failed: " + said,
                  "see the disk and the system's log");
    case SQLITE_INTERRUPT:
      return fail(kTakesTooLong, {file}, "reading the file takes too long",
                  "ask for a shorter time, or name one alarm");
    default:
      return fail(kOther, {file}, "SQLite says: " + said);
  }
}

// SQLite's own knows letters of ASCII only.
void lower(sqlite3_context* context, int, sqlite3_value** values) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
  if (text == nullptr) return sqlite3_result_null(context);
  const std::string made = naming::folded({text, static_cast<std::size_t>(sqlite3_value_bytes(values[0]))});
  sqlite3_result_text(context, made.data(), static_cast<int>(made.size()), SQLITE_TRANSIENT);
}

// SQLite would make it readable for everybody. Its journals have the mode of the file.
void make_private(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor >= 0) ::close(descriptor);
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}
void Database::Close::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(handle_.get(), parameter, value);
  return *this;
}

Statement& Statement::bind(int parameter, double value) {
  sqlite3_bind_double(handle_.get(), parameter, value);
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view text) {
  sqlite3_bind_text(handle_.get(), parameter, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::byte> bytes) {
  sqlite3_bind_blob(handle_.get(), parameter, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC);
  return *this;
}

result::Result<bool> Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) {
    sqlite3_reset(handle_.get());
    return false;
  }
  auto problem = failure(sqlite3_db_handle(handle_.get()), code, *file_);
  sqlite3_reset(handle_.get());
  return problem;
}

result::Result<void> Statement::run() {
  while (true) {
    auto row = step();
    if (!row) return result::forward(row);
    if (!*row) return {};
  }
}

void Statement::reset() {
  sqlite3_reset(handle_.get());
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}
double Statement::real(int column) const {
  return sqlite3_column_double(handle_.get(), column);
}

std::string_view Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text == nullptr ? std::string_view() : std::string_view(text, bytes(column).size());
}

std::span<const std::byte> Statement::bytes(int column) const {
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(handle_.get(), column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column));
  return data == nullptr ? std::span<const std::byte>() : std::span(data, size);
}

result::Result<Database> Database::open(const std::filesystem::path& file, const DatabaseOptions& options,
                                        const std::string& schema) {
  if (!options.read_only) make_private(file);
  sqlite3* handle = nullptr;
  const int flags = (options.read_only ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) |
                    SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(file.c_str(), &handle, flags, nullptr);
  Database database(handle, file.string());  // SQLite gives a handle even where it fails
  if (code != SQLITE_OK) return failure(handle, code, *database.file_);
  // The file may come from anywhere: its schema must not reach functions with side effects.
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_create_function_v2(handle, "lower", 1, SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS,
                             nullptr, &lower, nullptr, nullptr, nullptr);
  sqlite3_busy_timeout(handle, options.busy_timeout_ms);
  if (auto ready = database.set_up(options, schema); !ready) return result::forward(ready);
  return database;
}

result::Result<void> Database::set_up(const DatabaseOptions& options, const std::string& schema) const {
  if (!options.read_only) {
    // The size of a page must be set before the first write, WAL mode included.
    const std::string pages = "PRAGMA page_size=" + std::to_string(options.page_bytes) + ";";
    auto set =
        execute(pages + "PRAGMA auto_vacuum=INCREMENTAL; PRAGMA journal_mode=WAL; PRAGMA synchronous=" +
                (options.durable ? "FULL;" : "NORMAL;") + "PRAGMA temp_store=MEMORY;");
    if (!set) return set;
    if (options.most_pages > 0) {
      auto bound = execute("PRAGMA max_page_count=" + std::to_string(options.most_pages) + ";");
      if (!bound) return bound;
    }
  }
  auto application = pragma("application_id");
  if (!application) return result::forward(application);
  auto version = pragma("user_version");
  if (!version) return result::forward(version);
  auto tables = pragma("schema_version");  // SQLite's own: 0 in a file without tables
  if (!tables) return result::forward(tables);
  if (*tables == 0 && !options.read_only) {
    auto made =
        execute("BEGIN IMMEDIATE;" + schema + "PRAGMA application_id=" + std::to_string(options.application) +
                "; PRAGMA user_version=" + std::to_string(options.schema_version) + "; COMMIT;");
    if (!made) roll_back();
    return made;
  }
  if (*application != options.application)
    return fail(kOtherKind, {*file_}, "the file is a database of another kind", "name another file");
  if (*version > options.schema_version)
    return fail(kOtherKind, {*file_},
                "the file has version " + std::to_string(*version) + ", and only those up to " +
                    std::to_string(options.schema_version) + " are understood",
                "a newer program has written it");
  return {};
}

result::Result<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(handle_.get(), sql.data(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) return failure(handle_.get(), code, *file_);
  return Statement(statement, file_);
}

result::Result<std::vector<Statement>> Database::prepare_all(std::span<const char* const> texts) const {
  std::vector<Statement> made;
  for (const char* text : texts) {
    auto statement = prepare(text);
    if (!statement) return result::forward(statement);
    made.push_back(std::move(*statement));
  }
  return made;
}

result::Result<void> Database::execute(const std::string& sql) const {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return failure(handle_.get(), code, *file_);
  return {};
}

void Database::roll_back() const {
  if (sqlite3_get_autocommit(handle_.get()) == 0)
    sqlite3_exec(handle_.get(), "ROLLBACK", nullptr, nullptr,
                 nullptr);  // fails only if SQLite did it already
}

result::Result<std::int64_t> Database::pragma(const char* name) const {
  auto statement = prepare("PRAGMA " + std::string(name));
  if (!statement) return result::forward(statement);
  auto row = statement->step();
  if (!row) return result::forward(row);
  return *row ? statement->integer(0) : 0;
}

result::Result<std::uint64_t> Database::used_bytes() const {
  std::int64_t values[3] = {};
  const char* names[] = {"page_count", "freelist_count", "page_size"};
  for (int i = 0; i < 3; ++i) {
    auto value = pragma(names[i]);
    if (!value) return result::forward(value);
    values[i] = *value;
  }
  return static_cast<std::uint64_t>((values[0] - values[1]) * values[2]);
}

void Database::end_after(std::chrono::milliseconds time) {
  using Clock = std::chrono::steady_clock;
  constexpr int kInstructions = 10'000;  // between two looks: a fraction of a millisecond
  deadline_ = std::make_unique<Clock::time_point>(Clock::now() + time);
  const auto is_over = [](void* deadline) -> int {
    return Clock::now() > *static_cast<Clock::time_point*>(deadline);
  };
  sqlite3_progress_handler(handle_.get(), kInstructions, is_over, deadline_.get());
}

result::Result<void> Database::check() const {
  auto statement = prepare("PRAGMA quick_check(1)");
  if (!statement) return result::forward(statement);
  auto row = statement->step();
  if (!row) return result::forward(row);
  if (*row && statement->text(0) != "ok")
    return fail(kDamaged, {*file_}, "the file is damaged: " + std::string(statement->text(0)),
                "keep it for `sqlite3 FILE .recover` and begin a new one");
  return {};
}

bool is_damage(const result::Diagnostics& problems) {
  for (const result::Diagnostic& problem : problems)
    if (problem.code == kDamaged) return true;
  return false;
}

std::filesystem::path put_aside(const std::filesystem::path& file) {
  std::error_code failed;
  std::filesystem::path aside;
  for (int number = 1; aside.empty() || std::filesystem::exists(aside, failed); ++number)
    aside = file.string() + ".damaged-" + std::to_string(number);
  // With its log, so that nothing of it is taken for the next file's.
  for (const char* part : {"", "-wal", "-shm"})
    std::filesystem::rename(file.string() + part, aside.string() + part, failed);
  return aside;
}

result::Diagnostics put_aside_warnings(result::Diagnostics problems, const std::filesystem::path& aside) {
  for (result::Diagnostic& problem : problems) {
    problem.severity = result::Severity::Warning;
    problem.hint = "it was put aside as " + aside.string() + ", and a new file begun";
  }
  return problems;
}

}  // namespace stepwright::storage
