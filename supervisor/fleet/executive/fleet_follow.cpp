#include "supervisor/fleet/executive/fleet_follow.h"

#include <algorithm>
#include <array>
#include <utility>

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;

constexpr std::array kStates = {"driving", "waiting", "serving", "resting", "lost", "stopped"};
// So near to where it halts a vehicle waits.
constexpr double kHalts_m = 0.5;
constexpr milliseconds kWorthTelling{1'000};

std::size_t stops_before(const MissionProgram& mission, std::size_t step) {
  std::size_t made = 0;
  for (std::size_t k = 0; k < step; ++k) {
    if (mission.steps[k].kind == MissionStepKind::Stop) ++made;
  }
  return made;
}

}  // namespace

const char* to_string(DriveState state) {
  return kStates[static_cast<std::size_t>(state)];
}

FleetFollow::FleetFollow(FleetPlan plan, FleetProgram program, FollowOptions options)
    : plan_(std::move(plan)),
      program_(std::move(program)),
      options_(std::move(options)),
      envelopes_(envelopes_of(plan_)),
      retiming_(envelopes_, plan_.constraints, plan_.schedule),
      vehicles_(plan_.missions.size()),
      begun_(plan_.missions.size(), 0) {
  for (const VehicleMission& mission : plan_.missions) before_.emplace_back(mission.grown.visits.size());
  for (const Precedence& wait : plan_.schedule.precedences) {
    before_[wait.second.vehicle][wait.second.polygon].push_back(wait.first);
  }
  renew_arrivals();
}

FollowNews FleetFollow::take(const FleetReading& reading, milliseconds now) {
  FollowNews news;
  bool finished = true;
  for (std::uint32_t v = 0; v < vehicles_.size(); ++v) {
    const VehicleFollow before = vehicles_[v];
    read_progress(v, reading, news);
    const DriveState state = vehicles_[v].state;
    news.moved_on = news.moved_on || state != before.state || vehicles_[v].waits_for != before.waits_for;
    finished = finished && (state == DriveState::Resting || state == DriveState::Lost);
  }
  for (std::uint32_t v = 0; v < vehicles_.size(); ++v) read_delay(v, reading.vehicles[v], now, news);
  news.finished = finished;
  return news;
}

void FleetFollow::read_progress(std::uint32_t v, const FleetReading& reading, FollowNews& news) {
  const VehicleReading& now = reading.vehicles[v];
  const MissionProgram& mission = program_.missions[v];
  const MissionStep& step = mission.steps[now.step];
  VehicleFollow& known = vehicles_[v];
  if (now.error != 0 && known.error == 0 && !lost(v)) news.errors.push_back(v);
  known.error = now.error;
  known.waits_for.reset();
  if (lost(v)) {
    known.state = DriveState::Lost;
    return;
  }
  // A step FAILED stands behind its stop, which has not been made.
  std::size_t made = stops_before(mission, now.step);
  if (step.kind == MissionStepKind::Failed && made > 0) --made;
  const bool serving = step.kind == MissionStepKind::Stop;
  for (; begun_[v] < made + (serving ? 1 : 0); ++begun_[v]) news.begun.push_back({v, begun_[v]});
  for (; known.stops_done < made; ++known.stops_done) news.stops.push_back({v, known.stops_done});
  if (now.error != 0) {
    known.state = DriveState::Stopped;
  } else if (serving) {
    known.state = DriveState::Serving;
  } else if (step.kind == MissionStepKind::Done) {
    known.state = DriveState::Resting;
  } else {
    known.waits_for = whom_it_waits_for(v, reading);
    known.state = known.waits_for ? DriveState::Waiting : DriveState::Driving;
  }
}

// At the end of what it may drive, before a polygon that somebody else has not left.
std::optional<std::uint32_t> FleetFollow::whom_it_waits_for(std::uint32_t v,
                                                            const FleetReading& reading) const {
  const VehicleReading& now = reading.vehicles[v];
  const MissionStep& step = program_.missions[v].steps[now.step];
  const std::size_t next = step.polygon + 1;
  if (next >= before_[v].size() || now.arc_m < step.permitted_m - kHalts_m) return std::nullopt;
  for (const PolygonRef& first : before_[v][next]) {
    if (reading.vehicles[first.vehicle].areas <= first.polygon) return first.vehicle;
  }
  return std::nullopt;
}

// Who waits for somebody is late because that one is. What was left since the last reading was so in time, or
// has been told then.
void FleetFollow::read_delay(std::uint32_t v, const VehicleReading& now, milliseconds time,
                             FollowNews& news) {
  const DriveState state = vehicles_[v].state;
  if (state == DriveState::Lost || state == DriveState::Stopped || state == DriveState::Waiting) return;
  const auto polygons = static_cast<std::uint32_t>(before_[v].size());
  const std::uint32_t left = std::min(now.areas, polygons - 1);
  const bool rests = state == DriveState::Resting;
  const TimepointRef next{{v, left}, Side::Exit};
  if (!rests && time > retiming_.earliest(next) + options_.late) post(v, left, time, news);
}

void FleetFollow::post(std::uint32_t v, std::uint32_t polygon, milliseconds time, FollowNews& news) {
  const auto begin = std::chrono::steady_clock::now();
  const TimepointRef exit{{v, polygon}, Side::Exit};
  Delay delay{.vehicle = v, .polygon = polygon, .late = time - retiming_.earliest(exit)};
  const std::vector<VehicleFollow> old = vehicles_;
  if (!retiming_.not_before(exit, time)) {
    delay.broken = release_broken();
    static_cast<void>(retiming_.not_before(exit, time));  // nothing forbids it any more
  }
  posted_.emplace_back(exit, time);
  renew_arrivals();
  for (std::uint32_t other = 0; other < vehicles_.size(); ++other) {
    const milliseconds later = vehicles_[other].arrives - old[other].arrives;
    if (other == v) delay.arrives_later = later;
    if (other != v && later >= kWorthTelling) delay.others.push_back(other);
  }
  delay.retime_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  ++retimings_;
  slowest_ms_ = std::max(slowest_ms_, delay.retime_ms);
  // Who waited has left his polygon later than he might have, and may be in time all the same.
  const bool tell = delay.arrives_later >= kWorthTelling || !delay.others.empty() || !delay.broken.empty();
  if (tell) news.delays.push_back(std::move(delay));
}

// Constraints with an end bind no more; orders and what has been posted stay.
std::vector<std::string> FleetFollow::release_broken() {
  std::vector<std::string> names;
  for (const std::uint32_t k : retiming_.broken().constraints) names.push_back(plan_.constraints[k].name);
  for (TemporalConstraint& constraint : plan_.constraints) constraint.distance.most = SpeedLimits{}.horizon;
  retiming_ = Retiming(envelopes_, plan_.constraints, plan_.schedule);
  for (const auto& [at, time] : posted_) static_cast<void>(retiming_.not_before(at, time));
  return names;
}

void FleetFollow::renew_arrivals() {
  for (std::uint32_t v = 0; v < vehicles_.size(); ++v) {
    const auto last = static_cast<std::uint32_t>(before_[v].size() - 1);
    vehicles_[v].arrives = retiming_.earliest({{v, last}, Side::Exit});
    vehicles_[v].delay = vehicles_[v].arrives - plan_.schedule.earliest[v][last].exit;
  }
}

milliseconds FleetFollow::arrives() const {
  milliseconds last{0};
  for (const VehicleFollow& vehicle : vehicles_) last = std::max(last, vehicle.arrives);
  return last;
}

}  // namespace stepwright::fleet
