#pragma once

// The values of tags over months: appended by anybody, compressed, kept in one SQLite file, and read back as
// they were, as the extremes of a chart's columns, or as CSV. hmi_web/doc/historian.md says what is kept,
// what a crash costs and how fast it is.
//
//   auto historian = Historian::open("state/history.db");
//   const TagId level = *(*historian)->tag("main.level");
//   (*historian)->append(level, {scan_time_ns, 12.5});
//   auto trend = (*historian)->trend(level, {from_ns, to_ns}, 2000);    // 30 days in well below 100 ms
//
// Thread rule: everything from any thread. append() never waits for a disk or for a reader: it takes a lock
// for as long as a copy lasts. One thread of the historian's own writes, in batches; what was not in a batch
// yet is what the end of the process (kill -9) costs. No failure of the file stops the caller: it stands in
// status() and is tried again.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_web/historian/sample.h"
#include "hmi_web/historian/summary.h"
#include "hmi_web/historian/suppression.h"
#include "runtime/ground/result/result.h"

namespace stepwright::historian {

struct HistorianOptions {
  std::chrono::milliseconds commit_period{1'000};  // the longest time from append() to the file
  std::size_t batch_samples = 100'000;             // so many are written earlier
  std::size_t most_queued_samples = 2'000'000;     // beyond: dropped and counted
  std::size_t most_waiting_bytes = 64 << 20;       // full blocks that wait for a disk that takes none
  std::chrono::hours most_age{0};                  // older samples go; 0: none do
  std::uint64_t most_bytes = 4ULL << 30;           // the oldest samples go beyond it; 0: none do
  std::uint64_t largest_file_bytes = 0;            // writing fails beyond it (S0003); 0: the disk decides
  bool durable = false;  // a commit waits for the disk, so that a power failure costs one period at most
  bool replace_damaged = true;  // a damaged file is put aside as FILE.damaged-N, and a new one begun
  // The clock of the samples' times, for `most_age`; empty: real time.
  std::function<std::int64_t()> now_ns{};
};

// Both ends belong to it.
struct Window {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

// Samples that are lost because their block is damaged; times are 0 where even they are.
struct Damage {
  std::uint64_t samples = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
};

struct Range {
  std::vector<Sample> samples;   // in ascending time
  std::optional<Sample> before;  // the newest one before the window: the value that it begins with
  bool truncated = false;        // there are more than were asked for
  std::vector<Damage> damage;
};

struct Trend {
  std::int64_t bucket_ns = 0;    // bucket i is [from + i * bucket_ns, from + (i + 1) * bucket_ns)
  std::vector<Summary> buckets;  // count 0: no sample falls into it, the value before still holds
  std::optional<Sample> before;
  std::vector<Damage> damage;
};

struct HistorianStatus {
  std::uint64_t appended = 0;  // samples handed over, and times of note_until
  std::uint64_t dropped = 0;   // of them: the queue was full, or their tag is unknown
  std::uint64_t kept = 0;      // after suppression
  std::uint64_t lost = 0;      // kept, but the file took them not in time, or was damaged
  std::uint64_t commits = 0;
  std::uint64_t file_bytes = 0;  // in use, at the last commit
  bool failing = false;          // the last write failed
  result::Diagnostics problems;  // of that write; and warnings of damage since the start
};

class Historian {
 public:
  // Takes the file for writing, makes it if there is none. Fails with S0001 to S0008 (storage/database.h).
  [[nodiscard]] static result::Result<std::unique_ptr<Historian>> open(const std::filesystem::path& file,
                                                                       HistorianOptions options = {});
  // Writes what is left; the next open finds everything.
  ~Historian();
  Historian(const Historian&) = delete;
  Historian& operator=(const Historian&) = delete;

  // The tag of this name; a new one if the file has none. The settings hold from its next sample on. Fails
  // with S0012 for an empty name or one of more than 255 bytes, or for wrong settings.
  [[nodiscard]] result::Result<TagId> tag(const std::string& name, const SuppressionSettings& settings = {});
  std::optional<TagId> find(const std::string& name) const;
  std::vector<std::string> names() const;

  void append(TagId tag, const Sample& sample);
  void append(std::span<const TagSample> samples);
  // Everything up to this time is appended: tags of which nothing came have the value that they had.
  void note_until(std::int64_t time_ns);
  // The newest such time of which readers see all that was appended before; INT64_MIN: none yet.
  std::int64_t known_until_ns() const;

  // Waits until everything appended before is in the file, or has failed to get there.
  [[nodiscard]] result::Result<void> flush();

  // Readers see what the writer has taken from the queue: everything but the last `commit_period`. Fail with
  // S0013 for a tag that is unknown, S0014 for a window that ends before it begins or no buckets, and as
  // open() does.
  [[nodiscard]] result::Result<Range> range(TagId tag, Window window, std::size_t most = 100'000) const;
  // The exact extremes, first and last of each of at most `buckets` equal parts of the window.
  [[nodiscard]] result::Result<Trend> trend(TagId tag, Window window, std::size_t buckets) const;
  // tag,time,value,quality with a line of names, tag after tag, times as ISO 8601 in UTC; in pieces, until
  // the sink gives false. The samples of damaged blocks are left out, and given.
  using Sink = std::function<bool(std::string_view)>;
  [[nodiscard]] result::Result<std::vector<Damage>> export_csv(std::span<const TagId> tags, Window window,
                                                               const Sink& sink) const;

  HistorianStatus status() const;

 private:
  class Core;
  explicit Historian(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace stepwright::historian
