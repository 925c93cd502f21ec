#include "programs/up/cell_lock.h"

#include <chrono>
#include <thread>

#include "hmi_web/storage/codes.h"

namespace stepwright::up {
namespace {

using std::chrono::milliseconds;

// Somebody who only looks has the lock for a moment.
constexpr int kTries = 10;
constexpr milliseconds kBetween{20};

std::filesystem::path lock_path(const config::CellConfig& config) {
  return config.state_dir / "up";
}

}  // namespace

result::Result<storage::FileLock> take_cell(const config::CellConfig& config) {
  auto lock = storage::FileLock::take(lock_path(config));
  for (int i = 1; !lock && storage::is_in_use(lock.error()) && i < kTries; ++i) {
    std::this_thread::sleep_for(kBetween);
    lock = storage::FileLock::take(lock_path(config));
  }
  if (lock || !storage::is_in_use(lock.error())) return lock;
  std::string who;
  if (const auto record = processes::read_record(processes::record_path(config))) {
    if (auto same = processes::check_same_cell(*record, config); !same) return result::forward(same);
    who = ": process " + std::to_string(record->pid) +
          (record->address.empty() ? "" : ", page " + record->address);
  }
  return result::fail("M0013", {config.file.string(), 0, 0},
                      "the cell '" + config.name + "' is up already" + who,
                      "`stepwright status " + config.file.string() + "` shows it, `stepwright down " +
                          config.file.string() + "` ends it");
}

result::Result<std::optional<processes::CellRecord>> find_cell(const config::CellConfig& config) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(config.state_dir, ignored)) return std::nullopt;
  const auto lock = storage::FileLock::take(lock_path(config));
  if (lock) return std::nullopt;
  if (!storage::is_in_use(lock.error())) return tl::unexpected(lock.error());
  auto record = processes::read_record(processes::record_path(config));
  if (!record) return result::forward(record);
  if (auto same = processes::check_same_cell(*record, config); !same) return result::forward(same);
  return std::move(*record);
}

}  // namespace stepwright::up
