#pragma once

// Journal of a train's run, from which a restarted supervisor goes on: its task, how far the monitor had
// come, what stands on the floor. The file is not trusted.
//
// Threads: any; both functions wait for the disk.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/run/journal.h"

namespace stepwright::ltl {

struct TrainJournal : run::Journal {
  std::string task;
  std::string watched;  // by the program that runs: another one where a task has been asked for since
  std::uint32_t state = 0;
  std::vector<Area> blocked;
};

// Fails with X0004.
[[nodiscard]] result::Result<void> write_train_journal(const std::filesystem::path& file,
                                                       const TrainJournal& journal);
// Nothing if there is no file; X0001 if there is one that is no such journal.
[[nodiscard]] result::Result<std::optional<TrainJournal>> read_train_journal(
    const std::filesystem::path& file);

}  // namespace stepwright::ltl
