#include "programs/up/options.h"

namespace stepwright::up {

std::vector<std::string> overrides_of(const Options& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.port) overrides.push_back("hmi.port=" + std::to_string(*options.port));
  return overrides;
}

result::Result<config::CellConfig> load(const Options& options) {
  return config::load_cell_config(options.cell, overrides_of(options));
}

result::Result<config::CellConfig> load_for_a_look(const Options& options) {
  config::CellReading reading = config::read_cell_config(options.cell, overrides_of(options));
  if (reading.is_unread()) return tl::unexpected(std::move(reading.problems));
  return std::move(reading.config);
}

}  // namespace stepwright::up
