#pragma once

// What the processes of a plant have printed last, for who asks why it was lost.

#include <filesystem>
#include <string>

namespace stepwright::campaign {

// The last lines of a file, eight at most and 2,000 bytes; control characters are blanks. Empty: there are
// none.
std::string last_lines(const std::filesystem::path& file);

}  // namespace stepwright::campaign
