#include "programs/plan/output.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>

namespace stepwright::plan {

void print_diagnostics(const result::Diagnostics& diagnostics) {
  if (!diagnostics.empty()) std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
}

bool write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (file) return true;
  result::Diagnostic diagnostic;
  diagnostic.code = "P0501";
  diagnostic.where.file = path;
  diagnostic.message = "the file cannot be written";
  diagnostic.hint = "does its folder exist, and is there space?";
  print_diagnostics({diagnostic});
  return false;
}

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json diagnostics_json(const result::Diagnostics& diagnostics) {
  nlohmann::json list = nlohmann::json::array();
  for (const result::Diagnostic& d : diagnostics) {
    const char* severity = d.severity == result::Severity::Error     ? "error"
                           : d.severity == result::Severity::Warning ? "warning"
                                                                     : "note";
    list.push_back({{"file", d.where.file},
                    {"line", d.where.line},
                    {"column", d.where.column},
                    {"code", d.code},
                    {"severity", severity},
                    {"message", d.message},
                    {"hint", d.hint}});
  }
  return list;
}

}  // namespace stepwright::plan
