#include "cell/config/metrics_config.h"

namespace stepwright::config {

MetricsConfig read_metrics(const settings::TomlTable& owner) {
  MetricsConfig config;
  if (!owner.has_table("metrics")) return config;
  const settings::TomlTable table = owner.table("metrics");
  config.host = table.text("host", config.host);
  if (table.has("port")) {
    config.port = static_cast<std::uint16_t>(table.integer("port", 0, {0, 65'535}));
  } else {
    table.report("", "it is not said at which port the figures are served", "port = 9502", "0005");
  }
  config.where = table.where("port");
  return config;
}

}  // namespace stepwright::config
