#pragma once

// One plan as it is driven: which stops have been made, who waits for whom, who is late, and when all will be
// done by now. Who is later than scheduled is one constraint more; all times follow from it without a search.
//
// No clock, no I/O; one thread at a time. Times count from the plan's time zero.
//
//   FleetFollow follow(plan, program, {.late = 3s});
//   const FollowNews news = follow.take(reading, now);
//   for (const StopMade& stop : news.stops)
//     ledger.made(stop.vehicle, plan.missions[stop.vehicle].stops[stop.stop], now);

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/executive/fleet_reading.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/fleet/program/fleet_program.h"
#include "supervisor/fleet/schedule/retiming.h"

namespace stepwright::fleet {

enum class DriveState : std::uint8_t { Driving, Waiting, Serving, Resting, Lost, Stopped };
const char* to_string(DriveState state);

struct VehicleFollow {
  DriveState state = DriveState::Resting;
  std::optional<std::uint32_t> waits_for = {};
  std::size_t stops_done = 0;
  std::uint32_t error = 0;
  std::chrono::milliseconds delay{0};    // of its arrival, against the schedule
  std::chrono::milliseconds arrives{0};  // at the end of its mission, as things stand

  friend bool operator==(const VehicleFollow&, const VehicleFollow&) = default;
};

struct StopMade {
  std::uint32_t vehicle = 0;
  std::size_t stop = 0;
};

// A vehicle that is late by itself, and what that changed.
struct Delay {
  std::uint32_t vehicle = 0;
  std::uint32_t polygon = 0;
  std::chrono::milliseconds late{0};
  std::chrono::milliseconds arrives_later{0};
  std::vector<std::uint32_t> others = {};  // that arrive later for it, by a second and more
  std::vector<std::string> broken = {};    // constraints that cannot be kept any more, by name
  double retime_ms = 0.0;
};

struct FollowNews {
  std::vector<StopMade> begun;  // the vehicle stands there
  std::vector<StopMade> stops;  // it has been served
  std::vector<Delay> delays;
  std::vector<std::uint32_t> errors;  // vehicles that have stopped by themselves since the last reading
  bool moved_on = false;              // a vehicle is in another state, or waits for another one
  bool finished = false;              // every vehicle that can has come to the end of its mission
};

struct FollowOptions {
  std::chrono::milliseconds late{3'000};
  std::vector<bool> lost = {};  // by vehicle: those that take no part
};

class FleetFollow {
 public:
  // `program` is that of `plan`; both are copied.
  FleetFollow(FleetPlan plan, FleetProgram program, FollowOptions options);

  FollowNews take(const FleetReading& reading, std::chrono::milliseconds now);

  const FleetPlan& plan() const { return plan_; }
  const FleetProgram& program() const { return program_; }
  const std::vector<VehicleFollow>& vehicles() const { return vehicles_; }
  // Whether a stop that has begun is the one at which the vehicle stands now.
  bool serving(std::uint32_t vehicle) const { return vehicles_[vehicle].state == DriveState::Serving; }
  std::chrono::milliseconds arrives() const;  // the last one
  std::size_t retimings() const { return retimings_; }
  double slowest_retiming_ms() const { return slowest_ms_; }

 private:
  void read_progress(std::uint32_t vehicle, const FleetReading& reading, FollowNews& news);
  std::optional<std::uint32_t> whom_it_waits_for(std::uint32_t vehicle, const FleetReading& reading) const;
  void read_delay(std::uint32_t vehicle, const VehicleReading& now, std::chrono::milliseconds time,
                  FollowNews& news);
  void post(std::uint32_t vehicle, std::uint32_t polygon, std::chrono::milliseconds time, FollowNews& news);
  std::vector<std::string> release_broken();
  void renew_arrivals();
  bool lost(std::uint32_t vehicle) const { return !options_.lost.empty() && options_.lost[vehicle]; }

  FleetPlan plan_;
  FleetProgram program_;
  FollowOptions options_;
  std::vector<TrajectoryEnvelope> envelopes_;
  Retiming retiming_;
  std::vector<std::pair<TimepointRef, std::chrono::milliseconds>> posted_;
  // By vehicle and polygon: whom it has to let pass.
  std::vector<std::vector<std::vector<PolygonRef>>> before_;
  std::vector<VehicleFollow> vehicles_;
  std::vector<std::size_t> begun_;  // stops at which it has stood
  std::size_t retimings_ = 0;
  double slowest_ms_ = 0.0;
};

}  // namespace stepwright::fleet
