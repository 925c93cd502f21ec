#pragma once

// SQLite behind move-only handles: a database file in WAL mode and its prepared statements. The only place of
// the tree that knows SQLite's C API.
//
//   auto database = Database::open("history.db", {.application = 0x53574849, .schema_version = 1});
//   auto insert = database->prepare("INSERT INTO entry(time, text) VALUES(?, ?)");
//   insert->bind(1, time_ns).bind(2, "pump on");
//   if (auto done = insert->run(); !done) ...
//
// Thread rule: a database and its statements belong to one thread at a time. Statements end before their
// database.
//
// Every failure is a diagnostic with the file's name: S0001 cannot be opened, S0002 damaged or no database,
// S0003 the disk is full, S0004 in use by another process, S0005 must not be written, S0006 input or output
// failed, S0007 anything else that SQLite says, S0008 a database of another kind or version, S0009 it takes
// too long.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace stepwright::storage {

class Statement {
 public:
  // Parameters count from 1. Texts and bytes must live until the statement has run.
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, double value);
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::span<const std::byte> bytes);

  // The next row: false behind the last one, after which the statement can be bound and run again.
  [[nodiscard]] result::Result<bool> step();
  // Runs to the end; rows are dropped.
  [[nodiscard]] result::Result<void> run();
  // Gives up the rows that are left.
  void reset();

  // Columns count from 0; valid until the next step.
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string_view text(int column) const;
  std::span<const std::byte> bytes(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(sqlite3_stmt* handle, std::shared_ptr<const std::string> file)
      : handle_(handle), file_(std::move(file)) {}

  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  std::shared_ptr<const std::string> file_;  // for diagnostics; shared with the database that may be moved
};

struct DatabaseOptions {
  std::int32_t application = 0;         // marks the file as of one kind; another kind is refused
  std::int32_t schema_version = 1;      // the newest that is understood; a newer file is refused
  bool read_only = false;               // the file must exist
  bool durable = false;                 // a commit waits for the disk; otherwise only a checkpoint does
  std::int32_t page_bytes = 4096;       // of a new file; a power of two
  std::int32_t busy_timeout_ms = 2000;  // how long a lock of another connection is waited for
  std::int64_t most_pages = 0;          // the file grows no further: S0003; 0 = as far as the disk goes
};

class Database {
 public:
  // Makes the file if there is none. `schema` is executed in a new file only.
  [[nodiscard]] static result::Result<Database> open(const std::filesystem::path& file,
                                                     const DatabaseOptions& options,
                                                     const std::string& schema = {});

  [[nodiscard]] result::Result<Statement> prepare(std::string_view sql) const;
  // In the order of the texts, or the first that fails.
  [[nodiscard]] result::Result<std::vector<Statement>> prepare_all(std::span<const char* const> texts) const;
  // One or more statements without parameters.
  [[nodiscard]] result::Result<void> execute(const std::string& sql) const;
  // Ends a transaction that failed; nothing happens where none is open.
  void roll_back() const;
  // Size of the file's content, without free pages.
  [[nodiscard]] result::Result<std::uint64_t> used_bytes() const;
  // From now on until then; whatever is under way or asked for after that fails (S0009). For what anybody
  // asks.
  void end_after(std::chrono::milliseconds time);
  // Reads every page: S0002 with the first fault that SQLite finds.
  [[nodiscard]] result::Result<void> check() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  Database(sqlite3* handle, std::string file)
      : handle_(handle), file_(std::make_shared<const std::string>(std::move(file))) {}
  [[nodiscard]] result::Result<void> set_up(const DatabaseOptions& options, const std::string& schema) const;
  [[nodiscard]] result::Result<std::int64_t> pragma(const char* name) const;

  std::unique_ptr<std::chrono::steady_clock::time_point> deadline_;  // SQLite looks at it; null: none
  std::unique_ptr<sqlite3, Close> handle_;
  std::shared_ptr<const std::string> file_;
};

// True for the failures that mean that the file itself cannot be used any more.
bool is_damage(const result::Diagnostics& problems);

// Renames a database and its log to FILE.damaged-N, the first N that is free, and gives that name. What
// cannot be renamed stays: the next open says why.
std::filesystem::path put_aside(const std::filesystem::path& file);

// The same diagnostics as warnings that say where the file is now.
result::Diagnostics put_aside_warnings(result::Diagnostics problems, const std::filesystem::path& aside);

}  // namespace stepwright::storage
