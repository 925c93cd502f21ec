#include "supervisor/fleet/mission/plan_fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "supervisor/fleet/mission/explain_schedule.h"
#include "supervisor/fleet/mission/internal/give_way.h"
#include "supervisor/fleet/mission/internal/mission_builder.h"
#include "supervisor/fleet/mission/internal/moments.h"
#include "supervisor/fleet/mission/internal/parallel.h"
#include "supervisor/fleet/mission/internal/proof.h"
#include "supervisor/fleet/mission/internal/repair.h"

namespace stepwright::fleet {

namespace {

using internal::is_planned;
using internal::LegTimes;
using internal::Route;
using std::chrono::milliseconds;
using WallClock = std::chrono::steady_clock;

// Of allocations, each with more driving times that are exact.
constexpr std::size_t kMostRounds = 12;
// Of allocations that are to prove that there is none.
constexpr std::size_t kMostProofRounds = 50;

class Stopwatch {
 public:
  double lap_ms() {
    const auto now = WallClock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - lap_).count();
    lap_ = now;
    return passed;
  }
  double total_ms() const {
    return std::chrono::duration<double, std::milli>(WallClock::now() - begin_).count();
  }

 private:
  WallClock::time_point begin_ = WallClock::now();
  WallClock::time_point lap_ = begin_;
};

class Chain {
 public:
  Chain(const MissionProblem& problem, FleetFloor& floor, const FleetOptions& options)
      : problem_(problem), floor_(floor), options_(options), routes_(problem.vehicles.size()) {
    until_ = WallClock::now() + options.time;
  }

  result::Result<FleetAnswer> run() {
    const std::size_t searched = floor_.searches();
    if (auto wrong = allocate_goals(); !wrong.empty()) return tl::unexpected(std::move(wrong));
    if (!refused_) {
      if (auto wrong = plan_paths(); !wrong.empty()) return tl::unexpected(std::move(wrong));
    }
    if (cancelled()) {
      answer_.verdict = Verdict::Cancelled;
    } else if (out_of_time_) {
      answer_.verdict = Verdict::Exhausted;
      answer_.reason = "the budget ended before all paths were found\n";
    } else if (!refused_) {
      if (auto wrong = grow(); !wrong.empty()) return tl::unexpected(std::move(wrong));
      order();
    }
    answer_.figures.searches = floor_.searches() - searched;
    answer_.figures.total_ms = watch_.total_ms();
    return std::move(answer_);
  }

 private:
  void say(std::string_view stage, std::size_t done = 0) const {
    if (options_.on_progress) options_.on_progress({stage, done, watch_.total_ms()});
  }

  bool cancelled() const { return options_.cancel != nullptr && options_.cancel->load(); }
  bool limited() const { return options_.time.count() > 0; }
  milliseconds left() const {
    return std::max(std::chrono::duration_cast<milliseconds>(until_ - WallClock::now()), milliseconds(1));
  }

  // Goals to routes. Where no vehicles can carry them all the answer is complete.
  result::Diagnostics allocate_goals() {
    if (!problem_.goals.empty()) {
      internal::AllocationTask task(problem_, floor_, options_.allocation, options_.cancel);
      for (std::size_t round = 0; round < kMostRounds; ++round) {
        say("allocation", round + 1);
        if (!allocate_once(task, LegTimes::Paths)) break;
      }
      if (infeasible()) prove_refusal(task);
      if (refused_) {
        if (auto wrong = task.unreachable(); !wrong.empty()) return wrong;
        refuse_allocation(task);
      }
    }
    append_tasks(problem_, routes_);
    answer_.figures.allocation_ms = watch_.lap_ms();
    return {};
  }

  bool infeasible() const { return refused_ && answer_.allocation->verdict == AllocationVerdict::Infeasible; }

  // Times of paths are not quite the least there can be: schedules may be faster by what they round, and
  // other paths shorter. So the same is asked with times that nothing falls below. Where these leave an
  // allocation, its legs are planned, until there is one that is known to be as fast as that, or none on
  // these paths.
  void prove_refusal(internal::AllocationTask& task) {
    task.learn(LegTimes::Least);
    allocate_once(task, LegTimes::LeastOnPaths);
    if (infeasible()) {
      answer_.proof = Proof::AllPaths;
      return;
    }
    for (std::size_t round = 0; !refused_ && round < kMostProofRounds; ++round) {
      say("proof", round + 1);
      if (!allocate_once(task, LegTimes::LeastOnPaths)) break;
    }
    if (infeasible()) answer_.proof = Proof::PathsFound;
  }

  // Asked with the times that the task has; then it learns these. False if there is nothing more to be
  // learned.
  bool allocate_once(internal::AllocationTask& task, LegTimes next) {
    AllocationOptions limits{.cancel = options_.cancel};
    if (limited()) limits.time = std::max(left() / 4, milliseconds(1));
    answer_.allocation = allocate(task.problem(), limits);
    const AllocationVerdict verdict = answer_.allocation->verdict;
    refused_ = verdict != AllocationVerdict::Optimal && verdict != AllocationVerdict::Feasible;
    if (refused_) return false;
    routes_ = task.routes(*answer_.allocation);
    std::vector<Route> with_tasks = routes_;
    append_tasks(problem_, with_tasks);
    std::vector<LegRequest> legs;
    for (std::size_t v = 0; v < with_tasks.size(); ++v) {
      const auto own = legs_of(problem_, v, with_tasks[v]);
      legs.insert(legs.end(), own.begin(), own.end());
    }
    floor_.prepare(legs, path_options());
    return task.learn(next);
  }

  // A*, unless a longer path will do or paths have a time of their own.
  PathOptions path_options() const {
    PathOptions options{
        .first_weight = options_.path_factor, .last_weight = options_.path_factor, .cancel = options_.cancel};
    if (limited()) options.deadline = until_;
    if (options_.path_time.count() == 0) return options;
    options.first_weight = std::max(3.0, options_.path_factor);
    const auto until = WallClock::now() + options_.path_time;
    options.deadline = options.deadline ? std::min(*options.deadline, until) : until;
    return options;
  }

  void refuse_allocation(const internal::AllocationTask& task) {
    switch (answer_.allocation->verdict) {
      case AllocationVerdict::Infeasible:
        answer_.verdict = Verdict::Infeasible;
        answer_.reason = to_string(answer_.allocation->conflict, task.problem());
        if (!answer_.reason.empty() && answer_.reason.back() != '\n') answer_.reason += "\n";
        answer_.reason += task.places_of(answer_.allocation->conflict);
        break;
      case AllocationVerdict::Cancelled:
        answer_.verdict = Verdict::Cancelled;
        break;
      default:
        answer_.verdict = Verdict::Exhausted;
        answer_.reason = "the budget ended before loads were allocated to vehicles\n";
    }
  }

  result::Diagnostics plan_paths() {
    say("paths");
    std::vector<LegRequest> all;
    for (std::size_t v = 0; v < routes_.size(); ++v) {
      if (!is_planned(problem_.vehicles[v])) continue;
      legs_.push_back(legs_of(problem_, v, routes_[v]));
      // Who has no way to go stands: the leg from its start to itself.
      if (legs_.back().empty()) {
        const auto& vehicle = problem_.vehicles[v];
        legs_.back().push_back({vehicle.vehicle_class, vehicle.start, vehicle.start});
      }
      all.insert(all.end(), legs_.back().begin(), legs_.back().end());
    }
    floor_.prepare(all, path_options());
    answer_.figures.paths_ms = watch_.lap_ms();
    result::Diagnostics wrong;
    for (std::size_t v = 0, planned = 0; v < routes_.size(); ++v) {
      if (!is_planned(problem_.vehicles[v])) continue;
      const auto& legs = legs_[planned++];
      for (std::size_t k = 0; k < legs.size(); ++k) check_leg(v, k, legs[k], wrong);
    }
    return wrong;
  }

  // Told at the task or goal that the leg serves.
  void check_leg(std::size_t vehicle, std::size_t k, const LegRequest& leg, result::Diagnostics& wrong) {
    const PathAnswer& answer = floor_.leg(leg);
    if (answer.path) return;
    if (answer.diagnostics.empty()) {
      out_of_time_ = true;
      return;
    }
    std::string key = problem_.vehicles[vehicle].key;
    if (k < routes_[vehicle].size()) {
      const internal::RouteStop& stop = routes_[vehicle][k];
      if (stop.task) key = problem_.tasks[*stop.task].key;
      if (stop.goal) key = problem_.goals[*stop.goal].key;
    }
    wrong.push_back({"F0801", result::Severity::Error, place_of(problem_, key),
                     fmt::format("{}: '{}' finds no way: {}", key, problem_.vehicles[vehicle].name,
                                 answer.diagnostics.front().message),
                     answer.diagnostics.front().hint});
  }

  result::Diagnostics grow() {
    say("envelopes");
    std::vector<result::Result<VehicleMission>> missions(routes_.size());
    std::vector<const std::vector<LegRequest>*> legs(routes_.size(), nullptr);
    for (std::size_t v = 0, planned = 0; v < routes_.size(); ++v) {
      if (is_planned(problem_.vehicles[v])) legs[v] = &legs_[planned++];
    }
    internal::each_index(routes_.size(), floor_.threads(),
                         [&](std::size_t v) { missions[v] = mission_of(v, legs[v], options_.envelope); });
    // Who stands near somebody else takes no more of the floor than his outline, or neither could be there.
    EnvelopeOptions tight = options_.envelope;
    tight.stand_growth_m = 0.0;
    for (const std::size_t v : standing_together(missions)) {
      if (is_planned(problem_.vehicles[v])) missions[v] = mission_of(v, legs[v], tight);
    }
    result::Diagnostics wrong;
    for (std::size_t v = 0; v < missions.size(); ++v) {
      if (missions[v]) {
        answer_.plan.missions.push_back(*std::move(missions[v]));
        continue;
      }
      const std::string key = problem_.vehicles[v].key + (problem_.vehicles[v].path ? ".path" : "");
      for (const result::Diagnostic& found : missions[v].error()) {
        wrong.push_back({"F0802", result::Severity::Error, place_of(problem_, key),
                         fmt::format("{}: {}", key, found.message), found.hint});
      }
    }
    answer_.figures.envelopes_ms = watch_.lap_ms();
    return wrong;
  }

  static std::vector<std::size_t> standing_together(
      const std::vector<result::Result<VehicleMission>>& missions) {
    const auto begins = [&](std::size_t v) -> const geometry::ConvexPolygon& {
      return missions[v]->grown.envelope.polygons.front().area;
    };
    std::vector<std::size_t> near;
    for (std::size_t v = 0; v < missions.size(); ++v) {
      for (std::size_t u = 0; missions[v] && u < missions.size(); ++u) {
        if (u == v || !missions[u] || !overlaps(begins(v), begins(u))) continue;
        near.push_back(v);
        break;
      }
    }
    return near;
  }

  result::Result<VehicleMission> mission_of(std::size_t v, const std::vector<LegRequest>* legs,
                                            const EnvelopeOptions& envelope) const {
    const MissionVehicle& vehicle = problem_.vehicles[v];
    if (vehicle.envelope) return internal::given_mission(problem_, v);
    if (vehicle.path) return internal::build_mission(problem_, v, *vehicle.path, {}, floor_.map(), envelope);
    std::vector<const LatticePath*> paths;
    for (const LegRequest& leg : *legs) paths.push_back(&*floor_.leg(leg).path);
    auto mission = internal::route_mission(problem_, v, routes_[v], paths, floor_.map(), envelope);
    if (mission && options_.pace) options_.pace(*mission);
    return mission;
  }

  void order() {
    say("schedule");
    auto mapped = map_constraints(problem_, routes_, answer_.plan.missions);
    answer_.plan.constraints = std::move(mapped.constraints);
    Schedule made = schedule_with(Objective::None);
    answer_.figures.schedule_ms = watch_.lap_ms();
    if (made.verdict == Verdict::Infeasible) {
      const Core core = made.core;
      if (!mend(core, made)) {
        answer_.reason = why_not(core, mapped.keys);
        answer_.proof = proof_of_none();
      }
      answer_.figures.repair_ms = watch_.lap_ms();
    }
    if (made.verdict == Verdict::Scheduled && options_.objective != Objective::None) {
      say("improving");
      Schedule better = schedule_with(options_.objective);
      if (better.verdict == Verdict::Scheduled) made = std::move(better);
      answer_.figures.improve_ms = watch_.lap_ms();
    }
    answer_.verdict = made.verdict;
    if (made.verdict == Verdict::Exhausted) answer_.reason = "the budget ended before a schedule was found\n";
    answer_.plan.schedule = std::move(made);
  }

  Schedule schedule_with(Objective objective) const {
    ScheduleOptions options{.mode = options_.mode,
                            .objective = objective,
                            .conflicts = options_.conflicts,
                            .cancel = options_.cancel};
    if (limited()) options.time = left();
    if (objective == Objective::TotalTardiness) options.due = due_times();
    return schedule(envelopes_of(answer_.plan), answer_.plan.constraints, options);
  }

  // A vehicle is due when the last of its goals that has a time is.
  std::vector<milliseconds> due_times() const {
    std::vector<milliseconds> due;
    for (const Route& route : routes_) {
      milliseconds latest{-1};
      for (const internal::RouteStop& stop : route) {
        if (stop.goal && problem_.goals[*stop.goal].due)
          latest = std::max(latest, *problem_.goals[*stop.goal].due);
      }
      due.push_back(latest.count() < 0 ? SpeedLimits{}.horizon : latest);
    }
    return due;
  }

  internal::Attempt attempt(std::string_view stage) {
    return {.problem = problem_,
            .floor = floor_,
            .options = options_,
            .routes = routes_,
            .work = work_,
            .until = until_,
            .limited = limited(),
            .on_tried = [this, stage](std::size_t tried) { say(stage, tried); }};
  }

  // Where nobody is in anybody's way, no other way helps: who is late is late alone on the floor.
  bool mend(const Core& core, Schedule& made) {
    if (core.sections.empty()) return false;
    return (options_.alternatives > 0 && drive_around(core, made)) ||
           (options_.give_way > 0 && give_way(core, made));
  }

  bool drive_around(const Core& core, Schedule& made) {
    const internal::Attempt input = attempt("other paths");
    auto mended = internal::repair(input, answer_.plan.missions, core);
    answer_.figures.alternatives = mended.tried;
    all_tried_ = mended.all_tried;
    if (!mended.found) return false;
    answer_.plan.missions = std::move(mended.found->missions);
    answer_.plan.constraints = map_constraints(problem_, routes_, answer_.plan.missions).constraints;
    answer_.changes = std::move(mended.found->changes);
    made = std::move(mended.found->schedule);
    return true;
  }

  bool give_way(const Core& core, Schedule& made) {
    const internal::Attempt input = attempt("giving way");
    auto answer = internal::give_way(input, answer_.plan.missions, core);
    nobody_gives_way_ = std::move(answer.reason);
    if (!answer.found) return false;
    answer_.plan.missions = std::move(answer.found->missions);
    routes_ = std::move(answer.found->routes);
    answer_.plan.constraints = map_constraints(problem_, routes_, answer_.plan.missions).constraints;
    answer_.gave_way = std::move(answer.found->vehicles);
    made = std::move(answer.found->schedule);
    return true;
  }

  // Goals may be shared out in other ways, so that nothing is proved of all of them here.
  Proof proof_of_none() const {
    if (!problem_.goals.empty()) return Proof::ThisAllocation;
    const bool none = internal::no_paths_help({.problem = problem_,
                                               .floor = floor_,
                                               .routes = routes_,
                                               .missions = answer_.plan.missions,
                                               .mode = options_.mode,
                                               .cancel = options_.cancel});
    return none ? Proof::AllPaths : Proof::PathsFound;
  }

  std::string why_not(const Core& core, const std::vector<std::string>& keys) const {
    std::string text = reason_of(answer_.plan, core, &problem_, keys);
    if (answer_.figures.alternatives > 0) {
      text += fmt::format("{} other path{} did not help{}\n", answer_.figures.alternatives,
                          answer_.figures.alternatives == 1 ? "" : "s",
                          all_tried_ ? "" : "; there may be more than were tried");
    }
    return text + nobody_gives_way_ +
           (internal::used_up(work_, options_) ? "a budget of work ended before more was tried\n" : "");
  }

  const MissionProblem& problem_;
  FleetFloor& floor_;
  const FleetOptions& options_;
  Stopwatch watch_;
  WallClock::time_point until_;
  std::vector<Route> routes_;
  std::vector<std::vector<LegRequest>> legs_;  // of the vehicles that are planned for
  bool refused_ = false;                       // there is no allocation
  bool out_of_time_ = false;                   // there are not all paths
  bool all_tried_ = false;
  internal::SearchWork work_;
  std::string nobody_gives_way_;  // and why
  FleetAnswer answer_;
};

}  // namespace

std::vector<VehicleModel> models_of(const MissionProblem& problem) {
  std::vector<VehicleModel> models;
  for (const VehicleClass& of : problem.classes) models.push_back(of.model);
  return models;
}

result::Result<FleetAnswer> plan_fleet(const MissionProblem& problem, FleetFloor& floor,
                                       const FleetOptions& options) {
  return Chain(problem, floor, options).run();
}

FleetAnswer schedule_fleet(const SchedulingProblem& problem, const FleetOptions& options) {
  Stopwatch watch;
  FleetAnswer answer;
  for (const TrajectoryEnvelope& envelope : problem.envelopes) {
    answer.plan.missions.push_back({.vehicle = envelope.vehicle,
                                    .model = {},
                                    .speed = {},
                                    .path = {},
                                    .grown = {.envelope = envelope, .visits = {}, .stands = {}},
                                    .stops = {}});
  }
  answer.plan.constraints = problem.constraints;
  // Tardiness is held against times that these problems do not have.
  const Objective objective =
      options.objective == Objective::TotalTardiness ? Objective::Makespan : options.objective;
  answer.plan.schedule = schedule(
      problem.envelopes, problem.constraints,
      {.mode = options.mode, .objective = objective, .time = options.time, .cancel = options.cancel});
  answer.verdict = answer.plan.schedule.verdict;
  answer.figures.improve_ms = answer.plan.schedule.figures.improve_ms;
  answer.figures.total_ms = watch.total_ms();
  answer.figures.schedule_ms = answer.figures.total_ms - answer.figures.improve_ms;
  if (answer.verdict == Verdict::Infeasible) answer.proof = Proof::AllPaths;
  if (answer.verdict == Verdict::Infeasible)
    answer.reason = reason_of(answer.plan, answer.plan.schedule.core, nullptr, {});
  return answer;
}

}  // namespace stepwright::fleet
