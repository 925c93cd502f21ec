#pragma once

// Diagnostics as the reports of the commands (--json) hold them.

#include <nlohmann/json_fwd.hpp>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::process {

// A list of {file, line, column, code, severity, message, hint}.
nlohmann::json diagnostics_json(const result::Diagnostics& diagnostics);

}  // namespace stepwright::process
