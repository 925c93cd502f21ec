#pragma once

// Changes of some files since the last look: which were saved, and which are gone.
//
//   FileTimes times({"main.st"});
//   for (const auto& file : times.look().saved) ...        // often
//
// A file counts once nothing of them has changed from one look to the next: it may be half written, or be
// missing for a moment while an editor replaces it.
//
// Threads: one. Nothing blocks.

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace stepwright::up {

class FileTimes {
 public:
  struct News {
    std::vector<std::filesystem::path> saved;  // also those that are there again
    std::vector<std::filesystem::path> gone;   // each is told once
  };

  explicit FileTimes(std::vector<std::filesystem::path> files);

  // Looks a few times a second, however often it is called.
  News look();

 private:
  using Clock = std::chrono::steady_clock;
  using Times = std::map<std::filesystem::path, std::optional<std::filesystem::file_time_type>>;

  Times times() const;

  const std::vector<std::filesystem::path> files_;
  Times told_;
  Times newest_;
  Clock::time_point look_at_{};
};

}  // namespace stepwright::up
