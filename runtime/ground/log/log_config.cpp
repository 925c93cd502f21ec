#include "runtime/ground/log/log_config.h"

#include <string>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::log {
namespace {

LogLevel level_of(const std::string& word) {
  return word == "debug"     ? LogLevel::Debug
         : word == "warning" ? LogLevel::Warning
         : word == "error"   ? LogLevel::Error
                             : LogLevel::Info;
}

}  // namespace

LogConfig read_log(const settings::TomlTable& root, const std::filesystem::path& folder) {
  const settings::TomlTable table = root.table("log");
  LogConfig log;
  log.format = table.choice("format", "text", {"text", "json"}) == "json" ? LogFormat::Json : LogFormat::Text;
  log.level = level_of(table.choice("level", "info", {"debug", "info", "warning", "error"}));
  const std::string file = table.text("file", {});
  if (!file.empty()) log.file = folder / file;
  log.max_mb = static_cast<std::uint32_t>(table.integer("max_mb", log.max_mb, {0, 1'000'000}));
  log.keep = static_cast<std::uint32_t>(table.integer("keep", log.keep, {0, 1'000}));
  log.limit_per_s = static_cast<std::uint32_t>(table.integer("limit_per_s", log.limit_per_s, {1, 10'000}));
  log.where = table.where("file");
  return log;
}

}  // namespace stepwright::log
