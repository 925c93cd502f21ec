#pragma once

// Place of a runtime, in one text that no other machine and no other folder has by accident.
//
// Threads: any.

#include <filesystem>
#include <string>

namespace stepwright::config {

// "HOST-ID:FOLDER"; the id is a part of /etc/machine-id and missing where there is none.
std::string place_of(const std::filesystem::path& state_dir);

}  // namespace stepwright::config
