#pragma once

// Of which alarms each channel has told, kept over restarts of the page's server: whoever is told once is not
// told again of the same occurrence.
//
//   ToldStore told(folder / "notified.json");
//   told.keep("shift", {{"runtime.lost", raised_ns}});
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

// Alarms and when they were raised: that is the occurrence.
using ToldAlarms = std::map<std::string, std::int64_t, std::less<>>;

class ToldStore {
 public:
  // A file that is not there, or cannot be read as what this class writes, holds nothing: its alarms are told
  // again.
  explicit ToldStore(std::filesystem::path file);

  ToldAlarms of(const std::string& channel) const;
  // In place of what the channel had. Fails with H0021 and the reason.
  [[nodiscard]] result::Result<void> keep(const std::string& channel, ToldAlarms alarms);

 private:
  const std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::map<std::string, ToldAlarms> channels_;
};

}  // namespace stepwright::notify
