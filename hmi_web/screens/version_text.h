#pragma once

// The file that says of a version who saved it, when and why: JSON beside its SVG. Pure; any thread.

#include <string>
#include <string_view>

#include "hmi_web/screens/screen.h"
#include "runtime/ground/result/result.h"

namespace stepwright::screens {

std::string to_json(const Version& version);
// Fails with H0124 for anything that `to_json` would not write; `file` stands in the diagnostic.
[[nodiscard]] result::Result<Version> version_from_json(std::string_view text, const std::string& file);

}  // namespace stepwright::screens
