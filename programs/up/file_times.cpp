#include "programs/up/file_times.h"

#include <system_error>
#include <utility>

namespace stepwright::up {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{200};

}  // namespace

FileTimes::FileTimes(std::vector<std::filesystem::path> files)
    : files_(std::move(files)), told_(times()), newest_(told_) {}

FileTimes::Times FileTimes::times() const {
  Times found;
  for (const std::filesystem::path& file : files_) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    found[file] = error ? std::nullopt : std::optional(time);
  }
  return found;
}

FileTimes::News FileTimes::look() {
  News news;
  if (Clock::now() < look_at_) return news;
  look_at_ = Clock::now() + kBetweenLooks;
  Times now = times();
  if (now == newest_ && now != told_) {
    for (const auto& [file, time] : now)
      if (time != told_[file]) (time ? news.saved : news.gone).push_back(file);
    told_ = now;
  }
  newest_ = std::move(now);
  return news;
}

}  // namespace stepwright::up
