#pragma once

// Test for a file that a compiled program may replace.
//
// Threads: any.

#include <filesystem>

namespace stepwright::reader {

// A file that is empty, or begins as a compiled program does. Reads its first bytes. Requires a plain file.
bool is_container_or_empty(const std::filesystem::path& file);

}  // namespace stepwright::reader
