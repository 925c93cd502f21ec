#include "tests/bench/shift/dispatcher.h"

#include <algorithm>
#include <utility>

namespace stepwright::bench::shift {

namespace {

using std::chrono::milliseconds;

constexpr double kAgain_s = 15.0;  // after a refusal
constexpr std::size_t kAtOnce = 4;

double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

std::vector<DispatchRule::Choice> EarliestDueNearestVehicle::choose(std::span<const Waiting> waiting,
                                                                    std::span<const FreeVehicle> free) const {
  std::vector<Waiting> by_due(waiting.begin(), waiting.end());
  std::ranges::stable_sort(by_due, {}, &Waiting::due_s);
  std::vector<FreeVehicle> left(free.begin(), free.end());
  std::vector<Choice> choices;
  for (const Waiting& transport : by_due) {
    if (left.empty() || choices.size() == kAtOnce) break;
    const auto nearest = std::ranges::min_element(left, {}, [&](const FreeVehicle& vehicle) {
      const bool refused = std::ranges::find(transport.not_by, vehicle.vehicle) != transport.not_by.end();
      const double way_m = geometry::distance(vehicle.place.position(), transport.from.position());
      return std::pair(refused, way_m);
    });
    choices.push_back({transport.transport, nearest->vehicle});
    left.erase(nearest);
  }
  return choices;
}

Dispatcher::Dispatcher(const Scenario& scenario, fleet::Traffic& traffic, fleet::RoutePlanner& planner,
                       const DispatchRule& rule, ShiftFigures& figures)
    : scenario_(scenario),
      traffic_(traffic),
      planner_(planner),
      rule_(rule),
      figures_(figures),
      jobs_(traffic.vehicles()),
      not_before_s_(scenario.transports.size(), 0.0),
      not_by_(scenario.transports.size()) {
  figures_.deliveries.resize(scenario.transports.size());
}

fleet::Waypoint Dispatcher::stop_at(std::uint32_t transport, bool set_down) const {
  const Transport& t = scenario_.transports[transport];
  fleet::Stop stop;
  stop.kind = set_down ? fleet::StopKind::SetDown : fleet::StopKind::PickUp;
  stop.location = std::to_string(set_down ? t.to : t.from);
  stop.goal = std::to_string(transport);
  stop.amount = 1;
  stop.aboard = set_down ? 0 : 1;
  stop.service = milliseconds(static_cast<int>(1000.0 * kService_s));
  return {scenario_.stations[set_down ? t.to : t.from], stop};
}

bool Dispatcher::assign(std::uint32_t vehicle, std::uint32_t transport, bool loaded, milliseconds now) {
  const double begin_s = cpu_s();
  const auto branch = traffic_.branch(vehicle);
  if (!branch) return false;
  std::vector<fleet::Waypoint> stops;
  if (!loaded) stops.push_back(stop_at(transport, false));
  stops.push_back(stop_at(transport, true));
  stops.push_back({planner_.home(vehicle), {}});
  stops.back().stop.location = "home";
  const auto route = planner_.plan(vehicle, branch->place, stops);
  const double planned_s = cpu_s();
  const auto change = route ? traffic_.reroute(vehicle, *branch, *route, now)
                            : result::Result<fleet::Change>(tl::unexpected(route.error()));
  const double end_s = cpu_s();
  figures_.decisions.times["mission"].ms.push_back(1e3 * (end_s - begin_s));
  if (route) figures_.decisions.times["mission: schedule"].ms.push_back(1e3 * (end_s - planned_s));
  if (!change) {
    ++figures_.decisions.refused[change.error().front().code];
    return false;
  }
  figures_.decisions.orders_kept += change->orders_kept ? 1 : 0;
  jobs_[vehicle] = Job{transport, loaded, false};
  figures_.deliveries[transport].assigned_s = seconds(now);
  figures_.deliveries[transport].vehicle = vehicle;
  rerouted_.push_back(vehicle);
  return true;
}

void Dispatcher::dispatch(milliseconds now) {
  const double now_s = seconds(now);
  // Jobs whose stops could not be reached for a time.
  for (std::uint32_t v = 0; v < jobs_.size(); ++v) {
    if (!jobs_[v] || !jobs_[v]->given_up || traffic_.removed(v) || traffic_.held(v)) continue;
    const Job job = *jobs_[v];
    if (not_before_s_[job.transport] > now_s) continue;
    if (!assign(v, job.transport, job.loaded, now)) not_before_s_[job.transport] = now_s + kAgain_s;
  }
  std::vector<Waiting> waiting;
  for (const std::uint32_t t : open_) {
    if (not_before_s_[t] > now_s) continue;
    waiting.push_back(
        {t, scenario_.transports[t].due_s, scenario_.stations[scenario_.transports[t].from], not_by_[t]});
  }
  if (waiting.empty()) return;
  std::vector<FreeVehicle> free;
  for (std::uint32_t v = 0; v < jobs_.size(); ++v) {
    if (jobs_[v] || traffic_.removed(v) || traffic_.held(v)) continue;
    const auto branch = traffic_.branch(v);
    if (!branch) continue;
    const bool here = branch->arc_m - traffic_.arc_m(v) < 0.05;
    if (here || !only_standing_) free.push_back({v, branch->place});
  }
  for (const DispatchRule::Choice& choice : rule_.choose(waiting, free)) {
    if (assign(choice.vehicle, choice.transport, false, now)) {
      std::erase(open_, choice.transport);
      not_by_[choice.transport].clear();
    } else {
      // Each is asked once before anybody is asked again.
      auto& refused = not_by_[choice.transport];
      if (std::ranges::find(refused, choice.vehicle) != refused.end()) refused.clear();
      refused.push_back(choice.vehicle);
      not_before_s_[choice.transport] = now_s + kAgain_s;
    }
  }
}

double Dispatcher::service_s(std::uint32_t vehicle) const {
  if (!jobs_[vehicle]) return 0.0;
  const Transport& transport = scenario_.transports[jobs_[vehicle]->transport];
  return jobs_[vehicle]->loaded ? transport.set_down_s : transport.pick_up_s;
}

void Dispatcher::stood(std::uint32_t vehicle, double now_s) {
  auto& job = jobs_[vehicle];
  if (!job) return;
  Delivery& delivery = figures_.deliveries[job->transport];
  if (job->loaded) {
    delivery.delivered_s = now_s;
    job.reset();
  } else {
    delivery.picked_s = now_s;
    job->loaded = true;
  }
}

void Dispatcher::take(const std::vector<fleet::Detour>& detours) {
  for (const fleet::Detour& detour : detours) {
    if (detour.kind == fleet::DetourKind::Waits) ++figures_.waited;
    if (detour.kind == fleet::DetourKind::Rerouted) ++figures_.rerouted;
    if (detour.kind == fleet::DetourKind::Rerouted || detour.kind == fleet::DetourKind::SentHome)
      rerouted_.push_back(detour.vehicle);
    if (detour.kind != fleet::DetourKind::SentHome) continue;
    ++figures_.sent_home;
    auto& job = jobs_[detour.vehicle];
    if (!job) continue;
    if (job->loaded) {
      job->given_up = true;
    } else {
      open_.push_back(job->transport);
      job.reset();
    }
  }
}

void Dispatcher::died(std::uint32_t vehicle) {
  auto& job = jobs_[vehicle];
  if (!job || job->loaded) return;
  open_.push_back(job->transport);
  job.reset();
}

std::vector<std::uint32_t> Dispatcher::take_rerouted() {
  return std::exchange(rerouted_, {});
}

}  // namespace stepwright::bench::shift
