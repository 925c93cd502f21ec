#include "cell/config/record_config.h"

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

RecordConfig read_record(const settings::TomlTable& table, const std::filesystem::path& state_dir) {
  RecordConfig config;
  const std::string file = table.text("file", {});
  if (!file.empty()) config.file = std::filesystem::absolute(state_dir / file).lexically_normal();
  config.where = table.where("file");
  config.max_mb = static_cast<std::uint64_t>(table.integer("max_mb", 0, {0, 1e9}));
  config.hash_every = static_cast<std::uint32_t>(table.integer("hash_every", 1, {1, 1e6}));
  config.keyframe_every = static_cast<std::uint32_t>(table.integer("keyframe_every", 1'000, {0, 1e9}));
  return config;
}

HistoryConfig read_history(const settings::TomlTable& table, const std::filesystem::path& folder,
                           const std::filesystem::path& state_dir) {
  HistoryConfig config;
  const std::string kept_in = table.text("folder", {});
  if (!kept_in.empty()) config.folder = std::filesystem::absolute(state_dir / kept_in).lexically_normal();
  config.most_age = std::chrono::hours(24 * table.integer("days", 90, {0, 36'500}));
  config.max_mb = static_cast<std::uint64_t>(table.integer("max_mb", 4'096, {0, 1e9}));
  const std::string alarms = table.text("alarms", {});
  if (!alarms.empty()) config.alarms = (folder / alarms).lexically_normal();
  return config;
}

}  // namespace stepwright::config
