#include "programs/plan/output.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

#include "runtime/ground/files/files.h"

namespace stepwright::plan {

void print_diagnostics(const result::Diagnostics& diagnostics) {
  if (!diagnostics.empty()) std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
}

bool write_file(const std::string& path, const std::string& text) {
  const result::Diagnostics unwritten = files::write_file(path, text);
  print_diagnostics(unwritten);
  return unwritten.empty();
}

bool check_writable(const std::vector<std::string>& paths) {
  bool good = true;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    const result::Diagnostics refused = files::check_writable(path);
    print_diagnostics(refused);
    good = good && refused.empty();
  }
  return good;
}

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace stepwright::plan
