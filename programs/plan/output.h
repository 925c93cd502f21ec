#pragma once

// Output of `plan` and `validate`: diagnostics, files, JSON values. Threads: one.

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::plan {

// One diagnostic per line on stderr.
void print_diagnostics(const result::Diagnostics& diagnostics);

// False after saying on stderr why the file could not be written.
bool write_file(const std::string& path, const std::string& text);

// False after saying on stderr which of these files cannot be written; empty names are none.
bool check_writable(const std::vector<std::string>& paths);

// JSON has no kInfinity: null.
nlohmann::json number(double value);

}  // namespace stepwright::plan
