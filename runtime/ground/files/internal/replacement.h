#pragma once

// The one way in which a file comes to its place: it is written beside it and moved there.
//
// Threads: any, one for a file; waits for the disk.

#include <cstddef>
#include <filesystem>
#include <span>

namespace stepwright::files::internal {

struct Replacement {
  const char* beside;  // ending of the name that the file has until it is whole
  bool durable;        // mode 0600, on the disk with its name before the call returns; else as umask says
};

// The system's error, and 0 if the file is there. If it is not, what was there before is, and nothing beside.
int replace(const std::filesystem::path& path, std::span<const std::byte> bytes, const Replacement& how);

// That a file has come, gone or has another name is on the disk: the system's error, or 0.
int sync_folder_of(const std::filesystem::path& file);

}  // namespace stepwright::files::internal
