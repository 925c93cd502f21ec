#include "supervisor/fleet/vda5050/clearances.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fleet/split_mix.h"
#include "tests/support/vda5050/made_missions.h"

namespace stepwright::fleet::vda5050 {
namespace {

using support::SplitMix64;

// A plan of which only the number of polygons and the precedences count.
FleetPlan bare_plan(std::uint32_t vehicles, std::uint32_t polygons, SplitMix64& random) {
  const std::vector<geometry::Point> corners{{0, 0}, {1, 0}, {0, 1}};
  const EnvelopePolygon polygon{*geometry::ConvexPolygon::hull(corners), {}, {}};
  FleetPlan plan;
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    VehicleMission mission;
    mission.grown.envelope.polygons.assign(1 + random.below(polygons), polygon);
    plan.missions.push_back(mission);
  }
  const auto count = random.below(3 * vehicles);
  for (std::uint64_t k = 0; k < count; ++k) {
    const auto a = static_cast<std::uint32_t>(random.below(vehicles));
    const auto b = static_cast<std::uint32_t>(random.below(vehicles));
    if (a == b) continue;
    const auto of = [&](std::uint32_t v) {
      return PolygonRef{
          v, static_cast<std::uint32_t>(random.below(plan.missions[v].grown.envelope.polygons.size()))};
    };
    plan.schedule.precedences.push_back({of(a), of(b)});
  }
  return plan;
}

struct Plain {
  std::vector<std::uint32_t> clear, left;
};

// The definition in the header, again and again over everything until nothing changes.
Plain plain(const FleetPlan& plan, const std::vector<std::uint32_t>& reached) {
  const std::size_t vehicles = plan.missions.size();
  Plain state{std::vector<std::uint32_t>(vehicles, 0), std::vector<std::uint32_t>(vehicles, 0)};
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t v = 0; v < vehicles; ++v) {
      std::uint32_t clear = 0;
      const auto met = [&](std::uint32_t polygon) {
        return std::ranges::all_of(plan.schedule.precedences, [&](const Precedence& p) {
          return p.second != PolygonRef{v, polygon} || p.first.polygon < state.left[p.first.vehicle];
        });
      };
      while (clear < plan.missions[v].grown.envelope.polygons.size() && met(clear)) ++clear;
      const std::uint32_t left = std::min(reached[v], clear == 0 ? 0 : clear - 1);
      changed = changed || clear != state.clear[v] || left != state.left[v];
      state.clear[v] = clear;
      state.left[v] = left;
    }
  }
  return state;
}

TEST(Clearances, Reached_WhenVehiclesGoOnAtRandom_ThenAsTheDefinitionSays) {
  SplitMix64 random(7);
  std::size_t grown_at_once = 0;
  for (int round = 0; round < 300; ++round) {
    const FleetPlan plan = bare_plan(2 + static_cast<std::uint32_t>(round) % 5, 6, random);
    Clearances clearances(plan);
    std::vector<std::uint32_t> reached(plan.missions.size(), 0);
    for (int step = 0; step < 25; ++step) {
      const Plain before = plain(plan, reached);
      const auto v = static_cast<std::uint32_t>(random.below(reached.size()));
      const auto polygon =
          static_cast<std::uint32_t>(random.below(plan.missions[v].grown.envelope.polygons.size()));
      reached[v] = std::max(reached[v], polygon);
      const auto grown = clearances.reached(v, polygon);
      const Plain now = plain(plan, reached);
      for (std::uint32_t k = 0; k < reached.size(); ++k) {
        ASSERT_EQ(clearances.clear(k), now.clear[k]) << round << " " << k;
        ASSERT_EQ(clearances.left(k), now.left[k]) << round << " " << k;
        ASSERT_EQ(std::ranges::count(grown, k), now.clear[k] > before.clear[k] ? 1 : 0) << round << " " << k;
      }
      grown_at_once = std::max(grown_at_once, grown.size());
    }
  }
  EXPECT_GT(grown_at_once, 1u);  // chains of vehicles have been seen
}

}  // namespace
}  // namespace stepwright::fleet::vda5050
