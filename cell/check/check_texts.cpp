#include "cell/check/check_texts.h"

#include <filesystem>
#include <vector>

#include "runtime/ground/files/files.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::check {

result::Diagnostics check_texts(const config::CellConfig& config) {
  std::vector<std::filesystem::path> files = config.boot.sources;
  for (const config::MonitorConfig& each : config.monitors)
    if (!each.formula_file.empty()) files.push_back(each.formula_file);
  result::Diagnostics problems;
  for (const std::filesystem::path& file : files) {
    const auto text = files::read_file(file.string());
    if (!text) continue;
    if (const auto broken = result::place_of_no_utf8(file.string(), *text))
      problems.push_back({"C0533", result::Severity::Warning, *broken,
                          "this is no UTF-8: the page shows comments and texts of this file wrongly",
                          result::kUtf8Hint});
  }
  return problems;
}

}  // namespace stepwright::check
