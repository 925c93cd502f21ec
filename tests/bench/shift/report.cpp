#include "tests/bench/shift/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

namespace stepwright::bench::shift {

namespace {

Spent total(const std::vector<Spent>& spent) {
  Spent sum;
  for (const Spent& s : spent) {
    sum.busy_s += s.busy_s;
    sum.driving_s += s.driving_s;
    sum.serving_s += s.serving_s;
    sum.waiting_s += s.waiting_s;
    sum.held_s += s.held_s;
    sum.paused_s += s.paused_s;
    sum.dead_s += s.dead_s;
    sum.resting_s += s.resting_s;
  }
  return sum;
}

// Deadlines that the oracle keeps and the shift did not.
std::vector<std::size_t> missed(const Scenario& scenario, const ShiftFigures& figures,
                                const std::vector<bool>& kept) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < scenario.transports.size(); ++k) {
    const auto& delivered = figures.deliveries[k].delivered_s;
    const double due_s = scenario.transports[k].due_s;
    const bool late = delivered ? *delivered > due_s : due_s < figures.simulated_s;
    if (late && kept[k]) found.push_back(k);
  }
  return found;
}

std::string missed_text(const Scenario& scenario, const Delivery& d, std::size_t k) {
  const Transport& t = scenario.transports[k];
  const auto place = [&](std::uint32_t station) {
    return fmt::format("{:.1f}, {:.1f} m", scenario.stations[station].x_m, scenario.stations[station].y_m);
  };
  return fmt::format(
      "  transport {} from {} to {}: released {:.0f} s, due {:.0f} s, given to {} at {:.0f} s, picked up at "
      "{:.0f} s, {}\n",
      k, place(t.from), place(t.to), t.release_s, t.due_s,
      d.vehicle ? "v" + std::to_string(*d.vehicle + 1) : "nobody", d.assigned_s.value_or(0.0),
      d.picked_s.value_or(0.0),
      d.delivered_s ? fmt::format("delivered {:.0f} s late", *d.delivered_s - t.due_s)
                    : std::string("not delivered"));
}

double earliest_delivery_s(const Scenario& scenario, const PlantRun& run, std::size_t k) {
  const Transport& t = scenario.transports[k];
  const Ready ready = ready_at(scenario, run.stood, t, run.figures.deliveries[k]);
  return shift::earliest_delivery_s(scenario, run.stood, t, ready, {});
}

std::string reach_text(const Scenario& scenario, const PlantRun& run, std::size_t k) {
  const double least_s = earliest_delivery_s(scenario, run, k);
  if (least_s <= scenario.transports[k].due_s)
    return fmt::format("    no passage was closed for so long: {:.0f} s is not excluded\n", least_s);
  const auto dead = ready_at(scenario, run.stood, scenario.transports[k], run.figures.deliveries[k]).aboard;
  return dead ? fmt::format("    nobody could: v{} died with it, so that none delivers before {:.0f} s\n",
                            *dead + 1, least_s)
              : fmt::format(
                    "    nobody could: what was blocked and who was dead there let none pass before {:.0f} "
                    "s\n",
                    least_s);
}

nlohmann::json json_of(const Times& times) {
  return {{"count", times.ms.size()},
          {"p50_ms", times.quantile(0.5)},
          {"p99_ms", times.quantile(0.99)},
          {"max_ms", times.quantile(1.0)}};
}

}  // namespace

std::vector<bool> can_be_kept(const Scenario& scenario, Fleet& fleet, std::uint32_t vehicles) {
  constexpr std::size_t kNearest = 4;
  std::vector<bool> kept;
  for (const Transport& t : scenario.transports) {
    const geometry::Point from = scenario.stations[t.from].position();
    std::vector<std::uint32_t> nearest(vehicles);
    for (std::uint32_t v = 0; v < vehicles; ++v) nearest[v] = v;
    std::ranges::sort(nearest, {}, [&](std::uint32_t v) {
      return geometry::distance(fleet.planner().home(v).position(), from);
    });
    nearest.resize(std::min<std::size_t>(kNearest, nearest.size()));
    bool found = false;
    for (const std::uint32_t v : nearest) {
      const std::array<fleet::Waypoint, 2> stops = {fleet::Waypoint{scenario.stations[t.from], {}},
                                                    fleet::Waypoint{scenario.stations[t.to], {}}};
      const auto route = fleet.planner().plan(v, fleet.planner().home(v), stops);
      if (!route) continue;
      found =
          found || t.release_s + route->pace.time_s(route->end_m()) + t.pick_up_s + t.set_down_s <= t.due_s;
    }
    kept.push_back(found);
  }
  return kept;
}

Summary summary_of(const Scenario& scenario, const ShiftFigures& figures) {
  Summary made;
  made.released = scenario.transports.size();
  double tardiness_s = 0.0, delivery_s = 0.0;
  for (std::size_t k = 0; k < made.released; ++k) {
    const Transport& t = scenario.transports[k];
    const auto& delivered = figures.deliveries[k].delivered_s;
    if (delivered) {
      ++made.delivered;
      tardiness_s += std::max(0.0, *delivered - t.due_s);
      delivery_s += *delivered - t.release_s;
    }
    if (delivered ? *delivered > t.due_s : t.due_s < figures.simulated_s) ++made.late;
  }
  if (made.delivered > 0) {
    made.mean_tardiness_s = tardiness_s / static_cast<double>(made.delivered);
    made.mean_delivery_s = delivery_s / static_cast<double>(made.delivered);
  }
  if (!figures.spent.empty() && figures.simulated_s > 0.0)
    made.utilisation =
        total(figures.spent).busy_s / (static_cast<double>(figures.spent.size()) * figures.simulated_s);
  return made;
}

std::string text_of(const Scenario& scenario, const PlantRun& run, const std::vector<bool>& kept_by_oracle) {
  const ShiftFigures& f = run.figures;
  const Summary s = summary_of(scenario, f);
  const Spent spent = total(f.spent);
  const double all_s = static_cast<double>(f.spent.size()) * f.simulated_s;
  const auto share = [&](double part_s) { return 100.0 * part_s / all_s; };
  std::string text = fmt::format(
      "{} vehicles, {:.2f} h, {} transports: {} delivered ({:.1f} an hour), {} late, mean {:.0f} s from "
      "release; contacts {}\n"
      "judge: {} collisions in {} outlines, smallest gap of two vehicles {:.2f} m, {} deadlocks, longest "
      "wait {:.0f} s\n"
      "spent: jobs {:.1f} %; driving {:.1f}, at stops {:.1f}, waiting for others {:.1f}, before blocked "
      "places {:.1f}, "
      "paused {:.1f}, dead {:.1f}, resting {:.1f} %\n"
      "blocked places and dead vehicles: {} took another way, {} went home, {} waited; lost from their path: "
      "{}, farthest "
      "from it {:.2f} m\n",
      f.spent.size(), f.simulated_s / 3600.0, s.released, s.delivered,
      3600.0 * static_cast<double>(s.delivered) / f.simulated_s, s.late, s.mean_delivery_s, run.contacts,
      run.collisions.size(), run.outline_checks, run.smallest_gap_m, run.deadlocks.size(), run.longest_wait_s,
      100.0 * s.utilisation, share(spent.driving_s), share(spent.serving_s), share(spent.waiting_s),
      share(spent.held_s), share(spent.paused_s), share(spent.dead_s), share(spent.resting_s), f.rerouted,
      f.sent_home, f.waited, run.lost, run.largest_deviation_m);
  text += "decisions (CPU ms)        count      p50      p99      max\n";
  for (const auto& [cause, times] : f.decisions.times)
    text += fmt::format("  {:<20} {:8} {:8.2f} {:8.2f} {:8.2f}\n", cause, times.ms.size(),
                        times.quantile(0.5), times.quantile(0.99), times.quantile(1.0));
  text += fmt::format("  {:<20} {:8} {:8.4f} {:8.4f} {:8.4f}\n", "delay: new times", f.retimes.ms.size(),
                      f.retimes.quantile(0.5), f.retimes.quantile(0.99), f.retimes.quantile(1.0));
  for (const auto& [code, count] : f.decisions.refused)
    text += fmt::format("  refused with {}: {}\n", code, count);
  const auto not_kept = missed(scenario, f, kept_by_oracle);
  text += fmt::format("oracle (each transport alone): keeps {} of {} deadlines; {} of these were missed\n",
                      std::ranges::count(kept_by_oracle, true), s.released, not_kept.size());
  for (const std::size_t k : not_kept) {
    text += missed_text(scenario, f.deliveries[k], k);
    text += reach_text(scenario, run, k);
  }
  text += fmt::format("CPU {:.1f} s: plant {:.1f}, control {:.1f}, judge {:.1f}\n", f.cpu_s, f.plant_cpu_s,
                      f.control_cpu_s, f.judge_cpu_s);
  for (const Collision& c : run.collisions)
    text += fmt::format("  COLLISION {:.2f} s: v{} with {}\n", c.time_s, c.vehicle + 1, c.with);
  for (const std::string& deadlock : run.deadlocks) text += "  DEADLOCK " + deadlock + "\n";
  for (const std::string& broken : run.broken) text += "  INVARIANT " + broken + "\n";
  return text;
}

// Of the deadlines that were missed those that no fleet could have kept, with who was dead where he was.
std::vector<std::size_t> out_of_reach(const Scenario& scenario, const PlantRun& run,
                                      const std::vector<std::size_t>& missed) {
  std::vector<std::size_t> found;
  std::ranges::copy_if(missed, std::back_inserter(found), [&](std::size_t k) {
    return earliest_delivery_s(scenario, run, k) > scenario.transports[k].due_s;
  });
  return found;
}

nlohmann::json json_of(const Scenario& scenario, const PlantRun& run,
                       const std::vector<bool>& kept_by_oracle) {
  const ShiftFigures& f = run.figures;
  const Summary s = summary_of(scenario, f);
  const Spent spent = total(f.spent);
  nlohmann::json json = {
      {"vehicles", f.spent.size()},
      {"simulated_s", f.simulated_s},
      {"released", s.released},
      {"delivered", s.delivered},
      {"late", s.late},
      {"mean_delivery_s", s.mean_delivery_s},
      {"utilisation", s.utilisation},
      {"collisions", run.collisions.size()},
      {"contacts", run.contacts},
      {"deadlocks", run.deadlocks.size()},
      {"broken_invariants", run.broken.size()},
      {"lost", run.lost},
      {"longest_wait_s", run.longest_wait_s},
      {"smallest_gap_m", run.smallest_gap_m},
      {"largest_deviation_m", run.largest_deviation_m},
      {"outline_checks", run.outline_checks},
      {"rerouted", f.rerouted},
      {"sent_home", f.sent_home},
      {"waited", f.waited},
      {"delays", f.delays},
      {"cpu_s", f.cpu_s},
      {"plant_cpu_s", f.plant_cpu_s},
      {"control_cpu_s", f.control_cpu_s},
      {"judge_cpu_s", f.judge_cpu_s},
      {"retime", json_of(f.retimes)},
      {"driving_s", spent.driving_s},
      {"at_stops_s", spent.serving_s},
      {"waiting_s", spent.waiting_s},
      {"held_s", spent.held_s},
      {"paused_s", spent.paused_s},
      {"dead_s", spent.dead_s},
      {"resting_s", spent.resting_s},
      {"log", run.log},
      {"oracle_keeps", std::ranges::count(kept_by_oracle, true)},
      {"missed_but_kept_by_oracle", missed(scenario, f, kept_by_oracle)},
      {"missed_out_of_reach", out_of_reach(scenario, run, missed(scenario, f, kept_by_oracle))}};
  for (const auto& [cause, times] : f.decisions.times) json["decisions"][cause] = json_of(times);
  for (const auto& [code, count] : f.decisions.refused) json["refused"][code] = count;
  return json;
}

}  // namespace stepwright::bench::shift
