#pragma once

// Files that commands read and write whole. What they write to the name "-" goes to standard output.
//
// What is read is a regular file with an end: a pipe or a device may have none, or nobody who writes to it,
// and a file that is larger than what was meant must not take all of the memory.

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "runtime/ground/files/owner.h"
#include "runtime/ground/result/result.h"

namespace stepwright::files {

inline constexpr std::uintmax_t kMostFileBytes = 256u << 20;

// E0001: it cannot be read, is no regular file, or has more than so many bytes.
[[nodiscard]] result::Result<std::string> read_file(const std::string& path,
                                                    std::uintmax_t most_bytes = kMostFileBytes);

// For files of any length, which are read piece by piece. E0001: it cannot be read, or is no regular file.
[[nodiscard]] result::Result<std::ifstream> open_file(const std::string& path);

// A device or a pipe: it takes bytes as they come and must not be replaced by a file. /dev/stdout is one even
// where it leads to a file, which others write to as well.
bool is_stream(const std::string& path);

// Written beside its place and moved there, so that nobody meets half a file. A device or a pipe is written
// to as it is, and a link stays a link. Returns E0002 or nothing.
[[nodiscard]] result::Diagnostics write_file(const std::string& path, std::string_view bytes);
// The same with the code and the hint of the file's owner.
[[nodiscard]] result::Result<void> write_file(const std::string& path, std::string_view bytes,
                                              const Owner& owner);

// Whether `write_file` may succeed, so that a long command fails before its work and not after it. Returns
// E0002 or nothing.
[[nodiscard]] result::Diagnostics check_writable(const std::string& path);

// ".xml" in any case: a PLCopen project.
bool is_xml(const std::string& path);

}  // namespace stepwright::files
