#pragma once

// The file of an executive's journal, replaced as a whole and on the disk before it counts, so that whoever
// reads it finds the old one or the new one, after a power cut as well. Its contents belong to journal.h and
// the fleet's journal.
//
// One thread for one file.

#include <filesystem>
#include <optional>
#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::run {

// X0004: the file cannot be written; the one before it is still there.
[[nodiscard]] result::Result<void> replace_journal_file(const std::filesystem::path& file,
                                                        const std::string& text);
// Nothing if there is no file. X0004: there is one that cannot be read, which is no fresh start.
[[nodiscard]] result::Result<std::optional<std::string>> read_journal_file(const std::filesystem::path& file);

}  // namespace stepwright::run
