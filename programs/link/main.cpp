// `stepwright link --config CELL.toml`: carries the service of the cell's runtime over Fast DDS. It may be
// killed and started at any time; the scan does not notice.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "programs/config/cell_options.h"
#include "programs/link/bridge.h"
#include "programs/process/command_line.h"
#include "programs/process/stop_signal.h"
#include "runtime/result/exit_code.h"

namespace stepwright::link {
namespace {

using result::ExitCode;

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  auto endpoint = dds::LinkEndpoint::create({config.dds.domain_id, "link", config.dds.runtime_id});
  if (!endpoint) return process::fail(endpoint.error(), ExitCode::BadInput);
  std::printf("link of '%s' between %s and Fast DDS domain %u\n", config.name.c_str(),
              config.socket_path().c_str(), config.dds.domain_id);
  std::fflush(stdout);
  Bridge(std::move(*endpoint), config.socket_path()).run(stop.descriptor());
  std::printf("link of '%s' ends\n", config.name.c_str());
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::link

int main(int argc, char** argv) {
  CLI::App app{"Carry the service of a runtime over Fast DDS", "stepwright link"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  const auto config = stepwright::config::parse_cell(app, options, argc, argv);
  return config ? stepwright::link::run(*config) : config.error();
}
