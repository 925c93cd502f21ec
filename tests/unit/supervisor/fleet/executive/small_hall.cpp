#include "tests/unit/supervisor/fleet/executive/small_hall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "cell/missions/fleet/fleet_executive_options.h"
#include "cell/runtime/fleet_plant.h"
#include "plant_models/assemblies/fleet_floor.h"
#include "runtime/ground/result/value_or_throw.h"

namespace stepwright::fleet {
namespace {

constexpr const char* kFolder = STEPWRIGHT_SOURCE_DIR "/tests/cells/fleet/";

}  // namespace

SmallHall::SmallHall(std::vector<support::PlantFault> faults, const std::string& constraints)
    : config_(result::value_or_throw(config::load_cell_config(std::string(kFolder) + "small_hall.toml"))),
      constraints_(constraints),
      controller_(result::value_or_throw(assemblies::FleetFloor::create(
                      result::value_or_throw(cell_runtime::fleet_parameters(config_.plant)))),
                  bridge::default_fleet_wires(3), {64, 64}, std::move(faults)) {
  if (constraints.empty()) return;
  auto problem = nlohmann::json::parse(std::ifstream(missions::fleet_table(config_).problem));
  problem["map"] = std::string(kFolder) + "map.yaml";
  problem["constraints"] = nlohmann::json::parse(constraints);
  auto table = std::make_shared<missions::FleetTable>(missions::fleet_table(config_));
  table->problem = folder_.path() / "problem.json";
  std::ofstream(table->problem) << problem;
  config_.mission.table = std::move(table);
}

FleetExecutiveOptions SmallHall::options() const {
  return missions::fleet_executive_options(config_);
}

run::RunRecord SmallHall::run(FleetExecutiveOptions options, FleetExecutive::Observer observer) {
  options.journal = folder_.path() / "executive.json";
  return FleetExecutive(planning(), controller_, std::move(options), std::move(observer)).run();
}

FleetPlanning& SmallHall::planning() {
  static std::map<std::string, FleetPlanning> plannings;
  const auto found = plannings.find(constraints_);
  if (found != plannings.end()) return found->second;
  return plannings.emplace(constraints_, result::value_or_throw(missions::open_fleet_planning(config_)))
      .first->second;
}

void SmallHall::tell_time() {
  controller_.on_scan = [this, scans = 0](std::span<const std::byte>) mutable {
    if (++scans % 50 == 0) controller_.interrupt();
  };
}

void SmallHall::expect_clean() const {
  for (const char* name : {"overlaps", "obstacle_overlaps", "contacts"})
    EXPECT_EQ(controller_.plant_value(name), 0.0) << name;
}

std::string story(const run::RunRecord& record) {
  std::string text = std::string(to_string(record.phase)) + ": " + record.message;
  for (const auto& incident : record.incidents) {
    text += "\n  " + std::to_string(incident.time_s) + " s (" + to_string(incident.response) + "):";
    for (const std::string& sentence : incident.evidence) text += " " + sentence + ";";
  }
  for (const auto& episode : record.episodes) {
    for (const auto& action : episode.actions) {
      if (action.started_s)
        text += "\n  " + action.text + ": " + std::to_string(*action.started_s) + " to " +
                std::to_string(action.finished_s.value_or(-1.0));
    }
  }
  return text;
}

bool all_met(const run::RunRecord& record) {
  return std::ranges::all_of(record.goal, [](const run::GoalRecord& goal) { return goal.met; });
}

double finished_s(const run::RunRecord& record, const std::string& what) {
  double finished = -1.0;
  for (const auto& episode : record.episodes) {
    for (const auto& action : episode.actions) {
      if (action.text.find(what) != std::string::npos && action.finished_s) finished = *action.finished_s;
    }
  }
  return finished;
}

}  // namespace stepwright::fleet
