// One step of the floor: vehicles move, bodies meet, forks pick and drop.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_models/assemblies/fleet_floor.h"
#include "plant_models/body2d/conveying.h"

namespace stepwright::assemblies {
namespace {

constexpr double kRadPerCentidegree = std::numbers::pi / 18000.0;
constexpr double kFloorGrip = 0.5;  // of a pallet
constexpr double kTouch_n = 1.0;    // less is rounding
// How far a pallet may be from where the forks want it, and turned, to be lifted.
constexpr double kReach_m = 0.35;
constexpr double kAside_m = 0.2;
constexpr double kTurned_rad = 0.2;
constexpr double kForkHeel_m = 0.02;

body2d::Motion motion_between(const body2d::Pose& from, const body2d::Pose& to) {
  constexpr double kPerSecond = 1.0 / kFleetStepS;
  return {kPerSecond * (to.position - from.position), kPerSecond * (to.angle - from.angle)};
}

}  // namespace

bool FleetFloor::step() {
  const double end_s = static_cast<double>(steps_ + 1) * kFleetStepS;
  for (Vehicle& vehicle : vehicles_) {
    if (!move_vehicle(vehicle, end_s)) return false;
  }
  for (const Pallet& pallet : pallets_) {
    if (!pallet.carrier)
      body2d::convey(world_, pallet.body, {{kPalletLength_m, kPalletWidth_m}}, {}, kFloorGrip, {});
  }
  world_.step();
  for (Vehicle& vehicle : vehicles_) feel_contacts(vehicle);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    move_forks(i);
    overlap_monitor_.put(i, vehicles_[i].forklift->pose());
  }
  overlap_monitor_.look();
  return true;
}

// The bodies get the motion that brings them to where the equations have the vehicle at the end of the step.
bool FleetFloor::move_vehicle(Vehicle& vehicle, double end_s) {
  if (!vehicle.enable) vehicle.tripped = false;
  const bool moves = vehicle.enable && !vehicle.tripped && !vehicle.dead && !emergency_stop_;
  vehicle.forklift->command(
      {moves, 1e-3 * vehicle.speed_mm_s, kRadPerCentidegree * vehicle.lock_centidegrees});
  const ForkliftPose before = vehicle.forklift->pose();
  if (!vehicle.forklift->advance_to(end_s)) return false;
  const ForkliftPose after = vehicle.forklift->pose();
  world_.place(vehicle.body, chassis_pose(before), motion_between(chassis_pose(before), chassis_pose(after)));
  if (vehicle.pallet) {
    const body2d::Pose from = carried_pose(vehicle, before);
    world_.place(pallets_[*vehicle.pallet].body, from, motion_between(from, carried_pose(vehicle, after)));
  }
  return true;
}

// What presses against the chassis or its load stops the vehicle where the contact left it.
void FleetFloor::feel_contacts(Vehicle& vehicle) {
  double force_n = world_.pressed_n(vehicle.body);
  if (vehicle.pallet) force_n = std::max(force_n, world_.pressed_n(pallets_[*vehicle.pallet].body));
  const ForkliftPose wanted = vehicle.forklift->pose();
  if (force_n > kTouch_n) {
    if (!vehicle.tripped) ++contacts_;
    vehicle.tripped = true;
    greatest_force_n_ = std::max(greatest_force_n_, force_n);
    const body2d::Pose body = world_.pose(vehicle.body);
    const double behind_m = (parameters_.forklift.body.rear_m - kChassisFront_m) / 2.0;
    const body2d::Vec2 reference = body2d::to_plane(body, {behind_m, 0.0});
    vehicle.forklift->stop_at({reference.x, reference.y, body.angle});
  } else {
    // Box2D is single: without contact the equations are the truth.
    world_.place(vehicle.body, chassis_pose(wanted), world_.motion(vehicle.body));
  }
  if (vehicle.pallet) {
    world_.place(pallets_[*vehicle.pallet].body, carried_pose(vehicle, vehicle.forklift->pose()), {});
  }
}

void FleetFloor::move_forks(std::size_t index) {
  Vehicle& vehicle = vehicles_[index];
  if (vehicle.dead || emergency_stop_) return;
  const double before = vehicle.lift_travel;
  const double change = kFleetStepS / parameters_.lift_s;
  vehicle.lift_travel = std::clamp(before + (vehicle.lift ? change : -change), 0.0, 1.0);
  // Half-way the forks meet the pallet.
  if (before < 0.5 && vehicle.lift_travel >= 0.5) pick(index);
  if (before >= 0.5 && vehicle.lift_travel < 0.5) drop(vehicle);
}

void FleetFloor::pick(std::size_t index) {
  const ForkliftPose at = vehicles_[index].forklift->pose();
  const body2d::Pose frame{{at.x_m, at.y_m}, at.heading_rad};
  const double wanted_m = kChassisFront_m + kPalletLength_m / 2.0 + 0.05;
  for (std::size_t k = 0; k < pallets_.size(); ++k) {
    const Pallet& pallet = pallets_[k];
    const body2d::Pose pose = world_.pose(pallet.body);
    const body2d::Vec2 own = body2d::to_own(frame, pose.position);
    const double turned = std::remainder(pose.angle - at.heading_rad, std::numbers::pi);  // from either end
    const bool reached = std::abs(own.x - wanted_m) <= kReach_m && std::abs(own.y) <= kAside_m &&
                         std::abs(turned) <= kTurned_rad;
    if (!reached || pallet.carrier || pallet.load_kg > parameters_.forklift.greatest_load_kg) continue;
    take(index, k);
    return;
  }
}

void FleetFloor::take(std::size_t index, std::size_t k) {
  Vehicle& vehicle = vehicles_[index];
  const ForkliftPose at = vehicle.forklift->pose();
  const body2d::Pose pose = world_.pose(pallets_[k].body);
  pallets_[k].carrier = index;
  vehicle.pallet = k;
  vehicle.pallet_grip = {body2d::to_own({{at.x_m, at.y_m}, at.heading_rad}, pose.position),
                         pose.angle - at.heading_rad};
  // The back of the forks keeps it off the chassis.
  const double turned = vehicle.pallet_grip.angle;
  const double half_m =
      0.5 * (kPalletLength_m * std::abs(std::cos(turned)) + kPalletWidth_m * std::abs(std::sin(turned)));
  double& ahead_m = vehicle.pallet_grip.position.x;
  ahead_m = std::max(ahead_m, kChassisFront_m + half_m + kForkHeel_m);
  ForkliftModes modes = vehicle.forklift->modes();
  modes.load_kg = pallets_[k].load_kg;
  vehicle.forklift->set_modes(modes);
}

void FleetFloor::drop(Vehicle& vehicle) {
  if (!vehicle.pallet) return;
  pallets_[*vehicle.pallet].carrier.reset();
  vehicle.pallet.reset();
  ForkliftModes modes = vehicle.forklift->modes();
  modes.load_kg = 0.0;
  vehicle.forklift->set_modes(modes);
}

}  // namespace stepwright::assemblies
