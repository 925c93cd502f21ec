#pragma once

// Names of variables as commands take them: on the command line between commas, and in files, one a line.
// Pure functions but for reading the file; any thread.

#include <string>
#include <string_view>
#include <vector>

#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/ground/result/result.h"

namespace stepwright::trace {

struct AskedName {
  std::string name;
  result::Location where;  // in the file that it was read from
};

// Names between commas; a comma between brackets belongs to the name ("a[1,2],b").
std::vector<std::string> split_names(std::string_view list);

// A name a line; empty lines and what follows a `#` or `//` are left out. Fails with E0001.
[[nodiscard]] result::Result<std::vector<AskedName>> read_names(const std::string& file);

// Every value of every name (all of an array or a structure), or the diagnostics of all that are wrong.
[[nodiscard]] result::Result<std::vector<reader::NamedVariable>> resolve_names(
    const reader::ProgramInfo& info, const std::vector<AskedName>& names, const char* code = "R0057");

std::vector<AskedName> asked(const std::vector<std::string>& names);

}  // namespace stepwright::trace
