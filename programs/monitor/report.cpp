#include "programs/monitor/report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/trace/value_json.h"

namespace stepwright::monitor {

result::Result<std::vector<trace::AskedName>> all_names(const std::vector<std::string>& names,
                                                        const std::string& list_file) {
  std::vector<trace::AskedName> asked = trace::asked(names);
  if (list_file.empty()) return asked;
  auto listed = trace::read_names(list_file);
  if (!listed) return result::forward(listed);
  asked.insert(asked.end(), listed->begin(), listed->end());
  return asked;
}

int finish(const std::string& json_file, const nlohmann::json& report) {
  if (!json_file.empty()) {
    const auto failed = files::write_file(json_file, report.dump(2) + "\n");
    if (!failed.empty()) return process::fail(failed, result::ExitCode::BadInput);
  }
  return to_int(result::ExitCode::Done);
}

std::string moment(std::uint64_t scan, std::int64_t time_ns) {
  char text[64];
  std::snprintf(text, sizeof text, "scan %llu, %.3f s", static_cast<unsigned long long>(scan),
                static_cast<double>(time_ns) / 1e9);
  return text;
}

nlohmann::json sample_json(const host::Snapshot& snapshot,
                           const std::vector<reader::NamedVariable>& variables) {
  nlohmann::json values = nlohmann::json::object();
  for (const reader::NamedVariable& variable : variables) {
    values[variable.name] = trace::to_json(reader::read_value(variable.variable, snapshot.image));
  }
  return {{"scan", snapshot.scan},
          {"time_s", static_cast<double>(snapshot.time_ns) / 1e9},
          {"values", std::move(values)}};
}

}  // namespace stepwright::monitor
