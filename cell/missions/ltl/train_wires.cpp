#include "cell/missions/ltl/train_wires.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cell/config/port_reader.h"
#include "runtime/ground/files/files.h"
#include "supervisor/ltl/scene/scene_reader.h"

namespace stepwright::missions {
namespace {

// Of the simulated hall, in the order of their terminals.
result::Result<std::vector<std::string>> simulated_places(const config::TuggerPlantConfig& tugger) {
  std::vector<std::string> names;
  if (tugger.scene.empty()) return names;  // of a map alone
  auto text = files::read_file(tugger.scene.string());
  if (!text) return result::forward(text);
  const auto border = tugger.map.empty() ? ltl::Border::InTheScene : ltl::Border::FromElsewhere;
  auto floor = ltl::read_scene(*text, tugger.scene.string(), {}, border);
  if (!floor) return result::forward(floor);
  for (const ltl::Area& place : floor->propositions) names.push_back(place.name);
  return names;
}

// Each place by its name: the problem's floor may have fewer than the hall, and in another order.
result::Result<ltl::TrainTerminals> in_the_simulated_row(const config::TuggerPlantConfig& tugger,
                                                         const std::vector<std::string>& places) {
  auto there = simulated_places(tugger);
  if (!there) return result::forward(there);
  ltl::TrainTerminals row = ltl::train_terminals_in_a_row(tugger.most_trailers, there->size());
  std::vector<std::string> at;
  result::Diagnostics wrong;
  for (const std::string& place : places) {
    const auto found = std::ranges::find(*there, place);
    if (found != there->end())
      at.push_back(row.at[static_cast<std::size_t>(found - there->begin())]);
    else
      wrong.push_back({"L0504",
                       result::Severity::Error,
                       {tugger.scene.string(), 0, 0},
                       "the simulated hall has no place '" + place + "', which the problem's floor has",
                       "one scene for both"});
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  row.at = std::move(at);
  return row;
}

result::Result<ltl::TrainTerminals> as_named(const config::CellConfig& config, std::size_t trailers,
                                             const std::vector<std::string>& places) {
  config::PortReader ports(config);
  ltl::TrainTerminals all;
  const std::pair<const char*, std::string*> named[] = {{"x", &all.x},
                                                        {"y", &all.y},
                                                        {"heading", &all.heading},
                                                        {"speed", &all.speed},
                                                        {"lock", &all.lock},
                                                        {"trailers", &all.trailers},
                                                        {"bumper", &all.bumper},
                                                        {"estop_ok", &all.estop_ok},
                                                        {"way_free", &all.way_free},
                                                        {"set_speed", &all.set_speed},
                                                        {"set_lock", &all.set_lock},
                                                        {"enable", &all.enable}};
  for (const auto& [name, address] : named) *address = ports.address(name);
  const auto has = [&](const std::string& port) {
    return std::ranges::find(config.plant.ports, port, &config::PortAddress::port) !=
           config.plant.ports.end();
  };
  // Those behind the problem's trailers are there where more can be coupled.
  for (std::size_t k = 1; k <= ltl::kMostTrailers; ++k) {
    const std::string hitch = "hitch_" + std::to_string(k);
    if (k > trailers && !has(hitch)) break;
    all.hitches.push_back(ports.address(hitch));
  }
  for (const std::string& place : places) all.at.push_back(ports.address("at_" + place));
  if (auto wrong = ports.take(); !wrong.empty()) return tl::unexpected(std::move(wrong));
  return all;
}

}  // namespace

result::Result<ltl::TrainTerminals> terminals_of(const config::CellConfig& config,
                                                 const ltl::Problem& problem) {
  const std::vector<std::string> places = problem.places();
  if (!config.plant.ports.empty()) return as_named(config, problem.train.trailers, places);
  if (config.plant.kind == "tugger") return in_the_simulated_row(config.plant.tugger, places);
  return ltl::train_terminals_in_a_row(problem.train.trailers, places.size());
}

}  // namespace stepwright::missions
