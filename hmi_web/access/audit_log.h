#pragma once

// The audit trail: one line of JSON for everything that somebody did, in a file that is only ever appended
// to. Each line carries the SHA-256 of itself and of the line before, so that nothing in the middle can be
// changed, left out or put in unnoticed (audit_chain.h checks it; format: hmi_web/doc/audit.md).
//
//   auto log = AuditLog::open("cell-state/access/audit.jsonl");
//   if (!(*log)->append({.user = "ada", .action = "plan.abort", .result = "done"})) refuse();
//
// Threads: every function from any. Invariant: a line whose append has returned is on the disk. Fails with
// H0021.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hmi_web/access/durable_file.h"
#include "runtime/result/result.h"

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

class AuditLog {
 public:
  // Goes on behind the last line. What a crash left of a line that was never confirmed is cut off; a file
  // whose chain is broken is moved aside ("audit.jsonl.broken-1") and a new one begun. Both are told in the
  // first entry.
  [[nodiscard]] static result::Result<std::unique_ptr<AuditLog>> open(
      const std::filesystem::path& file, WallClock clock = std::chrono::system_clock::now);

  [[nodiscard]] result::Result<void> append(const AuditEntry& entry);

  std::uint64_t entries() const;
  const std::filesystem::path& file() const { return file_; }
  // What is to be told to whoever looks after the server; empty: nothing.
  const std::string& found_at_start() const { return found_; }

 private:
  AuditLog(std::filesystem::path file, Descriptor descriptor, WallClock clock)
      : file_(std::move(file)), descriptor_(std::move(descriptor)), clock_(std::move(clock)) {}

  const std::filesystem::path file_;
  const Descriptor descriptor_;
  const WallClock clock_;
  std::string found_;
  mutable std::mutex mutex_;
  std::uint64_t sequence_ = 0;  // guarded by mutex_: of the last line
  std::string head_;            // guarded by mutex_: its hash
};

}  // namespace stepwright::access
