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

}  // namespace stepwright::plan
