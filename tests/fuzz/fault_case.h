#pragma once

// The container that is being run: where it stops the process, its bytes are kept as a file.

#include <cstddef>
#include <span>
#include <string>

namespace stepwright::fuzz {

// From here on this is the case. `bytes` must stay where they are until the next call.
void name_case(const std::string& name, std::span<const std::byte> bytes);

// Writes its bytes into the working directory; the file's name.
const char* keep_case();

}  // namespace stepwright::fuzz
