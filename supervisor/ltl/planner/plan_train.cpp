#include "supervisor/ltl/planner/plan_train.h"

#include <chrono>
#include <memory>
#include <utility>

#include "supervisor/ltl/guide/impossible.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/lanes/lanes.h"
#include "supervisor/ltl/planner/deadline.h"
#include "supervisor/ltl/planner/first_plan.h"
#include "supervisor/ltl/planner/planned_task.h"
#include "supervisor/ltl/planner/shorter_plans.h"

namespace stepwright::ltl {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kTaskName = "task";       // in place of a file
constexpr std::size_t kMostStages = 2'000'000;  // of a guide that tells whether a point can do it
constexpr std::size_t kMostJudged = 4;          // of plans that got shorter and shorter

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

tl::unexpected<result::Diagnostics> no_time_left(const Deadline& deadline) {
  if (deadline.is_cancelled()) return result::fail(kPlanCancelled, {}, "the planning was cancelled");
  return result::fail(kNoPlan, {}, "no plan was found in the time that there was",
                      "the floor and the task took all of it: more time, or fewer corners");
}

class Planner {
 public:
  Planner(const Problem& problem, const PlanOptions& options, const Deadline& deadline, const RegionMap& map,
          const PlannedTask& task)
      : problem_(problem),
        options_(options),
        deadline_(deadline),
        task_(task),
        start_(problem.standing()),
        threads_(threads_of(options.threads)),
        places_(problem.floor.propositions),
        ground_(problem.floor, map, places_, problem.train, task.automaton ? &*task.automaton : nullptr,
                options.guide) {}

  result::Result<PlanAnswer> plan() {
    // Both threads make what both lines begin with.
    (void)ground_.graph(Clearance::Wanted, deadline_.stop(), threads_);
    FirstPlan first = first_plan(
        {[this] { return std::make_unique<TrainSearch>(ground_, task_.states()); },
         [this](const TrainPlan& plan, const std::atomic<bool>& enough) { return judged(plan, &enough); }},
        {.start = start_,
         .seed = options_.seed,
         .most_rounds = options_.most_rounds,
         .most_tries = options_.most_tries,
         .threads = threads_,
         .cancel = options_.cancel},
        deadline_);
    if (!first.found()) return failed(first);
    PlanAnswer answer;
    answer.plan = *first.search.plan;
    answer.judgement = std::move(first.judgement);
    answer.search = std::move(first.search);
    answer.tries = first.tries;
    answer.threads = threads_;
    answer.states = task_.automaton ? task_.automaton->size() : 0;
    if (options_.shorten_s > 0.0) shorten(answer);
    answer.search.driven.reset();
    return answer;
  }

 private:
  // What was found in time has a second more to be judged.
  PlanJudgement judged(const TrainPlan& plan, const std::atomic<bool>* enough = nullptr) const {
    const auto until = Clock::now() + std::chrono::seconds(1);
    const auto stop = [&] {
      return deadline_.is_cancelled() || (enough != nullptr && enough->load()) ||
             (deadline_.over() && Clock::now() > until);
    };
    return judge_plan(problem_.floor, problem_.train, start_, task_.formula, plan,
                      {.read = problem_.read, .stop = stop});
  }

  // The shortest one that the plan checker accepts.
  void shorten(PlanAnswer& answer) const {
    if (answer.plan.pieces.empty()) return;
    std::vector<TrainPlan> plans =
        shorter_plans(ground_, [this] { return task_.states(); },
                      {.start = start_,
                       .than_m = answer.plan.length_m,
                       .first = answer.search.driven ? &*answer.search.driven : nullptr,
                       .seed = options_.seed,
                       .most_s = options_.shorten_s,
                       .most_rounds = options_.shorten_rounds,
                       .threads = threads_,
                       .cancel = options_.cancel});
    for (std::size_t n = 0; n < kMostJudged && n < plans.size(); ++n) {
      TrainPlan& plan = plans[plans.size() - 1 - n];
      PlanJudgement judgement = judged(plan);
      if (!judgement.accepted()) continue;
      answer.plan = std::move(plan);
      answer.judgement = std::move(judgement);
      answer.shortened = true;
      return;
    }
  }

  static result::Result<PlanAnswer> failed(const FirstPlan& none) {
    const result::Location nowhere;
    const std::string refused = none.judgement.reason;
    switch (none.search.end) {
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
      return result::fail(kAllRefused, nowhere, "the plan checker refused what was found: " + refused,
                          "another seed, or more time");
    return result::fail(kNoPlan, nowhere, "no plan was found in the time that there was",
                        "another seed, more time, or fewer trailers: a point can do the task");
  }

  const Problem& problem_;
  const PlanOptions& options_;
  const Deadline& deadline_;
  const PlannedTask& task_;
  const TrainState start_;
  const std::size_t threads_;
  const Places places_;
  const SearchGround ground_;
};

}  // namespace

result::Result<PlanAnswer> plan_train(const Problem& problem, const PlanOptions& options) {
  if (auto sound = validate(problem.train); !sound) return result::forward(sound);
  const Deadline deadline(options.most_s, options.cancel);
  auto map = make_regions(problem.floor, [&] { return deadline.over(); });
  if (!map && map.error().front().code == kStoppedRegions) return no_time_left(deadline);
  if (!map) return result::forward(map);
  auto task = read_planned(problem);
  if (!task) return result::forward(task);
  if (deadline.over()) return no_time_left(deadline);
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
