#include "tests/support/vda5050/made_missions.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::support {

namespace {

constexpr double kSide_m = 60.0;
constexpr double kStep_m = 0.1;

fleet::OccupancyGrid floor() {
  return fleet::OccupancyGrid({.resolution_m = 0.5, .origin = {0, 0}, .columns = 120, .rows = 120});
}

// Across the floor from a random side, with a curve in the middle.
fleet::VehicleMission random_mission(std::uint32_t index, SplitMix64& random) {
  const double heading = 0.5 * std::numbers::pi * static_cast<double>(random.below(4));
  const double side = std::floor(random.between(-12.0, 12.0));
  const geometry::Pose middle{0.5 * kSide_m, 0.5 * kSide_m, heading};
  const geometry::Point start = from_frame(middle, {-24.0 + 5.0 * static_cast<double>(index % 2), side});
  MadeMission made("v" + std::to_string(index + 1), {start.x_m, start.y_m, heading});
  made.drive(random.between(6.0, 12.0));
  if (random.below(3) == 0) made.stop(fleet::StopKind::PickUp, "rack" + std::to_string(index), "load");
  const double bend = random.below(2) == 0 ? 0.0 : random.between(-0.15, 0.15);
  made.drive(6.0, bend).drive(random.between(4.0, 12.0));
  if (random.below(2) == 0) made.stop(fleet::StopKind::SetDown, "dock" + std::to_string(index), "load");
  if (random.below(3) == 0) made.drive(3.0, 0.1, geometry::Travel::Reverse);
  return made.mission();
}

}  // namespace

MadeMission::MadeMission(std::string vehicle, geometry::Pose start, geometry::Travel travel) {
  mission_.vehicle = std::move(vehicle);
  mission_.path.push_back({start, 0.0, travel});
}

MadeMission& MadeMission::drive(double length_m, double curvature_1pm, geometry::Travel travel) {
  const auto steps = static_cast<int>(std::lround(length_m / kStep_m));
  const double way = (travel == geometry::Travel::Forward ? 1.0 : -1.0) * length_m / steps;
  for (int k = 0; k < steps; ++k) {
    geometry::PathPose next = mission_.path.back();
    const double middle = next.pose.heading_rad + 0.5 * way * curvature_1pm;
    next.pose.x_m += way * std::cos(middle);
    next.pose.y_m += way * std::sin(middle);
    next.pose.heading_rad += way * curvature_1pm;
    next.arc_m += length_m / steps;
    next.travel = travel;
    mission_.path.push_back(next);
  }
  return *this;
}

MadeMission& MadeMission::stop(fleet::StopKind kind, const std::string& location, const std::string& goal) {
  fleet::Stop stop;
  stop.kind = kind;
  stop.location = location;
  stop.goal = goal;
  stop.amount = 1;
  stop.pose = mission_.path.size() - 1;
  stop.arc_m = mission_.path.back().arc_m;
  mission_.stops.push_back(stop);
  return *this;
}

fleet::VehicleMission MadeMission::mission() const {
  fleet::VehicleMission mission = mission_;
  auto grown = fleet::grow_envelope(floor(), mission.model.footprint(), mission.vehicle, mission.path, {});
  if (!grown) throw std::runtime_error(to_string(grown.error()));
  mission.grown = *std::move(grown);
  return mission;
}

fleet::FleetPlan scheduled(std::vector<fleet::VehicleMission> missions) {
  fleet::FleetPlan plan{.missions = std::move(missions), .constraints = {}, .schedule = {}};
  for (fleet::VehicleMission& mission : plan.missions) {
    mission.speed.min_mps = 0.0;
    fleet::set_times(mission.grown, mission.speed);
  }
  plan.schedule = fleet::schedule(fleet::envelopes_of(plan), {}, {.mode = fleet::Mode::Strict});
  return plan;
}

fleet::FleetPlan random_plan(std::uint32_t vehicles, std::uint64_t seed) {
  SplitMix64 random(seed);
  for (;;) {
    std::vector<fleet::VehicleMission> missions;
    for (std::uint32_t v = 0; v < vehicles; ++v) missions.push_back(random_mission(v, random));
    fleet::FleetPlan plan = scheduled(std::move(missions));
    if (plan.schedule.verdict == fleet::Verdict::Scheduled) return plan;
  }
}

}  // namespace stepwright::support
