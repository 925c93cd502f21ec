#include "supervisor/ltl/planner/plan_train.h"

#include <chrono>
#include <optional>
#include <utility>

#include "supervisor/ltl/guide/impossible.h"
#include "supervisor/ltl/guide/task.h"

namespace stepwright::ltl {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kTaskName = "task";  // in place of a file
// Of an automaton; beyond them, which takes less than a second to find out, the progression is quicker.
constexpr std::size_t kMostStates = 2'048;
constexpr std::size_t kMostNodes = 400'000;
constexpr std::size_t kMostStages = 2'000'000;  // of a guide that tells whether a point can do it

// A task with its automaton, or without one where it would be too large.
struct PlannedTask {
  Formula formula;
  std::optional<Automaton> automaton;
  std::vector<Letter> read;  // before: the automaton begins behind it

  TaskStates states() const { return automaton ? TaskStates(*automaton) : TaskStates(formula, read); }
};

// Acceptance is strong, as the referee reads it.
result::Result<PlannedTask> read_planned(const Problem& problem) {
  auto task =
      read_task(problem.task, problem.places(), kTaskName,
                {.most_states = kMostStates, .most_nodes = kMostNodes, .acceptance = Acceptance::Strong});
  if (task) {
    begin_behind(problem.read, task->automaton);
    return PlannedTask{std::move(task->formula), std::move(task->automaton), problem.read};
  }
  auto formula = parse_formula(problem.task, kTaskName, problem.places());
  const bool only_too_large = formula && formula->proposition_count() == problem.places().size() &&
                              !formula->terms.has_release(formula->root);
  if (!only_too_large) return result::forward(task);
  return PlannedTask{*std::move(formula), std::nullopt, problem.read};
}

result::Diagnostics blame(const Impossible& why) {
  result::Diagnostics found;
  for (const ImpossiblePart& part : why.parts)
    found.push_back({kImpossible,
                     result::Severity::Error,
                     {kTaskName, part.at.line, part.at.column},
                     "'" + part.text + "' cannot be done" +
                         (why.parts.size() > 1 ? " together with the other parts" : "") + ": " + why.reason,
                     "even a point without size and turning circle finds no way"});
  return found;
}

// The time and the flag that end all of it.
class Deadline {
 public:
  explicit Deadline(const PlanOptions& options) : options_(options) {}

  double left_s() const {
    return options_.most_s - std::chrono::duration<double>(Clock::now() - began_).count();
  }
  bool is_cancelled() const { return options_.cancel != nullptr && options_.cancel->load(); }
  bool over() const { return is_cancelled() || !(left_s() > 0.0); }
  tl::unexpected<result::Diagnostics> failed() const {
    if (is_cancelled()) return result::fail(kPlanCancelled, {}, "the planning was cancelled");
    return result::fail(kNoPlan, {}, "no plan was found in the time that there was",
                        "the floor and the task took all of it: more time, or fewer corners");
  }

 private:
  const PlanOptions& options_;
  const Clock::time_point began_ = Clock::now();
};

class Planner {
 public:
  Planner(const Problem& problem, const PlanOptions& options, const Deadline& deadline, const RegionMap& map,
          const PlannedTask& task)
      : problem_(problem),
        options_(options),
        deadline_(deadline),
        task_(task),
        start_(problem.standing()),
        places_(problem.floor.propositions),
        search_(problem.floor, map, places_, problem.train, task.states(), options.guide) {}

  result::Result<PlanAnswer> plan() {
    PlanAnswer answer;
    answer.states = task_.automaton ? task_.automaton->size() : 0;
    for (std::size_t k = 0; k < options_.most_tries; ++k) {
      answer.tries = k + 1;
      answer.search = search_.first(query(k));
      if (!answer.search.plan) break;
      answer.plan = *answer.search.plan;
      answer.judgement = judged(answer.plan);
      if (!answer.judgement.accepted()) continue;
      if (options_.shorten_s > 0.0) shorten(answer);
      return answer;
    }
    return failed(answer);
  }

 private:
  SearchQuery query(std::size_t attempt) const {
    return {.start = start_,
            .seed = options_.seed + 0x9E37'79B9u * attempt,
            .most_s = deadline_.left_s(),
            .most_rounds = options_.most_rounds,
            .by_chance = attempt > 0,
            .cancel = options_.cancel};
  }

  // What was found in time has a second more to be judged.
  PlanJudgement judged(const TrainPlan& plan) const {
    const auto until = Clock::now() + std::chrono::seconds(1);
    const auto stop = [&] { return deadline_.is_cancelled() || (deadline_.over() && Clock::now() > until); };
    return judge_plan(problem_.floor, problem_.train, start_, task_.formula, plan,
                      {.read = problem_.read, .stop = stop});
  }

  void shorten(PlanAnswer& answer) {
    SearchQuery more = query(0);
    more.most_s = options_.shorten_s;
    more.most_rounds = options_.shorten_rounds;
    const SearchAnswer found = search_.shorter(more, answer.plan.length_m);
    if (!found.plan) return;
    PlanJudgement judgement = judged(*found.plan);
    if (!judgement.accepted()) return;
    answer.plan = *found.plan;
    answer.judgement = std::move(judgement);
    answer.shortened = true;
  }

  result::Result<PlanAnswer> failed(const PlanAnswer& answer) const {
    const result::Location nowhere;
    const std::string refused = answer.judgement.reason;
    switch (answer.search.end) {
      case SearchEnd::BadStart:
        return result::fail(kStartDoesNotFit, nowhere, "the train does not fit where it begins",
                            "no link may be nearer than 2.5 cm to a wall, or meet another one");
      case SearchEnd::Cancelled:
        return result::fail(kPlanCancelled, nowhere, "the planning was cancelled");
      case SearchEnd::NoWay:
        return result::fail(kImpossible, {kTaskName, 1, 1}, "the task cannot be done on this floor");
      case SearchEnd::Bound:
      case SearchEnd::Found:
        break;
    }
    if (!refused.empty())
      return result::fail(kAllRefused, nowhere, "the referee refused what was found: " + refused,
                          "another seed, or more time");
    return result::fail(kNoPlan, nowhere, "no plan was found in the time that there was",
                        "another seed, more time, or fewer trailers: a point can do the task");
  }

  const Problem& problem_;
  const PlanOptions& options_;
  const Deadline& deadline_;
  const PlannedTask& task_;
  const TrainState start_;
  Places places_;
  TrainSearch search_;
};

}  // namespace

result::Result<PlanAnswer> plan_train(const Problem& problem, const PlanOptions& options) {
  if (auto sound = validate(problem.train); !sound) return result::forward(sound);
  const Deadline deadline(options);
  auto map = make_regions(problem.floor, [&] { return deadline.over(); });
  if (!map && map.error().front().code == kStoppedRegions) return deadline.failed();
  if (!map) return result::forward(map);
  auto task = read_planned(problem);
  if (!task) return result::forward(task);
  if (deadline.over()) return deadline.failed();
  const std::uint32_t here = map->locate(problem.start.position());
  const bool is_asked = task->automaton && map->regions().size() * task->automaton->size() <= kMostStages;
  if (is_asked && here != kNoRegion) {
    const Task known{task->formula, *task->automaton, task->read};
    if (const auto why = why_impossible(*map, known, problem.places(), here))
      return tl::unexpected(blame(*why));
  }
  return Planner(problem, options, deadline, *map, *task).plan();
}

}  // namespace stepwright::ltl
