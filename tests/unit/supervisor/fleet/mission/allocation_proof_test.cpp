// What plan_fleet says of loads that no vehicles can carry in time, beside the schedules of all allocations
// of random small problems: every load by every vehicle in every order, on the shortest paths, one by one.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "supervisor/fleet/mission/internal/mission_builder.h"
#include "supervisor/fleet/mission/internal/moments.h"
#include "supervisor/fleet/mission/plan_fleet.h"
#include "tests/unit/supervisor/fleet/mission/small_floor.h"

namespace stepwright::fleet {
namespace {

using internal::Route;
using std::chrono::milliseconds;

constexpr milliseconds kNever{100'000'000};

// Two vehicles and two loads in a hall with a wall, one at most from each place to another.
class RandomProblems {
 public:
  explicit RandomProblems(std::uint32_t seed) : random_(seed) {}

  MissionProblem next() {
    MissionProblem problem = empty_problem();
    wall(problem, 18, 9, 22, 24);
    const geometry::Pose starts[] = {{4, 5, 0}, {4, 12, 0}, {34, 19, 3.14159}};
    const std::size_t without = below(3);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == without) continue;
      const std::size_t v = add_vehicle(problem, "v" + std::to_string(k), starts[k]);
      problem.vehicles[v].capacity = 1 + static_cast<std::uint32_t>(below(2));
      problem.vehicles[v].available = milliseconds(below(2) * below(20'000));
    }
    const geometry::Pose places[] = {{12, 5, 0}, {12, 17, 1.5708}, {28, 5, 0}, {30, 14, -1.5708}};
    for (const geometry::Pose& pose : places) {
      add_location(problem, "place", pose, milliseconds(below(2) * below(15'000)));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t from = below(4);
      problem.goals.push_back({.name = "load " + std::to_string(k),
                               .amount = 1,
                               .from = from,
                               .to = (from + 1 + below(3)) % 4,
                               .key = "goals"});
    }
    return problem;
  }

  // Limits near what the times of some schedule are: they decide which allocations are left.
  void add_limits(MissionProblem& problem, const std::vector<std::vector<milliseconds>>& ends) {
    const std::size_t goal = below(2);
    const auto soonest = std::ranges::min_element(ends, {}, [&](const auto& times) { return times[goal]; });
    const auto& some = below(2) == 0 ? *soonest : ends[below(ends.size())];
    const milliseconds slack[] = {milliseconds(0), milliseconds(-1), milliseconds(-30), milliseconds(-4'000)};
    add(problem, {}, {Moment::GoalEnd, goal}, {milliseconds(0), some[goal] + slack[below(4)]});
    if (below(2) == 0) {
      add(problem, {}, {Moment::GoalEnd, 1 - goal}, {milliseconds(0), some[1 - goal] + slack[below(4)]});
    }
    if (below(3) == 0) {
      add(problem, {Moment::GoalEnd, goal}, {Moment::GoalStart, 1 - goal},
          {milliseconds(below(30'000)), kNever});
    }
    if (below(4) == 0) add(problem, {}, {Moment::GoalStart, goal}, {milliseconds(below(40'000)), kNever});
    if (below(4) == 0) add(problem, {}, {Moment::GoalEnd, goal}, {milliseconds(below(90'000)), kNever});
    if (below(4) == 0) {
      add(problem, {Moment::GoalStart, goal}, {Moment::GoalStart, 1 - goal},
          {-kNever, milliseconds(below(30'000))});
    }
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  static void add(MissionProblem& problem, MomentRef from, MomentRef to, Bounds distance) {
    problem.constraints.push_back(
        {.name = "limit", .from = from, .to = to, .distance = distance, .key = "constraints"});
  }

  std::mt19937 random_;
};

// All ways to carry the loads 0 and 1, as far as the capacity allows.
class Allocations {
 public:
  explicit Allocations(const MissionProblem& problem) : problem_(problem), routes_(problem.vehicles.size()) {
    extend(0);
  }
  std::vector<std::vector<Route>> all;

 private:
  // What is done next of a load: picked up by one of the vehicles, or set down.
  void extend(std::size_t vehicle) {
    if (vehicle == routes_.size()) {
      if (std::ranges::all_of(state_, [](int s) { return s == 2; })) all.push_back(routes_);
      return;
    }
    const bool empty = std::ranges::none_of(state_, [](int s) { return s == 1; });
    if (empty) extend(vehicle + 1);
    for (std::size_t goal = 0; goal < state_.size(); ++goal) {
      if (state_[goal] == 2) continue;
      const bool up = state_[goal] == 0;
      const std::uint32_t aboard = up ? aboard_ + 1 : aboard_ - 1;
      if (aboard > problem_.vehicles[vehicle].capacity) continue;
      const std::uint32_t before = std::exchange(aboard_, aboard);
      ++state_[goal];
      routes_[vehicle].push_back({.kind = up ? StopKind::PickUp : StopKind::SetDown,
                                  .location = up ? problem_.goals[goal].from : problem_.goals[goal].to,
                                  .goal = goal,
                                  .task = {},
                                  .amount = 1,
                                  .aboard = aboard});
      extend(vehicle);
      routes_[vehicle].pop_back();
      --state_[goal];
      aboard_ = before;
    }
  }

  const MissionProblem& problem_;
  std::vector<Route> routes_;
  std::vector<int> state_ = {0, 0};
  std::uint32_t aboard_ = 0;
};

// The first schedule of one allocation; nothing if there is none.
std::optional<std::vector<milliseconds>> ends_of(const MissionProblem& problem, FleetFloor& floor,
                                                 const std::vector<Route>& routes, bool stands_hold) {
  std::vector<VehicleMission> missions;
  for (std::size_t v = 0; v < routes.size(); ++v) {
    auto legs = legs_of(problem, v, routes[v]);
    if (legs.empty()) legs.push_back({0, problem.vehicles[v].start, problem.vehicles[v].start});
    floor.prepare(legs, {});
    std::vector<const LatticePath*> paths;
    for (const LegRequest& leg : legs) paths.push_back(&floor.leg(leg).path.value());
    auto stops = routes[v].empty() ? std::vector<Stop>() : internal::stops_on(problem, routes[v], paths);
    missions.push_back(
        internal::build_mission(problem, v, internal::join_legs(paths), std::move(stops), floor.map(), {})
            .value());
  }
  auto constraints = internal::map_constraints(problem, routes, missions).constraints;
  std::vector<TrajectoryEnvelope> envelopes;
  for (std::uint32_t v = 0; v < missions.size(); ++v) {
    envelopes.push_back(missions[v].grown.envelope);
    for (const std::size_t stand : missions[v].grown.stands) {
      const auto k = static_cast<std::uint32_t>(stand);
      // Envelopes alone let a vehicle leave a stop after it has come to the next one.
      if (stands_hold && k + 1 < envelopes[v].polygons.size()) {
        constraints.push_back({.name = "stands",
                               .from = TimepointRef{{v, k}, Side::Exit},
                               .to = {{v, k + 1}, Side::Entry},
                               .distance = {milliseconds(0), kNever}});
      }
    }
  }
  const Schedule made = schedule(envelopes, constraints, {.explain = false});
  if (made.verdict != Verdict::Scheduled) return std::nullopt;
  std::vector<milliseconds> ends(problem.goals.size());
  for (std::size_t v = 0; v < routes.size(); ++v) {
    for (std::size_t k = 0; k < routes[v].size(); ++k) {
      if (routes[v][k].kind != StopKind::SetDown) continue;
      ends[*routes[v][k].goal] = made.earliest[v][missions[v].grown.stands[k]].exit;
    }
  }
  return ends;
}

std::vector<std::vector<milliseconds>> all_ends(const MissionProblem& problem, FleetFloor& floor,
                                                bool stands_hold = true) {
  std::vector<std::vector<milliseconds>> found;
  for (const auto& routes : Allocations(problem).all) {
    if (auto ends = ends_of(problem, floor, routes, stands_hold)) found.push_back(*std::move(ends));
  }
  return found;
}

TEST(AllocationProof, WhenHeldAgainstTheSchedulesOfAllAllocations_ThenNoneIsRefusedThatHasOne) {
  RandomProblems problems(7);
  FleetFloor judge = floor_of(problems.next());
  int scheduled = 0, on_paths = 0, on_all = 0;
  for (int round = 0; round < 14; ++round) {
    MissionProblem problem = problems.next();
    const auto free = all_ends(problem, judge);
    if (free.empty()) continue;
    problems.add_limits(problem, free);
    // On a floor on which nothing is known yet, so that lengths are what no path falls below.
    FleetFloor fresh = FleetFloor::create(problem.map, models_of(problem),
                                          {.table_folder = {}, .table_range_m = 1.0, .table_margin_m = 1.0})
                           .value();
    const auto answer = plan_fleet(
        problem, fresh, {.objective = Objective::None, .time = milliseconds(0), .alternatives = 0});
    ASSERT_TRUE(answer) << to_string(answer.error());
    switch (answer->proof) {
      case Proof::None:
        ++scheduled;
        EXPECT_EQ(answer->verdict, Verdict::Scheduled) << round;
        EXPECT_FALSE(all_ends(problem, judge, false).empty()) << round;
        break;
      case Proof::ThisAllocation:
        break;  // says nothing of others
      case Proof::PathsFound:
        ++on_paths;
        EXPECT_TRUE(all_ends(problem, judge).empty()) << round << ": " << answer->reason;
        break;
      case Proof::AllPaths:
        ++on_all;
        EXPECT_TRUE(all_ends(problem, judge).empty()) << round << ": " << answer->reason;
        break;
    }
  }
  EXPECT_GT(scheduled, 2);
  EXPECT_GT(on_paths, 0);
  EXPECT_GT(on_all, 0);
}

}  // namespace
}  // namespace stepwright::fleet
