#pragma once

// The options that every process of a cell shares on its command line: --config FILE and --set KEY=VALUE.
//
//   CLI::App app{"The scan process of a cell", "stepwright runtime"};
//   config::CellOptions options;
//   config::add_cell_options(app, options);
//   const auto config = config::parse_cell(app, options, argc, argv);
//   return config ? run(*config) : config.error();

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/exit_code.h"

namespace CLI {
class App;
}

namespace stepwright::config {

struct CellOptions {
  std::string config;
  std::vector<std::string> overrides;
};

// `options` is filled when `app` parses and must live until then.
void add_cell_options(CLI::App& app, CellOptions& options);

// For ExecCondition= of systemd: Done if the cell wants the process that asks, else BadInput. `wants` judges
// what can be read of a file that is wrong, so that the runtime or the gateway starts and says what is wrong.
[[nodiscard]] result::ExitCode concerned(const CellOptions& options, bool (*wants)(const CellConfig&));

// The cell that the parsed options name, with a state folder that can be trusted (check_state_dir); or the
// exit code, after what is wrong went to stderr.
[[nodiscard]] tl::expected<CellConfig, int> load_cell(const CellOptions& options);

// Parses the command line and loads the cell that it names; or the exit code with which the process is to end
// now, after what is wrong went to stderr.
[[nodiscard]] tl::expected<CellConfig, int> parse_cell(CLI::App& app, const CellOptions& options, int argc,
                                                       char** argv);

}  // namespace stepwright::config
