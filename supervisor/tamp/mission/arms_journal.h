#pragma once

// Journal of a run of arms, from which a restarted supervisor goes on: its order, where things were believed
// to be, what hands held. The file is not trusted.
//
// Threads: any; both functions wait for the disk.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/run/journal.h"
#include "supervisor/tamp/scene/upright.h"

namespace stepwright::tamp::mission {

struct ArmsJournal : run::Journal {
  std::string order;                            // its name, or its goal
  std::map<std::string, scene::Pose> believed;  // of each thing
  std::map<std::string, std::string> held;      // by each arm that holds something
  std::map<std::string, int> tries;             // that failed, of each thing
  std::uint32_t looks = 0;                      // programs that have looked
};

// Fails with X0004.
[[nodiscard]] result::Result<void> write_arms_journal(const std::filesystem::path& file,
                                                      const ArmsJournal& journal);
// Nothing if there is no file; X0001 if there is one that is no such journal.
[[nodiscard]] result::Result<std::optional<ArmsJournal>> read_arms_journal(const std::filesystem::path& file);

}  // namespace stepwright::tamp::mission
