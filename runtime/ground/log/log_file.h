#pragma once

// Test for a file that a log may be appended to.
//
// Threads: any.

#include <filesystem>

namespace stepwright::log {

// A file that is empty, or begins as a line of a log does (line.h). Reads its first bytes. Requires a plain
// file; one that cannot be read is left to who opens it, and so counts as one.
bool is_log_or_empty(const std::filesystem::path& file);

}  // namespace stepwright::log
