#include "runtime/ground/process/diagnostics_json.h"

#include <nlohmann/json.hpp>

namespace stepwright::process {
namespace {

const char* word(result::Severity severity) {
  return severity == result::Severity::Error     ? "error"
         : severity == result::Severity::Warning ? "warning"
                                                 : "note";
}

}  // namespace

nlohmann::json diagnostics_json(const result::Diagnostics& diagnostics) {
  nlohmann::json list = nlohmann::json::array();
  for (const result::Diagnostic& each : diagnostics) {
    list.push_back({{"file", each.where.file},
                    {"line", each.where.line},
                    {"column", each.where.column},
                    {"code", each.code},
                    {"severity", word(each.severity)},
                    {"message", each.message},
                    {"hint", each.hint}});
  }
  return list;
}

}  // namespace stepwright::process
