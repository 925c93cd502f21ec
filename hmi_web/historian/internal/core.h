#pragma once

// The parts of a historian and its writing thread.
//
// Thread rule: as Historian. `state_mutex_` guards the tags and the figures; the file belongs to the writing
// thread; connections that read are borrowed by one reader at a time.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "hmi_web/historian/historian.h"
#include "hmi_web/historian/history_file.h"
#include "hmi_web/historian/open_tags.h"
#include "hmi_web/historian/walk.h"
#include "hmi_web/storage/batch_queue.h"

namespace stepwright::historian {

class Historian::Core {
 public:
  Core(std::filesystem::path file, HistorianOptions options);
  ~Core();

  // Opens the file and starts the thread.
  [[nodiscard]] result::Result<void> start();
  [[nodiscard]] result::Result<void> flush();
  [[nodiscard]] result::Result<void> read(TagId tag, Visitor& visitor);
  HistorianStatus status() const;

  storage::BatchQueue<TagSample> queue;
  mutable std::mutex state_mutex;
  OpenTags tags;  // guarded by state_mutex
  std::atomic<std::int64_t> known_until_ns{std::numeric_limits<std::int64_t>::min()};

 private:
  using Clock = std::chrono::steady_clock;

  result::Result<void> open_file();
  result::Result<void> load(HistoryFile file);
  void run();
  // Whatever it throws is told as a failure.
  void step(const std::function<void()>& work);
  void write(std::span<const TagSample> batch, bool last);
  void note_failure(result::Diagnostics problems);
  void begin_new_file();
  bool reopen();
  void retain();
  result::Result<HistoryView> borrow(std::uint64_t& generation);
  void give_back(HistoryView view, std::uint64_t generation);

  const std::filesystem::path path_;
  const HistorianOptions options_;
  std::optional<HistoryFile> file_;  // of the writing thread
  std::size_t tail_bytes_ = 0;       // since the last checkpoint; of the writing thread
  bool checkpoint_due_ = false;
  Clock::time_point last_checkpoint_{}, last_retention_{};
  HistorianStatus figures_;       // guarded by state_mutex
  result::Diagnostics warnings_;  // guarded by state_mutex
  std::mutex view_mutex_;
  std::vector<HistoryView> views_;  // guarded by view_mutex_
  std::uint64_t generation_ = 0;    // of the file; guarded by view_mutex_
  std::thread thread_;              // last: it uses all of the above
};

}  // namespace stepwright::historian
