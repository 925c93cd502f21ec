#pragma once

// [record] of a cell's configuration: a recording from the start of the runtime on. [history]: what the
// page's server keeps of the values of all scans that it sees, and of alarms.
//
//   [record]
//   file = "run.swrec"       # in the state folder, unless it is a whole path
//   max_mb = 100
//
//   [history]
//   folder = "history"       # in the state folder, unless it is a whole path; default: nothing is kept
//   days = 90                # older values and alarms go; 0: none do
//   max_mb = 4096            # the oldest values go beyond it; 0: none do
//   alarms = "alarms.toml"   # beside this file: alarms beyond those of every cell (hmi_web/doc/alarms.md)

#include <chrono>
#include <cstdint>
#include <filesystem>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

struct RecordConfig {
  std::filesystem::path file;            // empty: nothing is recorded until somebody asks
  std::uint64_t max_mb = 0;              // megabytes that are kept, the newest; 0: all
  std::uint32_t hash_every = 1;          // scans between two hashes
  std::uint32_t keyframe_every = 1'000;  // scans between two whole images; 0: none
  result::Location where;                // of `file`
};

struct HistoryConfig {
  std::filesystem::path folder;          // empty: nothing is kept
  std::chrono::hours most_age{90 * 24};  // 0: any
  std::uint64_t max_mb = 4'096;          // of values; 0: any
  std::filesystem::path alarms;          // empty: no others
};

// Errors are reported to the document of the table.
HistoryConfig read_history(const settings::TomlTable& table, const std::filesystem::path& folder,
                           const std::filesystem::path& state_dir);
RecordConfig read_record(const settings::TomlTable& table, const std::filesystem::path& state_dir);

}  // namespace stepwright::config
