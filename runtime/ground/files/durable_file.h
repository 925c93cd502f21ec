#pragma once

// Files that survive a crash whole: what is at the path is the old content or the new one, never a part, and
// what was reported as written is there after a power cut. Only their owner reads them (mode 0600).
//
//   constexpr files::Owner kBoot{"R0024"};
//   auto written = replace_file(folder / "boot.swb", bytes, kBoot);  // not written: the old one is there
//
// Threads: any, one for a file; waits for the disk, and so is not for a scan thread.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/files/descriptor.h"
#include "runtime/ground/files/owner.h"
#include "runtime/ground/result/result.h"

namespace stepwright::files {

// Writes beside the path (".new"), waits for the disk, moves it there, waits for the folder.
[[nodiscard]] result::Result<void> replace_file(const std::filesystem::path& path,
                                                std::span<const std::byte> bytes, const Owner& owner);
[[nodiscard]] result::Result<void> replace_file(const std::filesystem::path& path, std::string_view text,
                                                const Owner& owner);
// Gone for good when it returns; false: there was none.
[[nodiscard]] result::Result<bool> remove_file(const std::filesystem::path& path, const Owner& owner);
// Makes the folder with mode 0700 if it is not there.
[[nodiscard]] result::Result<void> make_private_folder(const std::filesystem::path& folder,
                                                       const Owner& owner);
// That a file has come, gone or has another name is on the disk.
[[nodiscard]] result::Result<void> sync_folder_of(const std::filesystem::path& file, const Owner& owner);

// Opened for appending, made if it is not there.
[[nodiscard]] result::Result<Descriptor> open_for_append(const std::filesystem::path& path,
                                                         const Owner& owner);
// All bytes, and then waits for the disk. What was written of a text that failed is cut off again.
[[nodiscard]] result::Result<void> append(const Descriptor& file, const std::filesystem::path& path,
                                          std::string_view text, const Owner& owner);

// The whole file; nothing if there is none. Fails if it cannot be read, is no plain file or has more than
// `most` bytes.
[[nodiscard]] result::Result<std::optional<std::vector<std::byte>>> read_bytes(
    const std::filesystem::path& path, std::size_t most, const Owner& owner);
[[nodiscard]] result::Result<std::optional<std::string>> read_text(const std::filesystem::path& path,
                                                                   std::size_t most, const Owner& owner);
// At most one byte more than `most`: a file that grows meanwhile does not fill the memory. Nothing: it cannot
// be read.
std::optional<std::string> read_bounded(const std::filesystem::path& file, std::size_t most);

// The bytes to this place of an open file, whatever the system takes at once; the error, or 0.
int write_at(int descriptor, std::span<const std::byte> bytes, std::size_t offset);

}  // namespace stepwright::files
