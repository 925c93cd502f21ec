#include "cell/config/cell_options.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "cell/config/state_dir.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::config {

void add_cell_options(CLI::App& app, CellOptions& options) {
  app.add_option("--config", options.config, "configuration file of the cell")->required();
  app.add_option("--set", options.overrides, "KEY=VALUE that wins over the file, e.g. plant.seed=7");
}

result::ExitCode concerned(const CellOptions& options, bool (*wants)(const CellConfig&)) {
  const CellReading cell = read_cell_config(options.config, options.overrides);
  return wants(cell.config) ? result::ExitCode::Done : result::ExitCode::BadInput;
}

tl::expected<CellConfig, int> load_cell(const CellOptions& options) {
  auto config = load_cell_config(options.config, options.overrides);
  if (!config) return tl::unexpected(process::fail(config.error(), result::ExitCode::BadInput));
  if (auto checked = check_state_dir(*config); !checked)
    return tl::unexpected(process::fail(checked.error(), result::ExitCode::BadInput));
  return std::move(*config);
}

tl::expected<CellConfig, int> parse_cell(CLI::App& app, const CellOptions& options, int argc, char** argv) {
  if (const auto exit = process::parse(app, argc, argv)) return tl::unexpected(*exit);
  return load_cell(options);
}

}  // namespace stepwright::config
