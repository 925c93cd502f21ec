#pragma once

// Checks the memory of a program before it is prepared. The system ends a process that passes its limit, with
// its outputs on; a refused download changes nothing.
//
// Threads: any. What is free is what the tightest limit leaves: the one of the configuration, those of the
// control groups that the process is in (systemd's MemoryMax=), RLIMIT_AS and RLIMIT_DATA, and
// RLIMIT_MEMLOCK where memory is locked.
//
//   if (auto room = check_memory(need, config.memory_limit_bytes); !room) ...     // R0076 with both figures

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::host {

// Memory that a program takes while it is prepared and when it runs, beside its container.
struct MemoryNeed {
  std::size_t code_bytes = 0;   // of bytecode
  std::size_t image_bytes = 0;  // with the frames
  std::size_t threads = 1;      // that run its tasks
  bool native = true;
};

// The most that it takes at any instant. Measured, not derived: an upper bound with something to spare.
std::uint64_t needed_bytes(const MemoryNeed& need);

struct MemoryLimit {
  std::uint64_t limit_bytes = 0;
  std::uint64_t free_bytes = 0;
  std::string what;  // whose limit it is
};

// Where the system says how it stands; tests have files of their own.
struct MemorySources {
  std::filesystem::path process = "/proc/self";
  std::filesystem::path groups = "/sys/fs/cgroup";
};

// The tightest limit; none: nothing limits the process. `own_limit_bytes` 0: no limit of its own.
std::optional<MemoryLimit> memory_limit(std::size_t own_limit_bytes, const MemorySources& sources = {});

// Fails with R0076.
[[nodiscard]] result::Result<void> check_memory(const MemoryNeed& need, std::size_t own_limit_bytes,
                                                const MemorySources& sources = {});

}  // namespace stepwright::host
