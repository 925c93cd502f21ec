#include "tests/bench/shift/fleet.h"

#include <set>
#include <string>
#include <utility>

#include "plant_models/assemblies/forklift_parameters.h"
#include "tests/bench/shift/figures.h"

namespace stepwright::bench::shift {

namespace {

// Where missions of the scenario lead to.
std::vector<geometry::Pose> goals_of(const Scenario& scenario, std::uint32_t vehicles) {
  std::set<std::uint32_t> stations;
  for (const Transport& transport : scenario.transports) stations.insert({transport.from, transport.to});
  std::vector<geometry::Pose> goals(scenario.hall.bays.begin(), scenario.hall.bays.begin() + vehicles);
  for (const std::uint32_t station : stations) goals.push_back(scenario.stations[station]);
  return goals;
}

}  // namespace

fleet::DriveLimits limits_of_the_plant() {
  const assemblies::ForkliftParameters parameters;
  fleet::DriveLimits limits;
  limits.wheelbase_m = parameters.body.wheelbase_m;
  limits.full_lock_rad = assemblies::full_lock_rad(parameters);
  return limits;
}

Fleet::Fleet(const Scenario& scenario, std::uint32_t vehicles, double path_weight) {
  settings_.path_weight = path_weight;
  settings_.limits = limits_of_the_plant();
  // Steering needs something left to get back to the path with.
  settings_.vehicle.min_turning_radius_m = 4.4;
  primitives_ = std::make_unique<fleet::PrimitiveSet>(fleet::with_margin(settings_), fleet::LatticeOptions{});
  table_ = std::make_unique<fleet::HeuristicTable>(fleet::HeuristicTable::build(*primitives_));
  std::vector<fleet::HomePlace> homes;
  for (std::uint32_t v = 0; v < vehicles; ++v)
    homes.push_back({"v" + std::to_string(v + 1), scenario.hall.bays[v]});
  planner_ = std::make_unique<fleet::RoutePlanner>(
      fleet::RoutePlanner::create(scenario.hall.grid, *primitives_, *table_, std::move(homes), settings_)
          .value());
  goals_ = goals_of(scenario, vehicles);
}

void Fleet::prepare() {
  const double begin_s = process_cpu_s();
  planner_->prepare(goals_, 2);
  prepare_cpu_s_ = process_cpu_s() - begin_s;
}

std::vector<fleet::Route> resting(fleet::RoutePlanner& planner, std::uint32_t vehicles) {
  std::vector<fleet::Route> routes;
  for (std::uint32_t v = 0; v < vehicles; ++v) routes.push_back(planner.stand(v, planner.home(v)).value());
  return routes;
}

}  // namespace stepwright::bench::shift
