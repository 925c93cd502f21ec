#include "supervisor/tamp/planner/outcome_builder.h"

#include <time.h>

#include <algorithm>
#include <utility>

#include "supervisor/tamp/predicates/certify.h"

namespace stepwright::tamp::planner {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostRounds = 16;

double ms_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// Of this thread.
double cpu_ms() {
  timespec now{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return 0.0;
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

OutcomeBuilder::OutcomeBuilder(const scene::RobotCell& cell, const TampOptions& options,
                               const IntervalModel* model)
    : options_(options), workspace_(cell, options.seed), began_(Clock::now()), cpu_began_(cpu_ms()) {
  solver_options_.until = options.until;
  solver_options_.cancel = options.cancel;
  solver_options_.model = model;
}

void OutcomeBuilder::take_figures() {
  const predicates::Counts& counts = workspace_.counts();
  TampFigures& figures = outcome_.figures;
  figures.configurations = counts.configurations;
  figures.failed = counts.failed;
  figures.paths = counts.paths;
  figures.failed_paths = counts.failed_paths;
  figures.straight_paths = counts.straight_paths;
  figures.tree_paths = counts.tree_paths;
  figures.path_motions = counts.path_motions;
  figures.plan_ms = ms_between(began_, Clock::now());
  figures.plan_cpu_ms = cpu_ms() - cpu_began_;
}

void OutcomeBuilder::begin_round(std::size_t round) {
  // A path's search takes time with the square of its nodes, and is not interrupted.
  constexpr std::size_t kMostDoublings = 6, kMostOfNodes = 2;
  const std::size_t doublings = std::min(round, kMostDoublings);
  outcome_.figures.rounds = round + 1;
  failed_before_ = workspace_.counts().failed;
  solver_options_.more_samples = std::size_t{1} << doublings;
  solver_options_.most_failed = options_.first_failed << (3 * std::min(round, kMostRounds));
  solver_options_.most_path_motions = options_.first_path_motions << (3 * std::min(round, kMostRounds));
  workspace_.set_path_nodes(workspace_.cell().manner.path_nodes << (2 * std::min(round, kMostOfNodes)));
}

SolverAnswer OutcomeBuilder::attempt(const std::vector<scene::ActionSpec>& actions) {
  SolverOptions options = solver_options_;
  const predicates::Counts& counts = workspace_.counts();
  const auto left = [](std::uint64_t most, std::uint64_t used) { return most > used ? most - used : 0; };
  options.most_failed = std::min(options.most_failed, left(options_.most_failed, counts.failed));
  // 0 would be any number.
  options.most_path_motions = std::max<std::uint64_t>(
      1, std::min(options.most_path_motions, left(options_.most_path_motions, counts.path_motions)));
  SequenceSolver solver(workspace_, actions, options);
  ++outcome_.figures.sequences;
  SolverAnswer answer = solver.solve();
  outcome_.figures.backjumps += solver.backjumps();
  outcome_.figures.jumped_over += solver.jumped_over();
  if (!answer.solved) ++(answer.proven ? outcome_.figures.proved_nogoods : outcome_.figures.budget_nogoods);
  return answer;
}

bool OutcomeBuilder::used_up() const {
  return workspace_.counts().failed >= options_.most_failed ||
         workspace_.counts().path_motions >= options_.most_path_motions ||
         (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) || late();
}

bool OutcomeBuilder::late() const {
  return options_.until && Clock::now() >= *options_.until;
}

void OutcomeBuilder::close() {
  if (outcome_.plan || outcome_.kind != model::OutcomeKind::Exhausted || !late()) return;
  outcome_.by_clock = true;
  outcome_.reason += (outcome_.reason.empty() ? "" : "; ");
  outcome_.reason += "the time limit ended it, not its counted work";
}

bool OutcomeBuilder::worth_another(std::size_t round) const {
  return round + 1 < kMostRounds && workspace_.counts().failed > failed_before_ && !used_up();
}

bool OutcomeBuilder::finish(std::vector<predicates::Settled> settled) {
  take_figures();
  const Clock::time_point planned = Clock::now();
  const auto uncertain = predicates::certify(workspace_, settled, options_.seed);
  outcome_.figures.certify_ms = ms_between(planned, Clock::now());
  if (uncertain) {
    outcome_.kind = model::OutcomeKind::Exhausted;
    outcome_.reason = scene::text_of(workspace_.cell(), settled[uncertain->action].action.what) + ", " +
                      name_of(uncertain->phase) + ": " + uncertain->what;
    return false;
  }
  scene::TampPlan plan;
  for (predicates::Settled& each : settled) plan.actions.push_back(std::move(each.action));
  outcome_.plan = std::move(plan);
  outcome_.kind = model::OutcomeKind::Solved;
  outcome_.reason.clear();
  return true;
}

}  // namespace stepwright::tamp::planner
