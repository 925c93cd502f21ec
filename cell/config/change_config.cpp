#include "cell/config/change_config.h"

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

ChangeConfig read_change(const settings::TomlTable& root) {
  ChangeConfig config;
  const settings::TomlTable table = root.table("change");
  config.trial_scans =
      static_cast<std::uint32_t>(table.integer("trial_scans", config.trial_scans, {0, 1'000'000}));
  return config;
}

}  // namespace stepwright::config
