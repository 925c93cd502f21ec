#pragma once

// Reports of the commands of a monitor: the parts that they share. Threads: one.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/host/messages.h"
#include "runtime/trace/names.h"

namespace stepwright::monitor {

// The names of a command line and of its list.
[[nodiscard]] result::Result<std::vector<trace::AskedName>> all_names(const std::vector<std::string>& names,
                                                                      const std::string& list_file);

// Writes the report if a file is named. Returns the exit code.
int finish(const std::string& json_file, const nlohmann::json& report);

// "scan 120, 1.190 s"
std::string moment(std::uint64_t scan, std::int64_t time_ns);

// {scan, time_s, values: {name: value}}
nlohmann::json sample_json(const host::Snapshot& snapshot,
                           const std::vector<reader::NamedVariable>& variables);

}  // namespace stepwright::monitor
