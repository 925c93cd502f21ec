#pragma once

// Store of notifications: of which alarms each channel has told, and when, kept over restarts of the page's
// server: a restart is no reason to tell again of the same occurrence.
//
//   NotificationStore told(folder / "notified.json");
//   told.keep("shift", {{"runtime.lost", {raised_ns, told_ms}}});
//
// Threads: every function from any. keep() waits for the disk.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::notify {

struct Notification {
  std::int64_t raised_ns = 0;  // which occurrence, on the history's clock
  std::int64_t told_ms = 0;    // when it was told of last, since 1970

  friend bool operator==(const Notification&, const Notification&) = default;
};
using Notifications = std::map<std::string, Notification, std::less<>>;

class NotificationStore {
 public:
  // A file that is not there, or cannot be read as what this class writes, holds nothing: its alarms are told
  // again.
  explicit NotificationStore(std::filesystem::path file);

  Notifications of(const std::string& channel) const;
  // In place of what the channel had. Fails with H0021 and the reason.
  [[nodiscard]] result::Result<void> keep(const std::string& channel, Notifications alarms);

 private:
  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::map<std::string, Notifications> channels_;
};

}  // namespace stepwright::notify
