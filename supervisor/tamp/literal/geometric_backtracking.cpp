#include "supervisor/tamp/literal/geometric_backtracking.h"

#include <utility>

#include "supervisor/tamp/predicates/samples.h"

namespace stepwright::tamp::literal {

using predicates::FailureKind;

GeometricBacktracking::GeometricBacktracking(const predicates::Grounding& grounding,
                                             predicates::Workspace& workspace, BacktrackingOptions options)
    : grounding_(&grounding),
      workspace_(&workspace),
      options_(options),
      initial_(scene::initial_state(workspace.cell())) {}

void GeometricBacktracking::push(const htn::ExternalCall&) {
  frames_.emplace_back();
}

std::optional<htn::Refusal> GeometricBacktracking::require(const htn::ExternalCall& atom, bool wanted) {
  const std::size_t before = frames_.empty() ? 0 : frames_.size() - 1;
  const auto action = grounding_->action_of(atom);
  if (!action) return htn::Refusal{before, true, "the cell has no such arm, thing or region"};
  if (!wanted || frames_.empty() || frames_.back().action)
    return htn::Refusal{before, false, "geometry is asked once for each action, and not negated"};
  frames_.back().action = action;
  reset(frames_.back());
  soft_ = false;
  const std::vector<Frame> kept = frames_;
  if (settle_last()) return std::nullopt;
  frames_ = kept;
  frames_.back().action.reset();
  const bool proven = !soft_ && !stopped_;
  return htn::Refusal{before, proven,
                      scene::text_of(workspace_->cell(), *action) +
                          (stopped_ ? ": not within its budget" : ": none of all samples")};
}

std::optional<htn::Refusal> GeometricBacktracking::change(const htn::ExternalCall& atom, bool value) {
  const auto action = grounding_->action_of(atom);
  if (value && action && !frames_.empty() && frames_.back().settled && *frames_.back().action == *action)
    return std::nullopt;
  return htn::Refusal{frames_.empty() ? 0 : frames_.size() - 1, false, "an effect without its condition"};
}

std::vector<predicates::Settled> GeometricBacktracking::settled() const {
  std::vector<predicates::Settled> all;
  for (const Frame& each : frames_)
    if (each.settled) all.push_back(*each.settled);
  return all;
}

const scene::GeometricState& GeometricBacktracking::state_before(std::size_t frame) const {
  while (frame-- > 0)
    if (frames_[frame].settled) return frames_[frame].settled->after;
  return initial_;
}

std::size_t GeometricBacktracking::samples_of(const scene::ActionSpec& action) const {
  const scene::Manner& manner = workspace_->cell().manner;
  return action.kind == scene::ActionKind::Pick    ? manner.grasps
         : action.kind != scene::ActionKind::Place ? 1
         : action.on < 0 || workspace_->cell().things[static_cast<std::size_t>(action.thing)].turns
             ? manner.places
             : 1;
}

predicates::Sample GeometricBacktracking::sample(const scene::GeometricState& state,
                                                 const scene::ActionSpec& action, std::size_t k) const {
  const scene::RobotCell& cell = workspace_->cell();
  k += options_.first_sample;
  if (action.kind == scene::ActionKind::Pick) return {predicates::grasp_sample(k), {}};
  if (action.kind == scene::ActionKind::MoveAway) return {};
  if (action.on >= 0) return {0.0, predicates::stack_sample(cell, action.on, action.thing, state, k)};
  return {0.0, predicates::place_sample(cell.surfaces[static_cast<std::size_t>(action.surface)],
                                        cell.things[static_cast<std::size_t>(action.thing)], k)};
}

void GeometricBacktracking::reset(Frame& frame) {
  frame.sample = frame.way = 0;
  frame.ways.clear();
  frame.settled.reset();
}

bool GeometricBacktracking::stopped() {
  constexpr std::uint64_t kBetweenLooks = 16;
  if (workspace_->counts().failed >= options_.most_failed) stopped_ = true;
  if (++looks_ % kBetweenLooks == 0) {
    if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) stopped_ = true;
    if (options_.until && std::chrono::steady_clock::now() >= *options_.until) stopped_ = true;
  }
  return stopped_;
}

// The next index of this frame that works, all frames before it as they are.
bool GeometricBacktracking::advance(std::size_t k) {
  Frame& frame = frames_[k];
  frame.settled.reset();
  const std::size_t all = samples_of(*frame.action);
  const scene::GeometricState& state = state_before(k);
  while (!stopped()) {
    if (frame.way == frame.ways.size()) {
      if (frame.sample == all) return false;
      frame.chosen = sample(state, *frame.action, frame.sample++);
      frame.way = 0;
      auto found = workspace_->ways(state, *frame.action, frame.chosen);
      if (found)
        frame.ways = *std::move(found);
      else
        frame.ways.clear();
      continue;
    }
    auto settled = workspace_->settle(state, *frame.action, frame.chosen, frame.ways[frame.way++], true);
    if (settled) {
      frame.settled = *std::move(settled);
      if (!options_.all_ways) frame.way = frame.ways.size();
      return true;
    }
    if (settled.error().kind == FailureKind::NoPath) soft_ = true;
  }
  return false;
}

// Values for the last frame, and for those before it where it has none with them.
bool GeometricBacktracking::settle_last() {
  const std::size_t last = frames_.size() - 1;
  std::size_t k = last;
  bool backtracking = false;
  for (;;) {
    const predicates::Counts before = workspace_->counts();
    const bool found = advance(k);
    if (backtracking) {
      again_ += workspace_->counts().configurations - before.configurations;
      failed_again_ += workspace_->counts().failed - before.failed;
    }
    if (stopped_) return false;
    if (found && k == last) return true;
    if (found) {
      do ++k;
      while (!frames_[k].action);
      reset(frames_[k]);
      continue;
    }
    reset(frames_[k]);
    backtracking = true;
    do {
      if (k == 0) return false;
      --k;
    } while (!frames_[k].action);
  }
}

}  // namespace stepwright::tamp::literal
