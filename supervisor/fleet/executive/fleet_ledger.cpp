#include "supervisor/fleet/executive/fleet_ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stepwright::fleet {
namespace {

constexpr std::chrono::milliseconds kHorizon{100'000'000};

}  // namespace

GoalState GoalEntry::state() const {
  if (delivered >= amount) return GoalState::Delivered;
  if (aboard > 0) return GoalState::Carried;
  return given_up ? GoalState::GivenUp : GoalState::Waiting;
}

FleetLedger::FleetLedger(MissionProblem problem)
    : problem_(std::move(problem)),
      file_goals_(problem_.goals.size()),
      vehicles_(problem_.vehicles.size()),
      tasks_dropped_(problem_.tasks.size(), false) {
  for (const MissionGoal& goal : problem_.goals) goals_.push_back({.amount = goal.amount});
}

void FleetLedger::made(std::uint32_t vehicle, const Stop& stop, std::chrono::milliseconds when) {
  VehicleEntry& entry = vehicles_[vehicle];
  if (stop.kind == StopKind::GiveWay) return;
  if (stop.kind == StopKind::Park) {
    ++entry.tasks_done;
    entry.task_times.push_back(when);
    return;
  }
  const auto found = std::ranges::find(problem_.goals, stop.goal, &MissionGoal::name);
  if (found == problem_.goals.end()) return;
  const auto index = static_cast<std::size_t>(found - problem_.goals.begin());
  GoalEntry& goal = goals_[index];
  goal.vehicle = vehicle;
  if (stop.kind == StopKind::PickUp) {
    entry.aboard[index] += stop.amount;
    goal.aboard += stop.amount;
    goal.starts.push_back(when);
    return;
  }
  const std::uint32_t left = std::min(stop.amount, entry.aboard[index]);
  entry.aboard[index] -= left;
  if (entry.aboard[index] == 0) entry.aboard.erase(index);
  goal.aboard -= std::min(left, goal.aboard);
  goal.delivered += stop.amount;
  goal.ends.push_back(when + stop.service);
}

void FleetLedger::ended(const Stop& stop, std::chrono::milliseconds begun, std::chrono::milliseconds when) {
  const auto found = std::ranges::find(problem_.goals, stop.goal, &MissionGoal::name);
  if (stop.kind != StopKind::SetDown || found == problem_.goals.end()) return;
  auto& ends = goals_[static_cast<std::size_t>(found - problem_.goals.begin())].ends;
  const auto expected = std::ranges::find(ends, begun + stop.service);
  if (expected != ends.end()) *expected = when;
}

void FleetLedger::lose(std::uint32_t vehicle, std::string why) {
  vehicles_[vehicle].lost = true;
  vehicles_[vehicle].why = std::move(why);
}

void FleetLedger::find(std::uint32_t vehicle) {
  vehicles_[vehicle].lost = false;
  vehicles_[vehicle].why.clear();
}

bool FleetLedger::give_up(std::size_t goal, std::string why) {
  goals_[goal].why = std::move(why);
  return !std::exchange(goals_[goal].given_up, true);
}

bool FleetLedger::keep_aboard(std::uint32_t vehicle, std::size_t goal, std::string why) {
  goals_[goal].why = std::move(why);
  return vehicles_[vehicle].kept.insert(goal).second;
}

bool FleetLedger::give_up_task(std::size_t task) {
  if (tasks_dropped_[task]) return false;
  tasks_dropped_[task] = true;
  return true;
}

std::string FleetLedger::reason_of(std::size_t goal, const std::vector<bool>& shut_in) const {
  const GoalEntry& entry = goals_[goal];
  if (!entry.why.empty() || entry.delivered >= entry.amount) return entry.why;
  std::string text;
  for (std::size_t v = 0; v < vehicles_.size(); ++v) {
    const auto aboard = vehicles_[v].aboard.find(goal);
    const bool stands = v < shut_in.size() && shut_in[v];
    if (aboard == vehicles_[v].aboard.end() || (!vehicles_[v].lost && !stands)) continue;
    text += fmt::format("{}{} aboard of {}, which {}", text.empty() ? "" : "; ", aboard->second,
                        problem_.vehicles[v].name,
                        vehicles_[v].lost ? "is lost" : "cannot leave where it stands");
  }
  return text;
}

bool FleetLedger::reopen() {
  bool any = false;
  for (GoalEntry& goal : goals_) {
    any = any || goal.given_up;
    goal.given_up = false;
    goal.why.clear();
  }
  for (VehicleEntry& vehicle : vehicles_) {
    any = any || !vehicle.kept.empty();
    for (const std::size_t goal : vehicle.kept) goals_[goal].why.clear();
    vehicle.kept.clear();
  }
  for (std::size_t k = 0; k < tasks_dropped_.size(); ++k) {
    any = any || tasks_dropped_[k];
    tasks_dropped_[k] = false;
  }
  return any;
}

void FleetLedger::mark_late(const std::vector<std::string>& constraints) {
  for (const MissionConstraint& bound : problem_.constraints) {
    const bool named = std::ranges::find(constraints, bound.name) != constraints.end();
    const bool of_goal = bound.to.moment == Moment::GoalEnd || bound.to.moment == Moment::GoalStart;
    if (named && of_goal && goals_[bound.to.index].state() != GoalState::Delivered)
      goals_[bound.to.index].late = true;
  }
}

std::vector<std::string> FleetLedger::drop_limits() {
  std::vector<std::string> names;
  if (std::exchange(limits_dropped_, true)) return names;
  for (const MissionConstraint& bound : problem_.constraints) {
    if (bound.distance.most >= kHorizon) continue;
    names.push_back(bound.name);
  }
  mark_late(names);
  return names;
}

std::optional<std::size_t> FleetLedger::location(const std::string& name) const {
  const auto found = std::ranges::find(problem_.locations, name, &MissionLocation::name);
  if (found == problem_.locations.end()) return std::nullopt;
  return static_cast<std::size_t>(found - problem_.locations.begin());
}

result::Result<void> FleetLedger::order(const std::string& name, const std::string& from,
                                        const std::string& to, std::uint32_t amount) {
  const auto refuse = [](const std::string& what, const std::string& hint) {
    return result::fail("X0003", {}, what, hint);
  };
  if (name.empty()) return refuse("an order needs a name", "name it as goals of the problem's file are");
  const auto known = std::ranges::find(problem_.goals, name, &MissionGoal::name);
  const auto origin = location(from);
  const auto target = location(to);
  for (const auto& [place, found] : {std::pair(from, origin), std::pair(to, target)}) {
    if (!found)
      return refuse("there is no location '" + place + "'", "locations are those of the problem's file");
  }
  if (*origin == *target) return refuse("'" + name + "' begins and ends at " + from, "name two locations");
  if (known != problem_.goals.end()) {
    const auto index = static_cast<std::size_t>(known - problem_.goals.begin());
    if (known->from != *origin || known->to != *target) {
      return refuse("'" + name + "' goes another way already", "give another order another name");
    }
    GoalEntry& entry = goals_[index];
    entry.amount = std::max(amount, entry.delivered + entry.aboard);
    entry.given_up = false;
    return {};
  }
  if (amount == 0) return refuse("'" + name + "' is nothing", "an amount of at least 1");
  problem_.goals.push_back(
      {.name = name, .amount = amount, .from = *origin, .to = *target, .key = "order " + name});
  goals_.push_back({.amount = amount});
  return {};
}

LedgerState FleetLedger::state() const {
  return {.orders = {problem_.goals.begin() + static_cast<std::ptrdiff_t>(file_goals_), problem_.goals.end()},
          .goals = goals_,
          .vehicles = vehicles_,
          .tasks_dropped = tasks_dropped_,
          .limits_dropped = limits_dropped_};
}

bool FleetLedger::restore(LedgerState state) {
  const std::size_t goals = file_goals_ + state.orders.size();
  const auto known = [&](std::size_t place) { return place < problem_.locations.size(); };
  bool sound = state.goals.size() == goals && state.vehicles.size() == vehicles_.size() &&
               state.tasks_dropped.size() == tasks_dropped_.size();
  for (const MissionGoal& order : state.orders) sound = sound && known(order.from) && known(order.to);
  for (const VehicleEntry& vehicle : state.vehicles) {
    for (const auto& [goal, units] : vehicle.aboard) sound = sound && goal < goals;
    for (const std::size_t goal : vehicle.kept) sound = sound && goal < goals;
  }
  for (const GoalEntry& goal : state.goals)
    sound = sound && (!goal.vehicle || *goal.vehicle < vehicles_.size());
  if (!sound) return false;
  problem_.goals.resize(file_goals_);
  for (MissionGoal& order : state.orders) problem_.goals.push_back(std::move(order));
  goals_ = std::move(state.goals);
  vehicles_ = std::move(state.vehicles);
  tasks_dropped_ = std::move(state.tasks_dropped);
  limits_dropped_ = state.limits_dropped;
  return true;
}

bool FleetLedger::ordered() const {
  bool other = problem_.goals.size() > file_goals_;
  for (std::size_t k = 0; k < file_goals_; ++k) other = other || goals_[k].amount != problem_.goals[k].amount;
  return other;
}

bool FleetLedger::complete() const {
  return std::ranges::all_of(goals_, [](const GoalEntry& goal) { return goal.delivered >= goal.amount; });
}

}  // namespace stepwright::fleet
