// To rest: between two plans, and while an emergency stop holds the fleet.

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"
#include "supervisor/fleet/executive/halt_plan.h"
#include "supervisor/fleet/executive/stop_cause.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Phase;
using run::Response;

namespace {

constexpr double kRestWithin_s = 60.0;  // of the scan clock
// Behind a reset a vehicle's estimate of where it is begins anew: what was read before is of the old one.
constexpr double kSeenAnew_s = 0.3;
constexpr std::uint32_t kEmergencyStop = 24;

}  // namespace

std::optional<run::Cause> FleetExecutive::hold_stopped() {
  return hold({IncidentKind::Operator, {"the emergency stop is pressed: all vehicles stand"}, {}},
              Phase::Waiting, "the emergency stop holds the fleet: release it, then let the fleet go on");
}

std::string FleetExecutive::nobody_came(const run::Cause& cause, Phase phase) const {
  const std::string nobody = "nobody has let the fleet go on";
  if (cause.kind != IncidentKind::Operator) return cause.evidence.front() + "; " + nobody;
  return nobody + (phase == Phase::Held ? " that an operator held" : " after the emergency stop");
}

void FleetExecutive::see(std::span<const std::byte> image) {
  reading_ = reader_->read(image);
}

// Whoever stands for the emergency stop alone goes on; another cause is one that nobody has seen to.
run::Cause FleetExecutive::resumed() {
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    if (reading_.vehicles[v].error == kEmergencyStop && !ledger_.vehicles()[v].lost) resets_[v] = true;
  }
  return MovingMission::resumed();
}

bool FleetExecutive::bring_to_rest() {
  FleetPlan plan = follow_->plan();
  FleetProgram program = follow_->program();
  std::vector<double> begun_m(plan.missions.size(), 0.0);
  while (true) {
    HaltPlan halt = halt_plan(plan, program, reading_, planning_.options().program.drive,
                              planning_.problem().map.frame());
    for (std::size_t v = 0; v < begun_m.size(); ++v) begun_m[v] += halt.begun_m[v];
    auto prepared = planning_.program_of(halt.plan, revision_, take_resets());
    if (!prepared) {
      return give_up("the fleet cannot be brought to rest: " + result::to_string(prepared.error()),
                     IncidentKind::ProgramFault);
    }
    if (!bring_to_run([&] { return install(*prepared); })) return false;
    const Rest rest = await_fleet(*prepared, begun_m);
    const bool asked = rest == Rest::Reached && hold_.wanted();
    if (rest == Rest::Lost)
      return give_up("the runtime was lost while the fleet was brought to rest", IncidentKind::LostRuntime);
    if (rest != Rest::Error && !asked) return rest == Rest::Reached;
    if (asked ? !stay_held() : !stay_stopped()) return false;
    plan = std::move(halt.plan);
    program = *std::move(prepared->program);
  }
}

ErrorReset FleetExecutive::take_resets() {
  reset_running_ = std::exchange(resets_, std::vector<bool>(resets_.size(), false));
  return {reset_running_, ++reset_number_};
}

// Who stops by himself meanwhile is lost as well. The clock stands still at the event with which all rest.
FleetExecutive::Rest FleetExecutive::await_fleet(const PreparedFleet& halt,
                                                 const std::vector<double>& begun_m) {
  const double begun_s = clock_.now_s();
  const bool reset = std::ranges::find(reset_running_, true) != reset_running_.end();
  return await_rest({.within_s = kRestWithin_s,
                     .late = "the fleet does not come to rest",
                     .stopped = "the fleet was stopped while it was brought to rest",
                     .see = [&](std::span<const std::byte> image) -> std::optional<Rest> {
                       see(image);
                       if (reading_.emergency_stop) return Rest::Error;
                       const bool seen_anew = !reset || clock_.now_s() >= begun_s + kSeenAnew_s;
                       receive_returned(seen_anew);
                       watch_errors(begun_m);
                       if (!seen_anew || !all_rest(halt)) return std::nullopt;
                       track(begun_m);
                       return Rest::Reached;
                     }});
}

void FleetExecutive::watch_errors(const std::vector<double>& begun_m) {
  std::vector<std::uint32_t> errors;
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    if (reading_.vehicles[v].error != 0 && !ledger_.vehicles()[v].lost) errors.push_back(v);
  }
  for (const std::string& sentence : lose(errors, reading_, begun_m).evidence) add_evidence(sentence);
}

// Whoever is to come back has to be without error, and to stand where it was lost: one that still answers
// nothing shows itself at the origin.
void FleetExecutive::receive_returned(bool seen_anew) {
  for (std::uint32_t v = 0; v < returning_.size(); ++v) {
    const VehicleReading& now = reading_.vehicles[v];
    if (!returning_[v] || (!seen_anew && now.error == 0)) continue;
    const std::optional<Standing> stood = std::exchange(returning_[v], std::nullopt);
    const std::string& name = planning_.problem().vehicles[v].name;
    std::string why;
    if (now.error != 0) {
      why = fmt::format("{} at ({:.1f} m, {:.1f} m), error {}", stop_cause(now.error).sentence,
                        stood->pose.x_m, stood->pose.y_m, now.error);
    } else {
      Track at = tracks_[v];
      at.arc_m = arc_near(at.path, at.arc_m, now.pose);
      if (distance_from_way(at, now.pose) <= kBesideWay_m) continue;
      why = fmt::format("it shows itself at ({:.1f} m, {:.1f} m), which is not on its way", now.pose.x_m,
                        now.pose.y_m);
    }
    ledger_.lose(v, why);
    standing_[v] = stood;
    add_evidence(name + " cannot come back: " + why);
  }
}

bool FleetExecutive::all_rest(const PreparedFleet& halt) const {
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    const VehicleReading& now = reading_.vehicles[v];
    const MissionStepKind step = halt.program->missions[v].steps[now.step].kind;
    const bool rests = now.standing && now.forks_at_end && step == MissionStepKind::Done;
    if (!rests && !ledger_.vehicles()[v].lost) return false;
  }
  return true;
}

// Where vehicles stand on their last ways.
void FleetExecutive::track(const std::vector<double>& begun_m) {
  for (std::uint32_t v = 0; v < reading_.vehicles.size(); ++v) {
    if (ledger_.vehicles()[v].lost) continue;
    const VehicleReading& now = reading_.vehicles[v];
    const geometry::Path& path = plan_->answer.plan.missions[v].path;
    // Of a vehicle that was lost the plan knows a place, and no way.
    if (path.size() > 1 || tracks_[v].path.empty()) tracks_[v] = {path, begun_m[v] + now.arc_m};
    tracks_[v].arc_m = arc_near(tracks_[v].path, tracks_[v].arc_m, now.pose);
  }
}

}  // namespace stepwright::fleet
