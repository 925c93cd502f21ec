#pragma once

// The options that every process of a cell shares on its command line: --config FILE and --set KEY=VALUE.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "programs/config/cell_config.h"

namespace stepwright::config {

struct CellOptions {
  std::string config;
  std::vector<std::string> overrides;
};

inline void add_cell_options(CLI::App& app, CellOptions& options) {
  app.add_option("--config", options.config, "configuration file of the cell")->required();
  app.add_option("--set", options.overrides, "KEY=VALUE that wins over the file, e.g. plant.seed=7");
}

// The configuration, or nothing after its diagnostics went to stderr (exit with ExitCode::BadInput).
inline std::optional<CellConfig> load_or_report(const CellOptions& options) {
  auto config = load_cell_config(options.config, options.overrides);
  if (config) return std::move(*config);
  std::fprintf(stderr, "%s\n", result::to_string(config.error()).c_str());
  return std::nullopt;
}

}  // namespace stepwright::config
