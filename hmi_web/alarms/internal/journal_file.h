#pragma once

// The rows of an alarm journal: entries, and of every alarm what the last of its entries left it in, so that
// a start reads as much as there are alarms, and what is deleted of the entries changes no alarm.
//
// Thread rule: an object belongs to one thread at a time; writer and readers have connections of their own.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "hmi_web/alarms/journal.h"
#include "hmi_web/storage/database.h"
#include "hmi_web/storage/file_lock.h"

namespace stepwright::alarms {

// nullopt: the journal knows nothing of the alarm.
using LastViews = std::vector<std::optional<AlarmView>>;

class JournalFile {
 public:
  // `views`: what was known of the alarms in a file that is lost; the first write brings them here.
  [[nodiscard]] static result::Result<JournalFile> open(const std::filesystem::path& file,
                                                        const std::vector<AlarmDefinition>& definitions,
                                                        const JournalOptions& options, LastViews views = {});

  // All or nothing; with it what is beyond the bounds goes, a limited number of entries in a call.
  [[nodiscard]] result::Result<void> write(std::span<const Transition> transitions);

  const LastViews& views() const { return views_; }

 private:
  struct Statements {
    storage::Statement insert, update, ends, delete_before, delete_older;
  };
  JournalFile(storage::FileLock lock, storage::Database database, JournalOptions options)
      : lock_(std::move(lock)), database_(std::move(database)), options_(std::move(options)) {}
  result::Result<void> prepare();
  result::Result<void> name_alarms(const std::vector<AlarmDefinition>& definitions);
  result::Result<void> write_all(std::span<const Transition> transitions);
  result::Result<void> insert(const Transition& transition);
  result::Result<void> update_alarms();
  result::Result<void> retain();

  storage::FileLock lock_;
  storage::Database database_;
  JournalOptions options_;
  std::optional<Statements> statements_;
  std::vector<Priority> priorities_;  // this and the next three: by AlarmId
  std::vector<std::int64_t> rows_;    // of the table of alarms
  LastViews views_;
  std::vector<bool> changed_;  // `views_` is newer than the file
};

class JournalView {
 public:
  [[nodiscard]] static result::Result<JournalView> open(const std::filesystem::path& file);
  // `named`: lines of the names of alarms that `query.text` finds, too.
  [[nodiscard]] result::Result<std::vector<JournalEntry>> find(const JournalQuery& query,
                                                               const std::string& named,
                                                               std::size_t most) const;
  [[nodiscard]] result::Result<std::vector<AlarmJournal::Last>> last() const;

 private:
  explicit JournalView(storage::Database database) : database_(std::move(database)) {}
  storage::Database database_;
};

}  // namespace stepwright::alarms
