// The problem of what remains: loads that nobody has yet, loads that are aboard, drives that are left, and
// constraints whose past moments have become numbers.

#include <algorithm>
#include <utility>

#include "supervisor/fleet/executive/fleet_ledger.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHorizon{100'000'000};

class Rest {
 public:
  Rest(const MissionProblem& problem, const std::vector<GoalEntry>& goals,
       const std::vector<VehicleEntry>& vehicles, const std::vector<bool>& tasks_dropped,
       const RestOptions& options)
      : problem_(problem),
        goals_(goals),
        vehicles_(vehicles),
        tasks_dropped_(tasks_dropped),
        options_(options),
        parts_(goals.size()),
        number_(vehicles.size()),
        task_number_(problem.tasks.size()) {}

  RestProblem make() {
    auto& rest = made_.problem;
    rest.file = problem_.file;  // without its text: nothing of it has a place there
    rest.map = problem_.map;
    rest.classes = problem_.classes;
    rest.locations = problem_.locations;
    add_vehicles();
    add_waiting_loads();
    add_loads_aboard();
    add_tasks();
    for (const MissionConstraint& constraint : problem_.constraints) add(constraint);
    return std::move(made_);
  }

 private:
  void add_vehicles() {
    for (std::uint32_t v = 0; v < vehicles_.size(); ++v) {
      const NewStart& start = options_.starts[v];
      if (vehicles_[v].lost || !start.able) continue;
      MissionVehicle vehicle = problem_.vehicles[v];
      vehicle.start = start.start;
      vehicle.lead_in = start.lead_in;
      vehicle.available = std::max(vehicle.available - options_.elapsed, milliseconds(0));
      vehicle.route.clear();
      number_[v] = made_.problem.vehicles.size();
      made_.problem.vehicles.push_back(std::move(vehicle));
      made_.vehicles.push_back(v);
    }
  }

  std::size_t add_goal(std::size_t k, MissionGoal goal) {
    goal.after.clear();  // what binds the order of one vehicle's loads ends with its route
    made_.problem.goals.push_back(std::move(goal));
    made_.goals.push_back(k);
    parts_[k].push_back(made_.problem.goals.size() - 1);
    return made_.problem.goals.size() - 1;
  }

  void add_waiting_loads() {
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      const GoalEntry& entry = goals_[k];
      const std::uint32_t taken = entry.delivered + entry.aboard;
      if (entry.given_up || entry.amount <= taken) continue;
      MissionGoal goal = problem_.goals[k];
      goal.amount = entry.amount - taken;
      if (goal.vehicle) goal.vehicle = number_[*goal.vehicle];
      if (problem_.goals[k].vehicle && !goal.vehicle) goal.vehicle.reset();  // its vehicle is lost
      if (goal.due) goal.due = std::max(*goal.due - options_.elapsed, milliseconds(0));
      add_goal(k, std::move(goal));
    }
  }

  // A load aboard is one that begins where the vehicle does: its route begins with it.
  void add_loads_aboard() {
    for (std::uint32_t v = 0; v < vehicles_.size(); ++v) {
      if (!number_[v] || vehicles_[v].aboard.empty()) continue;
      MissionVehicle& vehicle = made_.problem.vehicles[*number_[v]];
      made_.problem.locations.push_back(
          {.name = "aboard " + vehicle.name, .pose = vehicle.start, .key = vehicle.key});
      std::vector<HandStop> set_downs;
      for (const auto& [k, units] : vehicles_[v].aboard) {
        if (vehicles_[v].kept.contains(k)) {
          vehicle.capacity -= std::min(vehicle.capacity, units);  // it takes up room on the forks
          continue;
        }
        MissionGoal goal = problem_.goals[k];
        goal.amount = units;
        goal.from = made_.problem.locations.size() - 1;
        goal.divisible = false;
        goal.vehicle = *number_[v];
        goal.due.reset();
        const std::size_t index = add_goal(k, std::move(goal));
        vehicle.route.push_back({.pick_up = true, .goal = index, .amount = units});
        set_downs.push_back({.pick_up = false, .goal = index, .amount = units});
      }
      vehicle.route.insert(vehicle.route.end(), set_downs.begin(), set_downs.end());
      vehicle.route_is_whole = set_downs.empty() && vehicle.route_is_whole;
    }
  }

  void add_tasks() {
    std::vector<std::size_t> met(vehicles_.size(), 0);
    for (std::size_t k = 0; k < problem_.tasks.size(); ++k) {
      const std::size_t v = problem_.tasks[k].vehicle;
      const bool done = met[v]++ < vehicles_[v].tasks_done;
      // The last drive is where the vehicle rests; whoever has been moved away goes there again.
      const bool rests = std::ranges::none_of(problem_.tasks.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                                              problem_.tasks.end(),
                                              [&](const MissionTask& task) { return task.vehicle == v; });
      if (!number_[v] || tasks_dropped_[k] || (done && !rests)) continue;
      MissionTask task = problem_.tasks[k];
      task.vehicle = *number_[v];
      task_number_[k] = made_.problem.tasks.size();
      made_.problem.tasks.push_back(std::move(task));
      made_.tasks.push_back(k);
    }
  }

  struct Moments {
    std::vector<MomentRef> open;     // of the new problem
    std::vector<milliseconds> past;  // of the first plan's clock
  };

  Moments moments(const MomentRef& at) const {
    Moments found;
    switch (at.moment) {
      case Moment::TimeZero:
        found.past = {milliseconds(0)};
        break;
      case Moment::VehicleStart:
      case Moment::VehicleEnd:
        found.past = {milliseconds(0)};  // it has begun long ago
        break;
      case Moment::VehicleArrival:
        if (number_[at.index]) found.open = {{at.moment, *number_[at.index]}};
        break;
      case Moment::GoalStart:
      case Moment::GoalEnd: {
        const bool start = at.moment == Moment::GoalStart;
        found.past = start ? goals_[at.index].starts : goals_[at.index].ends;
        for (const std::size_t part : parts_[at.index]) {
          // What is aboard has been picked up.
          const bool aboard = made_.problem.goals[part].from >= problem_.locations.size();
          if (!(start && aboard)) found.open.push_back({at.moment, part});
        }
        break;
      }
      case Moment::TaskStart:
      case Moment::TaskEnd:
        if (task_number_[at.index]) {
          found.open = {{at.moment, *task_number_[at.index]}};
        } else if (const auto begun = task_begun(at.index)) {
          const milliseconds service = problem_.locations[problem_.tasks[at.index].location].service;
          found.past = {at.moment == Moment::TaskEnd ? *begun + service : *begun};
        }
        break;
    }
    return found;
  }

  // Of a task that is behind its vehicle.
  std::optional<milliseconds> task_begun(std::size_t task) const {
    const std::size_t v = problem_.tasks[task].vehicle;
    const auto before = static_cast<std::size_t>(
        std::count_if(problem_.tasks.begin(), problem_.tasks.begin() + static_cast<std::ptrdiff_t>(task),
                      [&](const MissionTask& each) { return each.vehicle == v; }));
    const auto& times = vehicles_[v].task_times;
    return before < times.size() ? std::optional(times[before]) : std::nullopt;
  }

  void add(const MissionConstraint& constraint) {
    Bounds distance = constraint.distance;
    if (!options_.keep_limits) distance.most = kHorizon;
    const Moments from = moments(constraint.from);
    const Moments to = moments(constraint.to);
    if (!to.open.empty() && from.open.empty() && from.past.empty()) made_.unbound.push_back(constraint.name);
    for (const MomentRef& end : to.open) {
      for (const MomentRef& begin : from.open) put(constraint, begin, end, distance);
      for (const milliseconds begun : from.past) {
        put(constraint, {}, end, moved(distance, begun - options_.elapsed));
      }
    }
    // What is to come before something that has been.
    for (const MomentRef& begin : from.open) {
      for (const milliseconds ended : to.past) {
        if (distance.least <= -kHorizon) continue;
        const Bounds turned{distance.most >= kHorizon ? milliseconds(0) : ended - distance.most,
                            ended - distance.least};
        if (options_.keep_limits) put(constraint, {}, begin, moved(turned, -options_.elapsed));
      }
    }
  }

  static Bounds moved(Bounds bounds, milliseconds by) {
    bounds.least = std::max(bounds.least + by, milliseconds(0));
    if (bounds.most < kHorizon) bounds.most = std::max(bounds.most + by, milliseconds(0));
    return bounds;
  }

  void put(const MissionConstraint& of, const MomentRef& from, const MomentRef& to, const Bounds& distance) {
    const bool binds =
        distance.least.count() > 0 || distance.most < kHorizon || from.moment != Moment::TimeZero;
    if (!binds) return;
    MissionConstraint constraint = of;
    constraint.from = from;
    constraint.to = to;
    constraint.distance = distance;
    made_.problem.constraints.push_back(std::move(constraint));
  }

  const MissionProblem& problem_;
  const std::vector<GoalEntry>& goals_;
  const std::vector<VehicleEntry>& vehicles_;
  const std::vector<bool>& tasks_dropped_;
  const RestOptions& options_;
  RestProblem made_;
  std::vector<std::vector<std::size_t>> parts_;          // of each goal, in the new problem
  std::vector<std::optional<std::size_t>> number_;       // of each vehicle there
  std::vector<std::optional<std::size_t>> task_number_;  // of each task
};

}  // namespace

RestProblem FleetLedger::rest(const RestOptions& options) const {
  RestOptions asked = options;
  asked.keep_limits = options.keep_limits && !limits_dropped_;
  return Rest(problem_, goals_, vehicles_, tasks_dropped_, asked).make();
}

}  // namespace stepwright::fleet
