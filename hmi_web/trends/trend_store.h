#pragma once

// The saved groups of trends of a cell, in one file that is written whole before a change is confirmed.
//
//   auto store = TrendStore::open("cell-state/access/trends.json");
//   (*store)->save(group);
//   for (const TrendGroup& each : (*store)->list()) ...
//
// Threads: every function from any. A file that cannot be read as groups is put aside as FILE.damaged, and
// the store begins without any (found_at_start).
//
// Diagnostics: H0021 the disk, H0081 no such group, H0082 what cannot be one, H0083 too many.

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hmi_web/trends/trend_group.h"
#include "runtime/ground/result/result.h"

namespace stepwright::trends {

inline constexpr std::size_t kMostGroups = 200;

class TrendStore {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<TrendStore>> open(std::filesystem::path file);

  // By name.
  std::vector<TrendGroup> list() const;
  // In place of the one of that name, which it returns.
  [[nodiscard]] result::Result<std::optional<TrendGroup>> save(const TrendGroup& group);
  [[nodiscard]] result::Result<TrendGroup> remove(const std::string& name);
  // For the log; empty: nothing.
  const std::string& found_at_start() const { return found_; }

 private:
  explicit TrendStore(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] result::Result<void> write(const std::vector<TrendGroup>& groups) const;

  const std::filesystem::path file_;
  std::string found_;
  mutable std::mutex mutex_;
  std::vector<TrendGroup> groups_;  // guarded by mutex_; by name
};

}  // namespace stepwright::trends
