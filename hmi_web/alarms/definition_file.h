#pragma once

// Alarm definitions from TOML: [[alarm]] tables of a file of their own or of a cell's configuration
// (hmi_web/doc/alarms.md has every key).
//
//   auto definitions = load_alarms("alarms.toml");
//
// Every problem is told at once, with line, column and key: C0001 to C0006 as in every TOML file; C0601 a
// name twice, C0602 a key that this kind of condition needs is missing, C0603 a key that it
// does not use or that another one excludes.
//
// Pure functions.

#include <filesystem>
#include <vector>

#include "hmi_web/alarms/definition.h"
#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::alarms {

// Problems go into the document of the table.
std::vector<AlarmDefinition> read_alarms(const settings::TomlTable& root);

[[nodiscard]] result::Result<std::vector<AlarmDefinition>> load_alarms(const std::filesystem::path& file);

}  // namespace stepwright::alarms
