#include "supervisor/ltl/mission/train_planning.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "ladder/driver/compile.h"
#include "supervisor/ltl/automaton/words.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl {
namespace {

// Beside what stands in the way, with the scanner unheeded.
constexpr double kSlow_m_s = 0.4;
// Who stands near something gets out with less around it.
constexpr std::array kMarginShares = {1.0, 0.5, 0.2};

TrainModel with_margin(const TrainModel& train, double margin_m, const TrainPlanningOptions& options) {
  TrainModel wide = train;
  wide.length_m += 2.0 * margin_m;
  wide.width_m += 2.0 * margin_m;
  wide.most_lock_rad *= options.lock_share;
  wide.most_hitch_rad = std::min(wide.most_hitch_rad, options.hitch_rad);
  return wide;
}

bool does_not_fit(const result::Diagnostics& wrong) {
  return !wrong.empty() && wrong.front().code == kStartDoesNotFit;
}

// Places that are blocked as a whole are never read: whether the task needs one.
result::Result<void> possible_without(const TrainRequest& request, const Floor& floor) {
  Letter never = 0;
  std::string names;
  for (std::size_t k = 0; k < floor.propositions.size(); ++k) {
    const auto same = [&](const Area& area) { return area.name == floor.propositions[k].name; };
    if (std::ranges::none_of(request.blocked, same)) continue;
    never |= Letter{1} << k;
    names += (names.empty() ? "'" : ", '") + floor.propositions[k].name + "'";
  }
  if (never == 0) return {};
  const Automaton& monitor = request.task->monitor;
  const auto done = std::ranges::find(monitor.verdicts, Verdict::True);
  const auto state = static_cast<std::uint32_t>(done - monitor.verdicts.begin());
  if (done != monitor.verdicts.end() && shortest_word(monitor, request.state, state, never)) return {};
  return result::fail(kImpossible, {}, "the task cannot be done without " + names,
                      "free the place, or want another task");
}

}  // namespace

result::Result<TrainPlanning> TrainPlanning::open(TrainPlanningOptions options) {
  TrainPlanning planning(std::move(options));
  const Problem& problem = planning.options_.problem;
  if (auto good = validate(problem.train); !good) return result::forward(good);
  auto regions = make_regions(problem.floor);
  if (!regions) return result::forward(regions);
  planning.regions_ = *std::move(regions);
  auto task = planning.task(problem.task);
  if (!task) return result::forward(task);
  planning.first_ = *std::move(task);
  return planning;
}

result::Result<TrainTask> TrainPlanning::task(const std::string& text) const {
  auto task = read_task(text, options_.problem.places(), "task");
  if (!task) return result::forward(task);
  if (stutter_report(task->formula).kind != StutterKind::Invariant)
    return result::fail("L0503", {"task", 1, 1}, "the task counts letters (X), which a scan does not",
                        "say what comes after what: 'visit a then b'");
  auto monitor = monitor_automaton(task->formula, {}, "task");
  if (!monitor) return result::forward(monitor);
  return TrainTask{text, std::move(task->formula), std::move(monitor->automaton)};
}

result::Result<PlanAnswer> TrainPlanning::answer(const TrainRequest& request, Problem& problem) const {
  problem = options_.problem;
  problem.train.trailers = request.trailers;
  problem.task = request.task->text;
  problem.floor.blocked = request.blocked;
  problem.start = {request.standing[kTrainX], request.standing[kTrainY], request.standing[kTrainHeading]};
  problem.trailers_rad.assign(
      request.standing.begin() + kTrainTrailer,
      request.standing.begin() + static_cast<std::ptrdiff_t>(kTrainTrailer + request.trailers));
  problem.read = shortest_word(request.task->monitor, request.task->begins(), request.state)
                     .value_or(std::vector<Letter>());
  if (auto good = possible_without(request, problem.floor); !good) return result::forward(good);
  const TrainModel train = problem.train;
  const PlanOptions options{.seed = options_.seed,
                            .most_s = options_.most_s,
                            .shorten_s = options_.shorten_rounds > 0 ? options_.most_s : 0.0,
                            .shorten_rounds = options_.shorten_rounds,
                            .threads = options_.threads,
                            .cancel = request.cancel};
  result::Result<PlanAnswer> found = result::fail(kStartDoesNotFit, {}, "the train does not fit");
  for (const double share : kMarginShares) {
    problem.train = with_margin(train, share * options_.margin_m, options_);
    found = plan_train(problem, options);
    if (found || !does_not_fit(found.error())) return found;
  }
  return found;
}

result::Result<PreparedTrain> TrainPlanning::plan(const TrainRequest& request) const {
  Problem problem;
  auto found = answer(request, problem);
  if (!found) return result::forward(found);
  PreparedTrain prepared;
  prepared.answer = *std::move(found);
  prepared.answer.plan = with_run_out(problem, prepared.answer.plan);
  prepared.way = train_way(problem, prepared.answer.plan, options_.program.drive);
  for (vehicle::PathSample& sample : prepared.way.samples)
    if (sample.arc_m < request.known_m) sample.speed_m_s = std::min(sample.speed_m_s, kSlow_m_s);
  prepared.train = options_.problem.train;
  prepared.train.trailers = request.trailers;
  prepared.watch = train_watch(request.task->monitor, request.task->text);
  prepared.watch.automaton.initial = request.state;
  if (auto made = compile(TrainProgramKind::Drive, request.known_m, request.reset, prepared); !made)
    return result::forward(made);
  return prepared;
}

result::Result<PreparedTrain> TrainPlanning::halt(const PreparedTrain& driven, std::uint32_t state) const {
  PreparedTrain prepared = driven;
  prepared.watch.automaton.initial = state;
  if (auto made = compile(TrainProgramKind::Halt, 0.0, 0, prepared); !made) return result::forward(made);
  return prepared;
}

result::Result<PreparedTrain> TrainPlanning::observe(const TrainTask& task, std::uint32_t state,
                                                     std::uint32_t reset) const {
  PreparedTrain prepared;
  prepared.train = options_.problem.train;
  prepared.train.trailers = 0;  // no hitch is watched before it is known how many are coupled
  prepared.watch = train_watch(task.monitor, task.text);
  prepared.watch.automaton.initial = state;
  if (auto made = compile(TrainProgramKind::Observe, 0.0, reset, prepared); !made)
    return result::forward(made);
  return prepared;
}

result::Result<void> TrainPlanning::compile(TrainProgramKind kind, double known_m, std::uint32_t reset,
                                            PreparedTrain& prepared) const {
  TrainProgramOptions options = options_.program;
  options.known_m = known_m;
  options.reset = reset;
  auto program = train_program({.kind = kind,
                                .train = &prepared.train,
                                .places = options_.problem.places(),
                                .way = kind == TrainProgramKind::Observe ? nullptr : &prepared.way,
                                .watch = &prepared.watch},
                               options_.terminals, options);
  if (!program) return result::forward(program);
  prepared.program = *std::move(program);
  driver::CompileInput input;
  input.texts.push_back({"task_monitor.st", prepared.program.monitor});
  input.projects.push_back(&prepared.program.project);
  input.document = true;
  input.watchers = options_.watchers;
  auto output = driver::compile(input);
  if (!output) return result::forward(output);
  prepared.container = std::move(output->container);
  return {};
}

}  // namespace stepwright::ltl
