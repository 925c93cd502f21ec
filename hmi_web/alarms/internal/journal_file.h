#pragma once

// The rows of an alarm journal.
//
// Thread rule: an object belongs to one thread at a time; writer and readers have connections of their own.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "hmi_web/alarms/journal.h"
#include "hmi_web/storage/database.h"
#include "hmi_web/storage/file_lock.h"

namespace stepwright::alarms {

class JournalFile {
 public:
  [[nodiscard]] static result::Result<JournalFile> open(const std::filesystem::path& file,
                                                        const std::vector<AlarmDefinition>& definitions,
                                                        const JournalOptions& options);

  // All or nothing.
  [[nodiscard]] result::Result<void> write(std::span<const Transition> transitions);
  // Deletes what is too old, a limited number of entries in a call; gives whether there may be more.
  [[nodiscard]] result::Result<bool> retain(std::uint64_t most_entries);

 private:
  JournalFile(storage::FileLock lock, storage::Database database, storage::Statement insert,
              std::vector<Priority> priorities)
      : lock_(std::move(lock)),
        database_(std::move(database)),
        insert_(std::move(insert)),
        priorities_(std::move(priorities)) {}
  result::Result<void> name_alarms(const std::vector<AlarmDefinition>& definitions);
  result::Result<void> insert_all(std::span<const Transition> transitions);

  storage::FileLock lock_;
  storage::Database database_;
  storage::Statement insert_;
  std::vector<Priority> priorities_;  // by AlarmId
  std::vector<std::int64_t> rows_;    // of the table of alarms, by AlarmId
};

class JournalView {
 public:
  [[nodiscard]] static result::Result<JournalView> open(const std::filesystem::path& file);
  [[nodiscard]] result::Result<std::vector<JournalEntry>> find(const JournalQuery& query,
                                                               std::size_t most) const;
  [[nodiscard]] result::Result<std::vector<AlarmJournal::Last>> last() const;

 private:
  explicit JournalView(storage::Database database) : database_(std::move(database)) {}
  storage::Database database_;
};

}  // namespace stepwright::alarms
