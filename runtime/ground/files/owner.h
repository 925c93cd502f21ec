#pragma once

// Whose a file is, for what is said when it cannot be read or written. Plain values; any thread.

#include <filesystem>

#include "runtime/ground/result/result.h"

namespace stepwright::files {

struct Owner {
  const char* code;  // of whatever fails
  const char* hint = "";
};

// The owner's code with the path, what does not work and what the system says (an errno).
tl::unexpected<result::Diagnostics> failed(const Owner& owner, const std::filesystem::path& path,
                                           const char* what, int error);

}  // namespace stepwright::files
