#include "hmi_web/access/audit_log.h"

#include <fmt/chrono.h>

#include <utility>

#include "hmi_web/access/audit_chain.h"

namespace stepwright::access {
namespace {

std::string utc_text(std::chrono::system_clock::time_point time) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(time);
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(time - whole).count();
  return fmt::format("{:%FT%T}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(whole)), ms);
}

std::filesystem::path free_name_beside(const std::filesystem::path& file) {
  for (int i = 1;; ++i) {
    std::filesystem::path name = file.string() + ".broken-" + std::to_string(i);
    if (!std::filesystem::exists(name)) return name;
  }
}

}  // namespace

result::Result<std::unique_ptr<AuditLog>> AuditLog::open(const std::filesystem::path& file, WallClock clock) {
  if (auto made = make_private_folder(file.parent_path()); !made) return result::forward(made);
  ChainCheck check;
  check.head = first_hash();
  std::string found;
  if (std::filesystem::exists(file)) {
    const auto text = read_whole(file);
    if (!text) return tl::unexpected(text.error());
    check = check_chain(*text);
    std::error_code error;
    if (check.torn) {
      found = "a line that a crash had left half written was cut off";
      std::filesystem::resize_file(file, check.right_bytes, error);
    } else if (check.broken_line > 0) {
      const std::filesystem::path aside = free_name_beside(file);
      found = "line " + std::to_string(check.broken_line) + " was wrong (" + check.why + "); moved to " +
              aside.filename().string();
      std::filesystem::rename(file, aside, error);
      check = {};
      check.head = first_hash();
    }
    if (error) return result::fail("H0021", {file.string(), 0, 0}, "the audit trail: " + error.message());
  }
  auto descriptor = open_for_append(file);
  if (!descriptor) return result::forward(descriptor);
  std::unique_ptr<AuditLog> log(new AuditLog(file, std::move(*descriptor), std::move(clock)));
  log->sequence_ = check.entries;
  log->head_ = check.head;
  log->found_ = found;
  if (found.empty()) return log;
  if (auto told =
          log->append({.action = "audit.opened", .target = file.filename().string(), .result = found});
      !told)
    return result::forward(told);
  return log;
}

result::Result<void> AuditLog::append(const AuditEntry& entry) {
  const std::lock_guard lock(mutex_);
  const ChainLine line = chain_line(entry, sequence_ + 1, utc_text(clock_()), head_);
  if (auto written = append_durably(descriptor_, file_, line.text); !written) return written;
  ++sequence_;
  head_ = line.hash;
  return {};
}

std::uint64_t AuditLog::entries() const {
  const std::lock_guard lock(mutex_);
  return sequence_;
}

}  // namespace stepwright::access
