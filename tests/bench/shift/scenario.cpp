#include "tests/bench/shift/scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::bench::shift {

namespace {

using support::SplitMix64;

double exponential(SplitMix64& random, double mean) {
  return -mean * std::log(1.0 - random.between(0.0, 1.0));
}

void draw_transports(SplitMix64& random, Scenario& scenario) {
  const auto docks = static_cast<std::uint64_t>(scenario.hall.docks.size());
  const auto shelves = static_cast<std::uint64_t>(scenario.hall.shelves.size());
  const double mean_s = 3600.0 / scenario.settings.transports_per_hour;
  // Nothing new in the last quarter of an hour, or the last third of a short shift.
  const double last_s = scenario.end_s() - std::min(900.0, scenario.end_s() / 3.0);
  for (double at_s = exponential(random, mean_s); at_s < last_s; at_s += exponential(random, mean_s)) {
    const auto dock = static_cast<std::uint32_t>(random.below(docks));
    const auto shelf = static_cast<std::uint32_t>(docks + random.below(shelves));
    const bool inbound = random.below(2) == 0;
    Transport transport{at_s, 0.0, inbound ? dock : shelf, inbound ? shelf : dock, 0.0, 0.0};
    transport.due_s = at_s + random.between(420.0, 1200.0);
    transport.pick_up_s = kService_s + exponential(random, 5.0) - 4.0;
    transport.set_down_s = kService_s + exponential(random, 5.0) - 4.0;
    scenario.transports.push_back(transport);
  }
}

void draw_places(Scenario& scenario) {
  for (const double x : {28.0, 44.0, 82.0}) {
    for (int aisle = 0; aisle < 6; ++aisle)
      scenario.places.push_back({{x, 16.2 + 6.0 * aisle}, {x + 3.0, 19.8 + 6.0 * aisle}});
  }
  for (const double x : {33.4, 61.4}) scenario.places.push_back({{x, 26.2}, {x + 5.2, 29.8}});
}

void draw_closings(SplitMix64& random, Scenario& scenario) {
  const auto wanted =
      static_cast<std::uint32_t>(std::ceil(scenario.settings.blockages_per_hour * scenario.settings.hours));
  std::map<std::uint32_t, double> closed_until;
  for (std::uint32_t k = 0; k < wanted; ++k) {
    const double slot_s = 0.8 * scenario.end_s() / wanted;
    Closing closing;
    closing.begin_s = slot_s * (k + random.between(0.2, 0.8));
    closing.seconds = std::min(random.between(300.0, 1200.0), 0.3 * scenario.end_s());
    closing.place = static_cast<std::uint32_t>(random.below(scenario.places.size()));
    if (closed_until[closing.place] > closing.begin_s) continue;
    closed_until[closing.place] = closing.begin_s + closing.seconds + 300.0;
    scenario.closings.push_back(closing);
  }
}

void draw_pauses(SplitMix64& random, Scenario& scenario) {
  const double mean_s = 3600.0 / scenario.settings.pauses_per_hour;
  for (std::uint32_t v = 0; v < scenario.settings.vehicles; ++v) {
    for (double at_s = exponential(random, mean_s); at_s < scenario.end_s();
         at_s += exponential(random, mean_s))
      scenario.pauses.push_back({v, at_s, random.between(5.0, 60.0)});
  }
  std::ranges::sort(scenario.pauses, {}, &Pause::begin_s);
}

void draw_breakdowns(SplitMix64& random, Scenario& scenario) {
  const auto wanted = static_cast<std::uint32_t>(
      std::max(1.0, std::floor(scenario.settings.breakdowns_per_hour * scenario.settings.hours)));
  for (std::uint32_t k = 0; k < wanted; ++k) {
    const double slot_s = 0.7 * scenario.end_s() / wanted;
    Breakdown breakdown;
    breakdown.vehicle = static_cast<std::uint32_t>(random.below(scenario.settings.vehicles));
    breakdown.begin_s = slot_s * (k + random.between(0.4, 0.9));
    breakdown.seconds = std::min(random.between(300.0, 1500.0), 0.25 * scenario.end_s());
    breakdown.for_good = k + 1 == wanted && wanted > 1;
    const bool twice = std::ranges::any_of(
        scenario.breakdowns, [&](const Breakdown& other) { return other.vehicle == breakdown.vehicle; });
    if (!twice) scenario.breakdowns.push_back(breakdown);
  }
}

}  // namespace

geometry::ConvexPolygon Rectangle::polygon() const {
  const std::array<geometry::Point, 4> corners = {low, geometry::Point{high.x_m, low.y_m}, high,
                                                  geometry::Point{low.x_m, high.y_m}};
  return *geometry::ConvexPolygon::hull(corners);
}

// Each kind of event has its own random numbers, so that more of one changes nothing in the others.
Scenario draw_scenario(const ScenarioSettings& settings) {
  Scenario scenario{settings, support::draw_hall(), {}, {}, {}, {}, {}, {}};
  scenario.stations = scenario.hall.docks;
  scenario.stations.insert(scenario.stations.end(), scenario.hall.shelves.begin(),
                           scenario.hall.shelves.end());
  const auto stream = [&](std::uint64_t number) { return SplitMix64(16 * settings.seed + number); };
  SplitMix64 transports = stream(0), closings = stream(1), pauses = stream(2), breakdowns = stream(3);
  draw_places(scenario);
  draw_transports(transports, scenario);
  draw_closings(closings, scenario);
  draw_pauses(pauses, scenario);
  draw_breakdowns(breakdowns, scenario);
  return scenario;
}

}  // namespace stepwright::bench::shift
