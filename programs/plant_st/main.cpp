// `stepwright-plant-st`: the process of a plant that is a program in ST. The runtime starts it ([plant] kind
// = "st").

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ladder/source_files/source_files.h"
#include "plant_models/program/program_plant.h"
#include "plant_models/stepped/step_peer.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::plant_st {
namespace {

result::Result<std::vector<std::byte>> compile(const std::vector<std::string>& paths) {
  result::Diagnostics unread;
  const sources::SourceFiles files = sources::load(paths, unread);
  if (!unread.empty()) return tl::unexpected(std::move(unread));
  auto output = driver::compile(files.input());
  if (!output) {
    sources::print(output.error(), files.files);
    return result::forward(output);
  }
  return std::move(output->container);
}

int run(const std::vector<std::string>& paths, const program_plant::ProgramPlant::Parameters& parameters) {
  auto peer = stepped::StepPeer::open();
  if (!peer) return process::fail(peer.error(), result::ExitCode::BadInput);
  const auto refuse = [&peer](const result::Diagnostics& problems) {
    return peer->refuse(result::to_string(problems.front()));
  };
  auto container = compile(paths);
  if (!container) return refuse(container.error());
  auto plant = program_plant::ProgramPlant::create(std::move(*container), peer->area().names(), parameters,
                                                   {paths.front(), 0, 0});
  if (!plant) return refuse(plant.error());
  (*plant)->sample(peer->area());
  return peer->serve(
      [&](std::int64_t time_ns, std::int64_t) { return (*plant)->step(time_ns, peer->area()); });
}

}  // namespace
}  // namespace stepwright::plant_st

int main(int argc, char** argv) {
  CLI::App app{"A program in ST as the plant of a cell; the runtime starts it", "stepwright plant-st"};
  std::vector<std::string> sources;
  stepwright::program_plant::ProgramPlant::Parameters parameters;
  app.add_option("sources", sources, "ST files, or PLCopen XML")->required();
  app.add_option("--parameter", parameters, "a variable and its value at the start");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return stepwright::plant_st::run(sources, parameters);
}
