// A supervisor of the fleet in cell.toml, for vda5050_live_test.py: plans for its three vehicles,
// downloads the program, starts it and publishes the plan document.
//
//   vda5050_fleet CELL.toml [KEY=VALUE ...]
//
// Lines on its input: "go" lets the simulated clock go on, which stands still at the first step until then;
// "replan" sends the vehicles on from where the first plan leaves them; the end of the input ends it.

#include <chrono>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/config/dds_options.h"
#include "ladder/driver/compile.h"
#include "runtime/dds/plan_channel.h"
#include "runtime/dds/runtime_client.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/fleet/report/fleet_json.h"
#include "supervisor/map/map_file.h"
#include "tests/support/fleet_program/planned_fleet.h"

namespace {

using namespace stepwright;
using nlohmann::json;
constexpr double kPi = std::numbers::pi;

template <typename T>
T take(result::Result<T> made) {
  if (!made) throw std::runtime_error(result::to_string(made.error()));
  if constexpr (!std::is_void_v<T>) return *std::move(made);
}

geometry::Pose start_of(const config::PlaceConfig& place) {
  return {place.x_m, place.y_m, place.heading_deg * kPi / 180.0};
}

// v1 lifts its forks on its way.
std::vector<fleet::DrawnMission> first_missions(const config::CellConfig& cell) {
  const auto& at = cell.plant.fleet.vehicles;
  return {{start_of(at[0]), {{14.0, 4.0, 0.0}, {32.0, 20.0, 0.5 * kPi}}},
          {start_of(at[1]), {{18.0, 12.0, kPi}}},
          {start_of(at[2]), {{18.0, 20.0, 0.0}}}};
}

std::vector<fleet::DrawnMission> next_missions() {
  return {{{32.0, 20.0, 0.5 * kPi}, {{32.0, 15.0, 0.5 * kPi}}},
          {{18.0, 12.0, kPi}, {{8.0, 12.0, kPi}}},
          {{18.0, 20.0, 0.0}, {{23.0, 20.0, 0.0}}}};
}

fleet::FleetPlan planned(const fleet::OccupancyGrid& floor,
                         const std::vector<fleet::DrawnMission>& missions) {
  fleet::FleetPlan plan = fleet::plan_missions(floor, missions);
  for (fleet::VehicleMission& mission : plan.missions) {
    if (mission.stops.size() > 1) mission.stops.front().kind = fleet::StopKind::PickUp;
    for (const fleet::Stop& stop : mission.stops) {
      const auto& visits = mission.grown.visits;
      std::size_t k = visits.size() - 1;
      while (k > 0 && visits[k].first_pose > stop.pose) --k;
      mission.grown.stands.push_back(k);
    }
  }
  return plan;
}

class Supervisor {
 public:
  explicit Supervisor(const config::CellConfig& cell)
      : cell_(cell),
        runtime_(take(dds::RuntimeClient::connect(config::participant_of(cell.dds, "supervisor"),
                                                  dds::ClientRole::Supervisor))),
        plans_(take(dds::PlanPublisher::create(config::participant_of(cell.dds, "supervisor")))) {
    if (!runtime_->wait_for_runtime(std::chrono::seconds(30))) throw std::runtime_error("no runtime");
  }

  void run(const std::vector<fleet::DrawnMission>& missions) {
    const auto plan = planned(take(fleet::read_map(cell_.plant.fleet.map)), missions);
    fleet::ProgramOptions options{.interval_us = cell_.clock.interval_us, .drive = {}, .margins = {}};
    options.load_switches = false;
    auto program = take(fleet::fleet_program(plan, fleet::terminals_in_a_row(plan.missions.size()), options));
    const auto compiled = take(driver::compile({.texts = {}, .projects = {&program.project}}));
    const bool change = revision_++ > 0;
    const auto mode = change ? dds::DownloadMode::ChangeRestartCharts : dds::DownloadMode::Replace;
    const std::string digest = take(runtime_->download(compiled.container, mode)).digest;
    if (!change) take(runtime_->start({.barrier = true}));
    publish(plan, program, digest);
    std::printf("plan %d\n", revision_);
    std::fflush(stdout);
  }

  void go() {
    steps_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        const auto event = runtime_->wait_event(std::chrono::milliseconds(100));
        if (event) static_cast<void>(runtime_->acknowledge(event->sequence));
      }
    });
  }

 private:
  void publish(const fleet::FleetPlan& plan, const fleet::FleetProgram& program, const std::string& digest) {
    fleet::FleetAnswer answer;
    answer.verdict = plan.schedule.verdict;
    answer.plan = plan;
    json fleet = json::parse(fleet::fleet_json(answer, nullptr, std::nullopt));
    fleet["revision"] = revision_;
    fleet["epoch_s"] = 0.0;
    fleet["goals"] = json::array();
    fleet["sections"] = json::array();
    fleet["vehicles"] = json::array();
    for (const fleet::MissionProgram& mission : program.missions) {
      fleet["vehicles"].push_back(
          {{"vehicle", mission.vehicle}, {"variable", mission.name}, {"state", "driving"}});
    }
    const json document = {{"cell", cell_.name},
                           {"phase", "executing"},
                           {"message", ""},
                           {"program_digest", digest},
                           {"fleet", fleet}};
    take(plans_->publish(document.dump()));
  }

  const config::CellConfig& cell_;
  std::unique_ptr<dds::RuntimeClient> runtime_;
  std::unique_ptr<dds::PlanPublisher> plans_;
  int revision_ = 0;
  std::jthread steps_;  // last: it uses the runtime
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  try {
    const auto cell = take(config::load_cell_config(argv[1], {argv + 2, argv + argc}));
    Supervisor supervisor(cell);
    supervisor.run(first_missions(cell));
    for (std::string line; std::getline(std::cin, line);) {
      if (line == "go") supervisor.go();
      if (line == "replan") supervisor.run(next_missions());
    }
  } catch (const std::exception& wrong) {
    std::printf("%s\n", wrong.what());
    return 1;
  }
  return 0;
}
