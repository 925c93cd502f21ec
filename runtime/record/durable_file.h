#pragma once

// Files that survive a crash whole: what is at the path is the old content or the new one, never a part, and
// what was reported as written is there after a power cut.
//
// Threads: any; waits for the disk, and so is not for a scan thread.
//
//   if (auto written = replace_file(folder / "boot.swb", bytes); !written) ...   // the old one is there

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::record {

// Writes beside the path, waits for the disk, moves it there, waits for the folder. Fails with R0024.
[[nodiscard]] result::Result<void> replace_file(const std::filesystem::path& path,
                                                std::span<const std::byte> bytes);

// The whole file; nothing if there is none. Fails with R0024 if it cannot be read, is no plain file or has
// more than `most` bytes.
[[nodiscard]] result::Result<std::optional<std::vector<std::byte>>> read_whole(
    const std::filesystem::path& path, std::size_t most);

// The bytes to this place of an open file, whatever the system takes at once; the error, or 0.
int write_at(int descriptor, std::span<const std::byte> bytes, std::size_t offset);

// R0024 with the path and what the system says.
tl::unexpected<result::Diagnostics> file_error(const std::filesystem::path& path, const char* what,
                                               int error);

}  // namespace stepwright::record
