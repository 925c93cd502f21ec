#pragma once

// The audit trail: one line of JSON for everything that somebody did, in files that are only ever appended
// to. Each line carries the SHA-256 of itself and of the line before, so that nothing in the middle can be
// changed, left out or put in unnoticed (audit_chain.h checks it; format: hmi_web/doc/access.md). A file that
// has grown to its size is closed, the chain goes on in the next (audit_files.h); the oldest go when all of
// them are too much, with an entry that says so.
//
//   auto log = AuditLog::open("cell-state/access/audit.jsonl");
//   if (!(*log)->append({.user = "ada", .action = "plan.goal", .result = "done"})) refuse();
//   (*log)->append_later({.user = "ada", .action = "plan.abort", .result = "begun"});   // waits for no disk
//
// Threads: every function from any. Invariants: a line whose append has returned is on the disk; opening
// reads the end of the newest file only. Fails with H0021.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "runtime/ground/files/descriptor.h"
#include "runtime/ground/result/result.h"

namespace stepwright::access {

struct AuditEntry {
  std::string user = {};  // empty: nobody has logged in
  std::string role = {};
  std::string address = {};  // from which it was asked
  std::string action = {};   // "plan.abort"
  std::string target = {};   // what it was done to; may be empty
  std::string before = {};   // its value, as text; may be empty
  std::string after = {};
  std::string reason = {};  // in the person's words; may be empty
  std::string result = {};  // "begun", "done", "refused: ..."
};

using WallClock = std::function<std::chrono::system_clock::time_point()>;

struct AuditLimits {
  std::uint64_t segment_bytes = std::uint64_t{4} << 20;  // a file that would grow beyond it is closed
  std::uint64_t most_bytes = std::uint64_t{256} << 20;   // of all files; at least two segments stay
};

class AuditLog {
 public:
  static constexpr std::size_t kMostWaiting = 1'024;  // entries; more are counted and not kept

  // Goes on behind the last line. What a crash left of a line that was never confirmed is cut off; a file
  // whose chain is broken is moved aside ("audit.jsonl.broken-1") and a new one begun. Both are told in the
  // first entry.
  [[nodiscard]] static result::Result<std::unique_ptr<AuditLog>> open(
      const std::filesystem::path& file, WallClock clock = std::chrono::system_clock::now,
      const AuditLimits& limits = {});
  // Tries once more to write what waits.
  ~AuditLog();

  [[nodiscard]] result::Result<void> append(const AuditEntry& entry);
  // For what must never wait for a disk: kept in memory with its time, written by a thread of the log as soon
  // as the disk takes it.
  void append_later(AuditEntry entry);
  // Waits until what was handed over is written, or a try to write it has failed.
  void settle();

  // The number of the last line, and its hash.
  std::uint64_t entries() const;
  std::string head() const;
  // The growing one; closed ones stand beside it.
  const std::filesystem::path& file() const { return file_; }
  // Message for the operator of the server; empty: none.
  const std::string& found_at_start() const { return found_; }

 private:
  struct Waiting {
    AuditEntry entry;
    std::chrono::system_clock::time_point time;
  };

  AuditLog(std::filesystem::path file, WallClock clock, const AuditLimits& limits)
      : file_(std::move(file)), clock_(std::move(clock)), limits_(limits) {}
  // Reads the end of the trail and mends it; says what it found.
  [[nodiscard]] result::Result<std::string> go_on();
  // With mutex_ held.
  [[nodiscard]] result::Result<void> append_at(const AuditEntry& entry,
                                               std::chrono::system_clock::time_point time);
  [[nodiscard]] result::Result<void> close_segment();
  void remove_oldest(std::chrono::system_clock::time_point time);
  bool write_first_waiting();
  void write_waiting(const std::stop_token& stop);

  const std::filesystem::path file_;
  const WallClock clock_;
  const AuditLimits limits_;
  std::string found_;
  mutable std::mutex mutex_;
  files::Descriptor descriptor_;  // this and below: guarded by mutex_
  std::uint64_t bytes_ = 0;       // of the growing file
  std::uint64_t first_ = 1;       // number of its first line
  std::uint64_t sequence_ = 0;    // of the last line
  std::string head_;              // its hash
  std::mutex waiting_mutex_;      // never held while a disk is waited for
  std::condition_variable_any waits_, settled_;
  std::deque<Waiting> waiting_;  // this and below: guarded by waiting_mutex_
  std::uint64_t left_out_ = 0;   // that there was no room for
  std::uint64_t failures_ = 0;
  std::jthread writer_;  // last: it uses all of the above
};

}  // namespace stepwright::access
