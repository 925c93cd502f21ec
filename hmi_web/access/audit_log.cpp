#include "hmi_web/access/audit_log.h"

#include <utility>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_files.h"
#include "hmi_web/access/audit_text.h"
#include "hmi_web/access/codes.h"
#include "hmi_web/storage/private_files.h"
#include "runtime/ground/files/durable_file.h"

namespace stepwright::access {
namespace {

// Of a file that is larger than a segment (of an earlier version) the end is looked at.
constexpr std::size_t kEndBytes = std::size_t{8} << 20;
constexpr std::chrono::seconds kBetweenTries{1};

std::filesystem::path free_name_beside(const std::filesystem::path& file) {
  for (int i = 1;; ++i) {
    std::filesystem::path name = file.string() + ".broken-" + std::to_string(i);
    std::error_code unknown;  // whoever writes it says why not
    if (!std::filesystem::exists(name, unknown)) return name;
  }
}

tl::unexpected<result::Diagnostics> failed(const std::filesystem::path& file, const std::error_code& error) {
  return result::fail(storage::kFileFails, {file.string(), 0, 0}, "the audit trail: " + error.message());
}

}  // namespace

result::Result<std::unique_ptr<AuditLog>> AuditLog::open(const std::filesystem::path& file, WallClock clock,
                                                         const AuditLimits& limits) {
  if (auto made = files::make_private_folder(file.parent_path(), storage::kPrivateFile); !made)
    return result::forward(made);
  std::unique_ptr<AuditLog> log(new AuditLog(file, std::move(clock), limits));
  auto found = log->go_on();
  if (!found) return result::forward(found);
  auto descriptor = files::open_for_append(file, storage::kPrivateFile);
  if (!descriptor) return result::forward(descriptor);
  log->descriptor_ = std::move(*descriptor);
  log->found_ = *found;
  if (!found->empty()) {
    auto told = log->append({.action = "audit.opened", .target = file.filename().string(), .result = *found});
    if (!told) return result::forward(told);
  }
  log->writer_ = std::jthread([self = log.get()](const std::stop_token& stop) { self->write_waiting(stop); });
  return log;
}

result::Result<std::string> AuditLog::go_on() {
  head_ = first_hash();
  std::vector<Segment> segments = segments_of(file_);
  const bool grows = !segments.empty() && segments.back().file == file_;
  const Segment growing = grows ? segments.back() : Segment{};
  if (grows) segments.pop_back();
  std::optional<ChainStart> start;
  if (!segments.empty()) {
    auto end = check_end(segments.back().file, kEndBytes);
    if (!end) return result::forward(end);
    start = ChainStart{end->entries, end->head};
    sequence_ = end->entries;
    head_ = end->head;
  }
  first_ = sequence_ + 1;
  if (!grows || growing.bytes == 0) return std::string();
  auto check = check_end(file_, kEndBytes, start ? &*start : nullptr);
  if (!check) return result::forward(check);
  std::error_code error;
  if (check->broken_line > 0 && !check->torn) {
    const std::filesystem::path aside = free_name_beside(file_);
    std::filesystem::rename(file_, aside, error);
    if (error) return failed(file_, error);
    return "line " + std::to_string(check->broken_line) + " was wrong (" + check->why + "); moved to " +
           aside.filename().string();
  }
  if (check->torn) std::filesystem::resize_file(file_, check->right_bytes, error);
  if (error) return failed(file_, error);
  sequence_ = check->entries;
  head_ = check->head;
  bytes_ = check->right_bytes;
  if (growing.first > 0) first_ = growing.first;
  return check->torn ? "a line that a crash had left half written was cut off" : std::string();
}

AuditLog::~AuditLog() {
  writer_ = {};  // stopped and joined
  while (write_first_waiting()) {
  }
}

result::Result<void> AuditLog::append(const AuditEntry& entry) {
  const std::lock_guard lock(mutex_);
  return append_at(entry, clock_());
}

result::Result<void> AuditLog::append_at(const AuditEntry& entry,
                                         std::chrono::system_clock::time_point time) {
  const std::string at =
      utc_text(std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
  ChainLine line = chain_line(entry, sequence_ + 1, at, head_);
  if (bytes_ > 0 && bytes_ + line.text.size() > limits_.segment_bytes) {
    // A file that cannot be closed grows on: nothing is lost by that.
    if (close_segment()) remove_oldest(time);
    line = chain_line(entry, sequence_ + 1, at, head_);
  }
  if (auto written = files::append(descriptor_, file_, line.text, storage::kPrivateFile); !written)
    return written;
  ++sequence_;
  head_ = line.hash;
  bytes_ += line.text.size();
  return {};
}

result::Result<void> AuditLog::close_segment() {
  const std::filesystem::path closed = segment_name(file_, first_);
  std::error_code error;
  if (std::filesystem::exists(closed, error))
    return failed(closed, std::make_error_code(std::errc::file_exists));
  std::filesystem::rename(file_, closed, error);
  if (error) return failed(closed, error);
  auto fresh = files::open_for_append(file_, storage::kPrivateFile);
  if (!fresh) {
    std::filesystem::rename(closed, file_, error);
    return result::forward(fresh);
  }
  descriptor_ = std::move(*fresh);
  bytes_ = 0;
  first_ = sequence_ + 1;
  return files::sync_folder_of(file_, storage::kPrivateFile);
}

void AuditLog::remove_oldest(std::chrono::system_clock::time_point time) {
  std::vector<Segment> segments = segments_of(file_);
  std::uint64_t all = 0;
  for (const Segment& each : segments) all += each.bytes;
  std::size_t gone = 0;
  // The one that grows is the last.
  while (gone + 2 < segments.size() && all > limits_.most_bytes) {
    if (!files::remove_file(segments[gone].file, storage::kPrivateFile)) break;
    all -= segments[gone++].bytes;
  }
  if (gone == 0) return;
  const std::string which =
      "entries " + std::to_string(segments[0].first) + " to " + std::to_string(segments[gone].first - 1);
  // Without it the trail begins later all the same, which a check shows.
  static_cast<void>(append_at({.action = "audit.trimmed", .target = which, .result = "done"}, time));
}

void AuditLog::append_later(AuditEntry entry) {
  const std::lock_guard lock(waiting_mutex_);
  if (waiting_.size() < kMostWaiting)
    waiting_.push_back({std::move(entry), clock_()});
  else
    ++left_out_;
  waits_.notify_one();
}

void AuditLog::settle() {
  std::unique_lock lock(waiting_mutex_);
  const std::uint64_t before = failures_;
  settled_.wait(lock, [&] { return waiting_.empty() || failures_ > before; });
}

// False: nothing waits, or it cannot be written.
bool AuditLog::write_first_waiting() {
  Waiting first;
  {
    const std::lock_guard lock(waiting_mutex_);
    if (waiting_.empty()) return false;
    first = waiting_.front();
    if (left_out_ > 0 && waiting_.size() == 1)
      first.entry.result += " (" + std::to_string(left_out_) + " more were not kept)";
  }
  bool written = false;
  {
    const std::lock_guard lock(mutex_);
    written = append_at(first.entry, first.time).has_value();
  }
  const std::lock_guard lock(waiting_mutex_);
  if (written)
    waiting_.pop_front();
  else
    ++failures_;
  if (waiting_.empty()) left_out_ = 0;
  settled_.notify_all();
  return written;
}

void AuditLog::write_waiting(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(waiting_mutex_);
      if (!waits_.wait(lock, stop, [&] { return !waiting_.empty(); })) return;
    }
    while (!stop.stop_requested() && write_first_waiting()) {
    }
    std::unique_lock lock(waiting_mutex_);
    if (!waiting_.empty()) waits_.wait_for(lock, stop, kBetweenTries, [] { return false; });
  }
}

std::uint64_t AuditLog::entries() const {
  const std::lock_guard lock(mutex_);
  return sequence_;
}

std::string AuditLog::head() const {
  const std::lock_guard lock(mutex_);
  return head_;
}

}  // namespace stepwright::access
