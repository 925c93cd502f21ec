#pragma once

// Last lines that the processes of a plant have printed, for the message that tells why one was lost.
// Threads: any.

#include <filesystem>
#include <string>

namespace stepwright::campaign {

// The last lines of a file, eight at most and 2,000 bytes; control characters are blanks. Empty: there are
// none.
std::string last_lines(const std::filesystem::path& file);

}  // namespace stepwright::campaign
