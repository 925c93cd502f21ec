// From rest to the next plan.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "supervisor/ltl/mission/train_mission.h"

namespace stepwright::ltl {

using run::IncidentKind;
using run::Phase;
using run::Response;
using std::chrono::steady_clock;

namespace {

constexpr double kKnown_m = 4.0;

double milliseconds_since(steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(steady_clock::now() - begin).count();
}

}  // namespace

// What cannot be planned is no end while the train stands: people can free a place, or want something else.
bool TrainMission::plan_from_rest() {
  while (true) {
    if (task_.monitor.verdicts[state_] == Verdict::True) return finish();
    const auto begin = steady_clock::now();
    auto prepared = planning_.plan({.task = &task_,
                                    .state = state_,
                                    .standing = reading_.standing_state(),
                                    .trailers = reading_.trailers,
                                    .blocked = blocked_,
                                    .known_m = stands_ahead() ? kKnown_m : 0.0,
                                    .cancel = &abort_});
    if (abort_) return give_up_aborted();
    if (prepared) {
      if (!record_.incidents.empty()) record_.incidents.back().replan_ms = milliseconds_since(begin);
      prepared->answer.search.spent_s = 1e-3 * milliseconds_since(begin);
      return launch(*std::move(prepared));
    }
    const std::string reason = "there is no plan: " + result::to_string(prepared.error());
    if (!stay(reason, IncidentKind::Position) || !bring_to_rest()) return false;
  }
}

bool TrainMission::launch(PreparedTrain prepared) {
  driven_ = std::move(prepared);
  decide(Response::Replan);
  if (!bring_to_run([&] { return install(*driven_); })) return false;
  launch_record();
  pictures_.drive(*driven_, digest_);
  draw();
  set_phase(Phase::Executing, fmt::format("driving: {}", task_.text));
  return true;
}

void TrainMission::launch_record() {
  run::Episode episode;
  episode.digest = digest_;
  episode.started_s = clock_.now_s();
  episode.cost = driven_->way.end_m;
  episode.origin = record_.episodes.empty() ? "planned" : "replanned";
  episode.first_plan_ms = 1e3 * driven_->answer.search.spent_s;
  episode.planned_makespan_s = driven_->way.time_at(driven_->way.end_m);
  episode.planned_sequential_makespan_s = episode.planned_makespan_s;
  double before_m = 0.0;
  const std::vector<std::string> places = planning_.options().problem.places();
  for (const TrainStep& step : steps_) {
    if (step.kind != TrainStepKind::Drive && step.kind != TrainStepKind::Arrive) continue;
    run::ActionRecord action;
    std::string names;
    for (std::size_t k = 0; k < places.size(); ++k)
      if ((step.label >> k & 1) != 0) names += (names.empty() ? "" : " ") + places[k];
    action.text = step.kind == TrainStepKind::Arrive ? "(stop)"
                  : names.empty()                    ? "(leave)"
                                                     : "(reach " + names + ")";
    action.step = step.name;
    action.planned_start_s = driven_->way.time_at(before_m);
    action.planned_finish_s = driven_->way.time_at(step.arc_m);
    action.planned_cost = step.arc_m - before_m;
    before_m = step.arc_m;
    episode.actions.push_back(std::move(action));
  }
  if (record_.episodes.empty()) record_.started_s = record_.finished_s = episode.started_s;
  record_.episodes.push_back(std::move(episode));
}

// False: the runtime is lost, or the run is over.
bool TrainMission::install(const PreparedTrain& prepared) {
  auto reader =
      TrainReader::create(prepared.container, prepared.program, planning_.options().terminals.hitches.size());
  if (!reader) return give_up("the program cannot be read", reader.error());
  return relieve(reader_ && runs(), prepared.container, [&] {
    reader_ = *std::move(reader);
    steps_ = prepared.program.steps;
    watched_ = prepared.watch.text;
  });
}

}  // namespace stepwright::ltl
