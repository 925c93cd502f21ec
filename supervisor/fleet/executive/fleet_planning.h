#pragma once

// Plans and programs of one fleet, again and again while it drives: holds the floor with its tables, the
// terminals and what never changes in a run.
//
// One thread at a time. The same requests in the same order give the same plans, unless time ends.
//
//   auto service = FleetPlanning::open({.problem = "warehouse.json", .terminals = terminals_in_a_row(6)});
//   FleetLedger ledger(planning->problem());
//   auto outcome = planning->plan(ledger, {.starts = planning->first_starts()});

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/executive/fleet_ledger.h"
#include "supervisor/fleet/prepare/prepare_fleet.h"

namespace stepwright::fleet {

struct FleetPlanningOptions {
  std::filesystem::path problem;
  FleetTerminals terminals;
  ProgramOptions program;
  DriveReserve reserve;
  double path_factor = 1.5;
  // Zero: none, so that a plan does not depend on the machine; searches have budgets that are counted.
  std::chrono::milliseconds time{0};
  std::filesystem::path cache;              // for look-up tables; empty: they are built each time
  std::vector<driver::Watcher> watchers{};  // compiled with every program
};

// A vehicle that takes no part, and what nobody may drive into for it. The place holds the vehicle.
struct Standing {
  std::uint32_t vehicle = 0;
  geometry::Pose pose;
  geometry::ConvexPolygon place;
};

struct FleetRequest {
  RestOptions rest;
  std::vector<Standing> standing = {};
  std::vector<geometry::ConvexPolygon> blocked = {};
  std::uint32_t revision = 1;
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

// A part of a goal to which nobody finds a way.
struct NoWay {
  std::size_t goal = 0;  // of the ledger
  std::optional<std::uint32_t>
      aboard_of;  // what this vehicle has aboard; nothing: what is still to be fetched
};

struct FleetOutcome {
  PreparedFleet prepared;                   // with missions of all vehicles, standing ones included
  RestProblem rest;                         // what was planned
  std::vector<NoWay> no_way_to;             // nothing is planned then
  std::vector<std::size_t> no_way_to_task;  // of the ledger's; likewise
  std::string reason;                       // why there is no plan
};

class FleetPlanning {
 public:
  // Fails with the errors of the problem's file, and with F1105 where there are not as many terminals as
  // vehicles.
  [[nodiscard]] static result::Result<FleetPlanning> open(const FleetPlanningOptions& options);

  const MissionProblem& problem() const { return problem_; }
  const FleetPlanningOptions& options() const { return options_; }
  // Where the problem has them begin.
  std::vector<NewStart> first_starts() const;
  VehicleModel model(std::uint32_t vehicle) const {
    return problem_.classes[problem_.vehicles[vehicle].vehicle_class].model;
  }
  // The floor with these places closed.
  OccupancyGrid floor_with(const std::vector<Standing>& standing,
                           const std::vector<geometry::ConvexPolygon>& blocked) const;

  // Diagnostics are faults of the tools: of a plan that no program can drive, say.
  [[nodiscard]] result::Result<FleetOutcome> plan(const FleetLedger& ledger, const FleetRequest& request);
  // The program of a plan that needs no planning.
  [[nodiscard]] result::Result<PreparedFleet> program_of(FleetPlan plan, std::uint32_t revision,
                                                         ErrorReset reset = {}) const;

 private:
  FleetPlanning(FleetPlanningOptions options, MissionProblem problem, FleetFloor floor);
  NoWay no_way(const RestProblem& rest, std::size_t goal) const;

  FleetPlanningOptions options_;
  MissionProblem problem_;
  FleetFloor floor_;
};

}  // namespace stepwright::fleet
