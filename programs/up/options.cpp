#include "programs/up/options.h"

#include <filesystem>

namespace stepwright::up {

std::vector<std::string> overrides_of(const Options& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.port) overrides.push_back("hmi.port=" + std::to_string(*options.port));
  return overrides;
}

namespace {

result::Result<void> check_there(const Options& options) {
  std::error_code ignored;  // what is not known is not there
  if (std::filesystem::exists(options.cell, ignored)) return {};
  return result::fail("M0012", {options.cell, 0, 0}, "there is no such cell",
                      "name the cell's file, or go to its folder; `stepwright new NAME` makes a cell");
}

}  // namespace

result::Result<config::CellConfig> load(const Options& options) {
  if (auto there = check_there(options); !there) return result::forward(there);
  return config::load_cell_config(options.cell, overrides_of(options));
}

result::Result<config::CellConfig> load_for_a_look(const Options& options) {
  if (auto there = check_there(options); !there) return result::forward(there);
  config::CellReading reading = config::read_cell_config(options.cell, overrides_of(options));
  const bool unread = reading.config.values.empty() && result::has_errors(reading.problems);
  if (unread) return tl::unexpected(std::move(reading.problems));
  return std::move(reading.config);
}

}  // namespace stepwright::up
