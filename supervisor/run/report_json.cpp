#include "supervisor/run/internal/record_json.h"
#include "supervisor/run/report.h"

namespace stepwright::run {
namespace {

using internal::json;

json runtime_json(const host::RuntimeStatus& status) {
  json plant = json::object();
  for (const host::NamedValue& value : status.plant) plant[value.name] = value.value;
  return {{"scans", status.scan},
          {"time_s", static_cast<double>(status.time_ns) * 1e-9},
          {"overruns", status.overruns},
          {"scan_p50_us", status.scan_p50_us},
          {"scan_p99_us", status.scan_p99_us},
          {"scan_max_us", status.scan_max_us},
          {"realtime_factor", status.realtime_factor},
          {"trace_hash", status.trace_hash},
          {"program_digest", status.program_digest},
          {"plant", std::move(plant)}};
}

host::RuntimeStatus runtime_from(const json& value) {
  host::RuntimeStatus status;
  status.scan = value.at("scans");
  status.time_ns = static_cast<std::int64_t>(value.at("time_s").get<double>() * 1e9);
  status.overruns = value.at("overruns");
  status.scan_p50_us = value.at("scan_p50_us");
  status.scan_p99_us = value.at("scan_p99_us");
  status.scan_max_us = value.at("scan_max_us");
  status.realtime_factor = value.at("realtime_factor");
  status.trace_hash = value.at("trace_hash");
  status.program_digest = value.at("program_digest");
  for (const auto& [name, number] : value.at("plant").items()) {
    status.plant.push_back({name, number.get<double>()});
  }
  return status;
}

}  // namespace

std::string to_json(const Report& report) {
  return internal::text_of(
      {{"record", internal::record_json(report.record)}, {"runtime", runtime_json(report.runtime)}});
}

result::Result<Report> report_from_json(const std::string& text, const std::string& file) {
  return internal::read_text(text, file, "report", [](const json& document) -> result::Result<Report> {
    return Report{internal::record_from(document.at("record")), runtime_from(document.at("runtime"))};
  });
}

}  // namespace stepwright::run
