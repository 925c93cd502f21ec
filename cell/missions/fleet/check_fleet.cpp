#include "cell/missions/fleet/check_fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cell/missions/fleet/fleet_executive_options.h"
#include "supervisor/map/map_file.h"

namespace stepwright::missions {
namespace {

// What the reserve of a plan has room for, with the noise of a navigation.
constexpr double kBeside_m = 0.1;
constexpr double kTurned_rad = 0.05;

result::Diagnostic problem(const char* code, result::Location where, std::string message, std::string hint) {
  return {code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)};
}

void compare_floors(const config::CellConfig& config, const fleet::FleetPlanning& planning,
                    result::Diagnostics& found) {
  if (config.plant.fleet.map.empty()) return;  // a floor without walls takes any plan
  const auto map = fleet::read_map(config.plant.fleet.map);
  if (!map || *map == planning.problem().map) return;  // what cannot be read is said with the plant
  found.push_back(
      problem("C0543", fleet_table(config).where,
              "the map of the problem is not that of the plant, " + config.plant.fleet.map.string(),
              "both have to name the same floor"));
}

void compare_stands(const config::CellConfig& config, const fleet::FleetPlanning& planning,
                    result::Diagnostics& found) {
  const auto& vehicles = planning.problem().vehicles;
  for (std::size_t k = 0; k < vehicles.size(); ++k) {
    const config::PlaceConfig& stands = config.plant.fleet.vehicles[k];
    const geometry::Pose& begins = vehicles[k].start;
    const double beside_m = std::hypot(stands.x_m - begins.x_m, stands.y_m - begins.y_m);
    const double turned = std::remainder(stands.heading_deg * std::numbers::pi / 180.0 - begins.heading_rad,
                                         2.0 * std::numbers::pi);
    if (beside_m <= kBeside_m && std::abs(turned) <= kTurned_rad) continue;
    found.push_back(
        problem("C0544", stands.where,
                fmt::format("v{} stands at ({} m, {} m), {} degrees; '{}' of the problem begins at ({} m, {} "
                            "m), {:g} degrees",
                            k + 1, stands.x_m, stands.y_m, stands.heading_deg, vehicles[k].name, begins.x_m,
                            begins.y_m, begins.heading_rad * 180.0 / std::numbers::pi),
                "v1, v2, ... are the problem's vehicles in their order"));
  }
}

void check_requests(const config::CellConfig& config, const fleet::FleetPlanning& planning,
                    result::Diagnostics& found) {
  for (const FleetAsked& asked : fleet_table(config).requests) {
    if (asked.request != "return") continue;
    const auto& vehicles = planning.problem().vehicles;
    if (std::ranges::find(vehicles, asked.vehicle, &fleet::MissionVehicle::name) != vehicles.end()) continue;
    found.push_back(problem("X0003", asked.where, "there is no vehicle '" + asked.vehicle + "'",
                            "vehicles are those of the problem's file"));
  }
}

}  // namespace

result::Result<FirstPlan> first_fleet_plan(const config::CellConfig& config, fleet::FleetPlanning& planning) {
  result::Diagnostics found;
  if (config.plant.kind == "fleet") {
    compare_floors(config, planning, found);
    compare_stands(config, planning, found);
  }
  for (const FleetOrder& order : fleet_table(config).orders) {
    fleet::FleetLedger trial(planning.problem());
    if (auto taken = trial.order(order.name, order.from, order.to, order.amount); !taken) {
      result::Diagnostic wrong = taken.error().front();
      wrong.where = order.where;
      found.push_back(std::move(wrong));
    }
  }
  check_requests(config, planning, found);
  if (!found.empty()) return tl::unexpected(std::move(found));
  const fleet::FleetLedger ledger(planning.problem());
  auto outcome = planning.plan(ledger, {.rest = {.starts = planning.first_starts()}});
  if (!outcome) return result::forward(outcome);
  if (!outcome->prepared.program) {
    const bool proved = outcome->prepared.answer.proof == fleet::Proof::AllPaths;
    return FirstPlan{.no_plan = outcome->reason,
                     .exit = proved ? result::ExitCode::NoPlan : result::ExitCode::BudgetExhausted};
  }
  FirstPlan first;
  const fleet::FleetPlan& plan = outcome->prepared.answer.plan;
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    first.actions += plan.missions[v].stops.size();
    const auto end = plan.schedule.earliest[v].back().exit;
    first.cost = std::max(first.cost, 1e-3 * static_cast<double>(end.count()));
  }
  first.program = std::move(outcome->prepared.container);
  return first;
}

}  // namespace stepwright::missions
