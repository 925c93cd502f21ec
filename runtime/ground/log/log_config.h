#pragma once

// [log] of a cell: how its processes report what they do while they run.
//
//   [log]
//   format = "json"        # one object per line; "text" is for people
//   level = "info"         # "debug", "info", "warning", "error"
//   file = "cell.log"      # of all processes of the cell, from the folder of the configuration; else stderr
//   max_mb = 16            # then it is renamed to cell.log.1, and that to cell.log.2; 0: it has no limit
//   keep = 4               # so many older ones are kept
//   limit_per_s = 10       # lines of one kind in a second; how many more there were is said afterwards
//
// Plain values. What is wrong takes its default and is reported by the document (C0002 to C0006).

#include <cstdint>
#include <filesystem>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::log {

enum class LogFormat : std::uint8_t { Text, Json };
enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

struct LogConfig {
  LogFormat format = LogFormat::Text;
  LogLevel level = LogLevel::Info;
  std::filesystem::path file;      // empty: standard error
  std::uint32_t max_mb = 16;       // of the file; 0: any size
  std::uint32_t keep = 4;          // older files beside it
  std::uint32_t limit_per_s = 10;  // lines of one kind per second
  result::Location where;          // of `file`, for diagnostics
};

// `folder` is that of the configuration.
LogConfig read_log(const settings::TomlTable& root, const std::filesystem::path& folder);

}  // namespace stepwright::log
