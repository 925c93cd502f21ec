#pragma once

// Every transition of every alarm, appended to an SQLite file and found again by time, alarm, variable, state
// or priority (hmi_web/doc/alarms.md).
//
//   auto journal = AlarmJournal::open("state/alarms.db", engine.definitions());
//   (*journal)->append(engine.take());
//   auto entries = (*journal)->find({.from_ns = t0, .state = AlarmState::Unacknowledged}, 100);
//
// Thread rule: everything from any thread. append() never waits for the disk: a thread of the journal's own
// writes at once what has come while it wrote. No failure of the file stops the caller: it stands in
// status(), and entries wait in memory until the file takes them again.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hmi_web/alarms/definition.h"
#include "hmi_web/alarms/engine.h"
#include "runtime/ground/result/result.h"

namespace stepwright::alarms {

struct JournalOptions {
  std::chrono::milliseconds retry_period{200};  // of a file that takes nothing
  std::size_t most_waiting = 1'000'000;         // entries beyond it are dropped and counted
  std::uint64_t most_entries = 10'000'000;      // the oldest go beyond it; 0: none do
  std::chrono::hours most_age{0};               // older entries go; 0: none do
  // The clock of the entries' times, for `most_age`.
  std::function<std::int64_t()> now_ns{};
  std::uint64_t largest_file_bytes = 0;  // writing fails beyond it (S0003); 0: the disk decides
  bool durable = true;                   // a commit waits for the disk: a power failure costs one at most
};

// A transition as the journal keeps it; names instead of ids, which are of one engine.
struct JournalEntry {
  std::int64_t number = 0;  // of the journal, ascending
  std::string alarm;
  std::string source;
  Priority priority = Priority::Medium;
  Transition transition;  // its `alarm` has no meaning
};

// Query by any of these; an empty member matches all.
struct JournalQuery {
  std::optional<std::int64_t> from_ns{}, to_ns{};  // both belong to it
  // A part of the alarm's name, of its variable's, of the person's, in any case.
  std::optional<std::string> alarm{}, source{}, user{};
  std::optional<std::string>
      text{};  // somewhere in name, text, source, user or comment, in any case and language
  std::optional<AlarmState> state{};  // into which it went
  std::optional<AlarmEvent> event{};
  std::optional<Priority> at_least{};    // this priority or a higher one
  std::optional<std::int64_t> before{};  // older than the entry with this number: the next page
};

struct JournalStatus {
  std::uint64_t appended = 0;
  std::uint64_t written = 0;
  std::uint64_t dropped = 0;
  bool failing = false;
  result::Diagnostics problems;  // of the last write, if it failed; and a damaged file put aside
};

class AlarmJournal {
 public:
  // Makes the file if there is none; a damaged one is put aside as FILE.damaged-N. Fails with S0001 to S0008.
  [[nodiscard]] static result::Result<std::unique_ptr<AlarmJournal>> open(
      const std::filesystem::path& file, std::vector<AlarmDefinition> definitions,
      JournalOptions options = {});
  // Writes what is left.
  ~AlarmJournal();
  AlarmJournal(const AlarmJournal&) = delete;
  AlarmJournal& operator=(const AlarmJournal&) = delete;

  // Transitions of an engine with the definitions of open().
  void append(std::span<const Transition> transitions);
  // Waits until everything appended before is in the file, or has failed to get there.
  [[nodiscard]] result::Result<void> flush();

  // The newest first, at most `most`.
  [[nodiscard]] result::Result<std::vector<JournalEntry>> find(const JournalQuery& query,
                                                               std::size_t most) const;
  // Input of AlarmEngine::restore() for every alarm in the journal, by name.
  struct Last {
    std::string alarm;
    AlarmView view;
  };
  [[nodiscard]] result::Result<std::vector<Last>> last() const;

  JournalStatus status() const;

 private:
  class Core;
  explicit AlarmJournal(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

// Brings an engine to where the one before it has ended.
[[nodiscard]] result::Result<void> restore(AlarmEngine& engine, const AlarmJournal& journal);

}  // namespace stepwright::alarms
