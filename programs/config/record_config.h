#pragma once

// [record] of a cell's configuration: a recording from the start of the runtime on.
//
//   [record]
//   file = "run.swrec"       # in the state folder, unless it is a whole path
//   max_mb = 100

#include <cstdint>
#include <filesystem>

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

struct RecordConfig {
  std::filesystem::path file;            // empty: nothing is recorded until somebody asks
  std::uint64_t max_mb = 0;              // megabytes that are kept, the newest; 0: all
  std::uint32_t hash_every = 1;          // scans between two hashes
  std::uint32_t keyframe_every = 1'000;  // scans between two whole images; 0: none
};

// What is wrong goes to the document of the table.
RecordConfig read_record(const settings::TomlTable& table, const std::filesystem::path& state_dir);

}  // namespace stepwright::config
