// Watching one plan: events, progress, delays, requests.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/fleet/executive/fleet_executive.h"
#include "supervisor/fleet/executive/standing.h"
#include "supervisor/fleet/executive/stop_cause.h"

namespace stepwright::fleet {

using run::IncidentKind;
using run::Response;
using std::chrono::milliseconds;

namespace {

milliseconds since(double epoch_s, double now_s) {
  return milliseconds(std::llround(1e3 * (now_s - epoch_s)));
}

}  // namespace

run::Decision FleetExecutive::judge_image(std::span<const std::byte> image) {
  reading_ = reader_->read(image);
  const FollowNews news = follow_->take(reading_, plan_clock());
  note(news);
  if (reading_.emergency_stop) return {run::Verdict::Hold};
  if (!news.errors.empty()) return {run::Verdict::Replan, lose(news.errors, reading_, {})};
  if (auto cause = due(clock_.now_s())) return {run::Verdict::Replan, *std::move(cause)};
  return {news.finished ? run::Verdict::Finished : run::Verdict::GoOn};
}

// Forks go down without a program: nobody knows where loads are.
run::Decision FleetExecutive::stopped(const host::StepEvent& event) {
  const bool unattended = event.cause == scan::SafeCause::SupervisorLost;
  return run::give_up_because(unattended ? IncidentKind::LostSupervisor : IncidentKind::Operator,
                              "stopped from outside: " + event.detail);
}

void FleetExecutive::note(const FollowNews& news) {
  for (const StopMade& stop : news.begun) note_stop(stop, true);
  for (const StopMade& stop : news.stops) note_stop(stop, false);
  for (const Delay& delay : news.delays) note_delay(delay);
  changed_ = changed_ || news.moved_on || !news.begun.empty() || !news.stops.empty() || !news.delays.empty();
}

// A stop that has begun ends by itself: for what remains it counts as made.
void FleetExecutive::note_stop(const StopMade& stop, bool begun) {
  const VehicleMission& mission = follow_->plan().missions[stop.vehicle];
  run::ActionRecord& action = record_.episodes.back().actions[action_of(stop)];
  if (begun) {
    begun_[stop.vehicle] = first_clock();
    ledger_.made(stop.vehicle, mission.stops[stop.stop], first_clock());
    action.state = run::ActionState::Active;
    if (!action.started_s) action.started_s = clock_.now_s();  // a journal may know better
    return;
  }
  ledger_.ended(mission.stops[stop.stop], begun_[stop.vehicle], first_clock());
  action.state = run::ActionState::Done;
  if (!action.finished_s) action.finished_s = clock_.now_s();
  record_.finished_s = clock_.now_s();
}

std::size_t FleetExecutive::action_of(const StopMade& stop) const {
  std::size_t index = stop.stop;
  for (std::uint32_t v = 0; v < stop.vehicle; ++v) index += follow_->plan().missions[v].stops.size();
  return index;
}

void FleetExecutive::note_delay(const Delay& delay) {
  const auto& missions = follow_->plan().missions;
  ledger_.mark_late(delay.broken);
  const auto seconds = [](milliseconds time) { return 1e-3 * static_cast<double>(time.count()); };
  std::string text = fmt::format("{} is {:.1f} s late in its polygon {} and arrives {:.1f} s later",
                                 missions[delay.vehicle].vehicle, seconds(delay.late), delay.polygon,
                                 seconds(delay.arrives_later));
  if (!delay.others.empty()) {
    text += "; later for it:";
    for (const std::uint32_t v : delay.others) text += " " + missions[v].vehicle;
  }
  std::vector<std::string> evidence = {std::move(text)};
  for (const std::string& name : delay.broken) evidence.push_back("'" + name + "' cannot be kept any more");
  open_incident({IncidentKind::Timeout, std::move(evidence), missions[delay.vehicle].vehicle});
  record_.incidents.back().retime_ms = delay.retime_ms;
  decide(Response::GoOn);
}

// Vehicles that have stopped by themselves take no part any more; where they stand nobody is to drive.
run::Cause FleetExecutive::lose(const std::vector<std::uint32_t>& errors, const FleetReading& reading,
                                const std::vector<double>& begun_m) {
  run::Cause cause;
  for (const std::uint32_t v : errors) {
    const VehicleReading& now = reading.vehicles[v];
    const StopCause why = stop_cause(now.error);
    const double arc_m = now.arc_m + (begun_m.empty() ? 0.0 : begun_m[v]);
    tracks_[v] = {plan_->answer.plan.missions[v].path, arc_m};
    const std::string& name = planning_.problem().vehicles[v].name;
    const std::string reason = fmt::format("{} at ({:.1f} m, {:.1f} m), error {}", why.sentence, now.pose.x_m,
                                           now.pose.y_m, now.error);
    cause.kind = why.kind;
    cause.action = name;
    cause.evidence.push_back(name + ": " + reason);
    ledger_.lose(v, reason);
    const geometry::Footprint outline = planning_.model(v).footprint();
    const auto place = why.place_unsure ? place_around(now.pose, outline, 0.75, 0.15)
                                        : place_around(now.pose, outline, 0.05, 0.05);
    standing_[v] = Standing{v, now.pose, place};
  }
  return cause;
}

std::optional<run::Cause> FleetExecutive::due(double time_s) {
  const std::vector<TimedRequest> due = requests_.take(time_s);
  if (due.empty()) return std::nullopt;
  run::Cause all;
  bool replan = false;
  for (const TimedRequest& request : due) {
    run::Cause cause;
    const bool needed = std::visit([&](const auto& asked) { return apply(asked, cause); }, request.change);
    all.kind = cause.kind;
    all.action = cause.action;
    all.evidence.insert(all.evidence.end(), cause.evidence.begin(), cause.evidence.end());
    replan = replan || needed;
  }
  changed_ = true;
  if (replan) return all;
  open_incident(all);
  decide(Response::GoOn);
  return std::nullopt;
}

bool FleetExecutive::apply(const OrderChange& order, run::Cause& cause) {
  const auto& goals = ledger_.problem().goals;
  const bool known = std::ranges::find(goals, order.name, &MissionGoal::name) != goals.end();
  cause.kind = known ? IncidentKind::ChangedDemand : IncidentKind::NewGoal;
  const std::string text =
      fmt::format("'{}': {} from {} to {}", order.name, order.amount, order.from, order.to);
  auto taken = ledger_.order(order.name, order.from, order.to, order.amount);
  if (!taken) {
    cause.evidence.push_back(text + " was refused: " + taken.error().front().message);
    return false;
  }
  cause.evidence.push_back((known ? "changed " : "ordered ") + text);
  ordered_ = true;
  return true;
}

// Whether somebody is still to drive there; while there is no plan anybody may be.
bool FleetExecutive::crosses(const geometry::ConvexPolygon& area) const {
  if (planless()) return true;
  const FleetPlan& plan = follow_->plan();
  for (std::size_t v = 0; v < plan.missions.size(); ++v) {
    if (ledger_.vehicles()[v].lost) continue;
    const geometry::Footprint outline = plan.missions[v].model.footprint();
    const double here_m =
        reading_.vehicles.empty() ? 0.0 : reading_.vehicles[v].arc_m;  // not read before a start
    for (const geometry::PathPose& at : plan.missions[v].path) {
      const bool ahead = at.arc_m >= here_m;
      if (ahead && geometry::overlaps(geometry::footprint_at(at.pose, outline), area)) return true;
    }
  }
  return false;
}

bool FleetExecutive::apply(const BlockChange& block, run::Cause& cause) {
  cause.kind = IncidentKind::Position;
  std::erase_if(blocked_, [&](const Blocked& place) { return place.name == block.place.name; });
  blocked_.push_back(block.place);
  const bool concerned = crosses(block.place.area);
  const geometry::Point middle = block.place.area.centroid();
  cause.evidence.push_back(fmt::format("{} is blocked at ({:.1f} m, {:.1f} m){}", block.place.name,
                                       middle.x_m, middle.y_m,
                                       concerned ? "" : "; nobody is to drive there"));
  return concerned;
}

bool FleetExecutive::apply(const UnblockChange& unblock, run::Cause& cause) {
  cause.kind = IncidentKind::Position;
  const auto known =
      std::erase_if(blocked_, [&](const Blocked& place) { return place.name == unblock.name; });
  cause.evidence.push_back(unblock.name + (known > 0 ? " is free again" : " was not blocked"));
  if (known == 0) return false;
  bool waited_for = ledger_.reopen() || planless();
  for (std::uint32_t v = 0; v < ledger_.vehicles().size(); ++v) waited_for = waited_for || shut_in(v);
  return waited_for;
}

bool FleetExecutive::apply(const ReturnChange& back, run::Cause& cause) {
  cause.kind = IncidentKind::Position;
  cause.action = back.vehicle;
  const auto& vehicles = planning_.problem().vehicles;
  const auto found = std::ranges::find(vehicles, back.vehicle, &MissionVehicle::name);
  const auto v = static_cast<std::uint32_t>(found - vehicles.begin());
  if (found == vehicles.end() || !ledger_.vehicles()[v].lost) {
    cause.evidence.push_back("'" + back.vehicle + "' was not lost");
    return false;
  }
  ledger_.find(v);
  returning_[v] = std::exchange(standing_[v], std::nullopt);
  resets_[v] = true;
  ledger_.reopen();
  cause.evidence.push_back(back.vehicle + " is to come back");
  return true;
}

bool FleetExecutive::apply(const HoldChange&, run::Cause& cause) {
  return hold_.want(cause);
}

bool FleetExecutive::apply(const ResumeChange&, run::Cause& cause) {
  return hold_.resume(cause, !reading_.emergency_stop);
}

milliseconds FleetExecutive::plan_clock() const {
  return since(epoch_s_, clock_.now_s());
}

milliseconds FleetExecutive::first_clock() const {
  return since(first_epoch_s_, clock_.now_s());
}

}  // namespace stepwright::fleet
