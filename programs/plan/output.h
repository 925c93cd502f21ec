#pragma once

// What both commands write: diagnostics, files, JSON values.

#include <nlohmann/json_fwd.hpp>

#include <string>

#include "runtime/result/diagnostic.h"

namespace stepwright::plan {

// One diagnostic per line on stderr.
void print_diagnostics(const result::Diagnostics& diagnostics);

// False after saying on stderr why the file could not be written.
bool write_file(const std::string& path, const std::string& text);

// JSON has no kInfinity: null.
nlohmann::json number(double value);

}  // namespace stepwright::plan
