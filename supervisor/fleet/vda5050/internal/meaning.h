#pragma once

// Checks of members of a message against each other (F0904). Pure functions; any thread.

#include <nlohmann/json_fwd.hpp>

#include "supervisor/fleet/vda5050/internal/rule.h"

namespace stepwright::fleet::vda5050 {

// Requires a message that its table accepts.
void apply_meaning(Topic topic, const nlohmann::json& root, Findings& findings);

}  // namespace stepwright::fleet::vda5050
