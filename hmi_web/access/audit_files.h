#pragma once

// The files of an audit trail: closed segments beside the one that grows. A segment is named after the number
// of its first entry ("audit-000000004711.jsonl"); the chain goes on from each to the next.
//
//   // The oldest first, the growing one last.
//   for (const Segment& each : segments_of(folder / "audit.jsonl")) ...
//   // The newest below 4711, whole lines.
//   const std::string page = lines_before(file, 4711, {200, 1 << 20});
//
// Reads no more than it is asked for, however long the trail is. Any thread; the growing file may grow
// meanwhile. Fails with H0021.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hmi_web/access/audit_chain.h"
#include "runtime/ground/result/result.h"

namespace stepwright::access {

struct Segment {
  std::filesystem::path file;
  std::uint64_t first = 0;  // number of its first entry; 0: of the growing one, if it is empty
  std::uintmax_t bytes = 0;
};

// `file`: the one that grows.
std::vector<Segment> segments_of(const std::filesystem::path& file);
// The name of a closed segment beside `file`.
std::filesystem::path segment_name(const std::filesystem::path& file, std::uint64_t first);

struct MostLines {
  std::size_t lines = 200;
  std::size_t bytes = std::size_t{1} << 20;  // as soon as one line is there
};
// Whole lines with numbers below `before` (0: from the newest on), in their order.
[[nodiscard]] result::Result<std::string> lines_before(const std::filesystem::path& file,
                                                       std::uint64_t before, const MostLines& most);

// Checks the end of a file, its last `bytes`; the chain before them is not checked.
[[nodiscard]] result::Result<ChainCheck> check_end(const std::filesystem::path& file, std::size_t bytes,
                                                   const ChainStart* start = nullptr);

struct TrailCheck {
  std::uint64_t first = 0;  // number of the first entry that is there; 0: there is none
  ChainCheck chain;
  std::filesystem::path file;  // in which the first wrong line is, and its number there, from 1
  std::uint64_t line = 0;
};
// Every line of `file`; of a growing file ("audit.jsonl") with all closed segments beside it.
[[nodiscard]] result::Result<TrailCheck> check_trail(const std::filesystem::path& file);

}  // namespace stepwright::access
