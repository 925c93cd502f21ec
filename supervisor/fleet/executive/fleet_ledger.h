#pragma once

// Ledger of a fleet's loads and drives over all plans of a run: who has what aboard, what is delivered, what
// was ordered meanwhile; and the problem of what remains. A new plan needs to know nothing else of the old
// ones.
//
// No clock, no I/O; one thread at a time. Times count from the time zero of the first plan.
//
//   FleetLedger ledger(problem);
//   ledger.made(2, mission.stops[0], 41'000ms);          // a stop has begun
//   ledger.lose(3, "stopped by error 27", outline);
//   const MissionProblem rest = ledger.rest({.elapsed = 90s, .starts = starts});

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/mission/mission_problem.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

enum class GoalState : std::uint8_t { Waiting, Carried, Delivered, GivenUp };

struct GoalEntry {
  std::uint32_t amount = 0;  // that is wanted by now
  std::uint32_t delivered = 0;
  std::uint32_t aboard = 0;                            // of all vehicles, lost ones included
  bool given_up = false;                               // of what nobody has picked up nothing will be
  std::string why = {};                                // it was given up
  bool late = false;                                   // its constraints cannot be kept any more
  std::vector<std::chrono::milliseconds> starts = {};  // of its trips so far
  std::vector<std::chrono::milliseconds> ends = {};
  std::optional<std::uint32_t> vehicle = {};  // that carries or carried it last

  GoalState state() const;
};

struct VehicleEntry {
  std::map<std::size_t, std::uint32_t> aboard = {};  // units by goal
  std::set<std::size_t> kept =
      {};  // of these: what is aboard stays there, no way leads to where it is wanted
  std::size_t tasks_done = 0;
  std::vector<std::chrono::milliseconds> task_times = {};
  bool lost = false;
  std::string why = {};
};

// Where a vehicle begins anew.
struct NewStart {
  geometry::Pose start;
  geometry::Path lead_in = {};
  bool able = true;  // false: it cannot move from where it stands; no goal, no task
};

struct RestOptions {
  std::chrono::milliseconds elapsed{0};  // of the first plan's clock, when the new plan's begins
  std::vector<NewStart> starts;          // by vehicle; lost ones are left out
  bool keep_limits = true;               // without: nothing has to be done by a time
};

struct RestProblem {
  MissionProblem problem;
  std::vector<std::uint32_t> vehicles;  // of the ledger, by vehicle of the problem
  std::vector<std::size_t> goals;       // likewise
  std::vector<std::size_t> tasks;
  // Constraints that count from what will not happen: it is aboard of a lost vehicle, say, or given up.
  std::vector<std::string> unbound = {};
};

// All of a ledger but the problem's file: what a journal keeps.
struct LedgerState {
  std::vector<MissionGoal> orders = {};  // goals beyond those of the file
  std::vector<GoalEntry> goals = {};
  std::vector<VehicleEntry> vehicles = {};
  std::vector<bool> tasks_dropped = {};
  bool limits_dropped = false;
};

class FleetLedger {
 public:
  explicit FleetLedger(MissionProblem problem);

  const MissionProblem& problem() const { return problem_; }
  const std::vector<GoalEntry>& goals() const { return goals_; }
  const std::vector<VehicleEntry>& vehicles() const { return vehicles_; }

  // The vehicle stands there and has begun; that ends by itself.
  void made(std::uint32_t vehicle, const Stop& stop, std::chrono::milliseconds when);
  // One that began then has ended: until this is told, it counts as ending behind its service.
  void ended(const Stop& stop, std::chrono::milliseconds begun, std::chrono::milliseconds when);
  void lose(std::uint32_t vehicle, std::string why);
  void find(std::uint32_t vehicle);  // it is there again
  // Give up goals that keep the rest from being planned: loads that wait, loads aboard a vehicle, a drive.
  // False if that was given up already.
  bool give_up(std::size_t goal, std::string why);
  bool keep_aboard(std::uint32_t vehicle, std::size_t goal, std::string why);
  bool give_up_task(std::size_t task);
  bool reopen();  // what was given up; true if anything was
  void mark_late(const std::vector<std::string>& constraints);
  // Of goals that are not delivered, whose constraints are named: they do not bind any more.
  std::vector<std::string> drop_limits();

  // A new load, or another amount of one that is known by its name; 0: of what nobody has yet picked up
  // nothing is wanted any more. X0003: a place that is unknown or the same twice, or another way of a known
  // load.
  [[nodiscard]] result::Result<void> order(const std::string& name, const std::string& from,
                                           const std::string& to, std::uint32_t amount);

  LedgerState state() const;
  // Of the same file; false, and nothing happens, if the state cannot be of it.
  bool restore(LedgerState state);

  // Something else is wanted than the problem's file says.
  bool ordered() const;
  // Everything is delivered; no vehicle has anything left to carry.
  bool complete() const;
  // Why some of the goal is missing: it was given up, or vehicles have it aboard that are lost or, by
  // `shut_in` (a flag for each), cannot leave where they stand. Empty if none of it.
  std::string reason_of(std::size_t goal, const std::vector<bool>& shut_in) const;
  RestProblem rest(const RestOptions& options) const;

 private:
  std::optional<std::size_t> location(const std::string& name) const;

  MissionProblem problem_;
  std::size_t file_goals_ = 0;
  std::vector<GoalEntry> goals_;
  std::vector<VehicleEntry> vehicles_;
  std::vector<bool> tasks_dropped_;
  bool limits_dropped_ = false;
};

}  // namespace stepwright::fleet
