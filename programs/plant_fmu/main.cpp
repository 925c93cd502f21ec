// `stepwright-plant-fmu`: the process of a plant that is an FMU. The runtime starts it ([plant] kind =
// "fmu").

#include <CLI/CLI.hpp>
#include <string>

#include "plant_models/fmu/fmu_plant.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

int main(int argc, char** argv) {
  CLI::App app{"An FMU as the plant of a cell; the runtime starts it", "stepwright plant-fmu"};
  stepwright::fmu::FmuOptions options;
  std::string file;
  std::string folder;
  app.add_option("file", file, "the FMU")->required();
  app.add_option("--folder", folder, "where it is unpacked; emptied before")->required();
  app.add_option("--parameter", options.parameters, "a variable and its value at the start");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  options.file = file;
  options.folder = folder;
  auto peer = stepwright::stepped::StepPeer::open();
  if (!peer) return stepwright::process::fail(peer.error(), stepwright::result::ExitCode::BadInput);
  return stepwright::fmu::run_fmu(*peer, options);
}
