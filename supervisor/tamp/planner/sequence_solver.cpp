#include "supervisor/tamp/planner/sequence_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "supervisor/tamp/planner/packing.h"
#include "supervisor/tamp/predicates/samples.h"

namespace stepwright::tamp::planner {

namespace {

using predicates::Failure;
using predicates::FailureKind;
using predicates::Sample;
using scene::ActionKind;
using scene::ActionSpec;

std::uint64_t bit_of(std::size_t k) {
  return std::uint64_t{1} << k;
}
std::size_t index_of(int number) {
  return static_cast<std::size_t>(number);
}

// Of a pose in the frame of a surface, from its middle.
PlanePoint in_frame(const scene::Surface& surface, const scene::Pose& pose) {
  const double c = std::cos(surface.middle.angle_rad), s = std::sin(surface.middle.angle_rad);
  const double dx = pose.x_m - surface.middle.x_m, dy = pose.y_m - surface.middle.y_m;
  return {c * dx + s * dy, c * dy - s * dx};
}

}  // namespace

SequenceSolver::SequenceSolver(predicates::Workspace& workspace, std::vector<ActionSpec> actions,
                               SolverOptions options)
    : workspace_(&workspace),
      actions_(std::move(actions)),
      options_(options),
      initial_(scene::initial_state(workspace.cell())) {}

// The action that put the thing where it is before this one; nothing: it stands where it began.
std::optional<std::size_t> SequenceSolver::last_about(std::size_t thing, std::size_t before) const {
  for (std::size_t k = before; k-- > 0;)
    if (index_of(actions_[k].thing) == thing && actions_[k].kind != ActionKind::MoveAway) return k;
  return std::nullopt;
}

std::optional<std::size_t> SequenceSolver::next_place(std::size_t level) const {
  for (std::size_t k = level + 1; k < actions_.size(); ++k)
    if (actions_[k].thing == actions_[level].thing && actions_[k].kind != ActionKind::MoveAway)
      return actions_[k].kind == ActionKind::Place ? std::optional(k) : std::nullopt;
  return std::nullopt;
}

// A region that gets more things of one size than there is room for, whatever the places: proved.
std::optional<SolverAnswer> SequenceSolver::check_room() const {
  const scene::RobotCell& cell = workspace_->cell();
  std::vector<int> on(cell.things.size(), -1);
  for (std::size_t k = 0; k < actions_.size(); ++k) {
    const ActionSpec& action = actions_[k];
    if (action.kind == ActionKind::Pick) on[index_of(action.thing)] = -1;
    if (action.kind != ActionKind::Place) continue;
    on[index_of(action.thing)] = action.surface;
    const scene::Surface& surface = cell.surfaces[index_of(action.surface)];
    double least_m = 1e9;
    std::size_t count = 0;
    std::string names;
    for (std::size_t thing = 0; thing < on.size(); ++thing) {
      if (on[thing] != action.surface) continue;
      ++count;
      least_m = std::min(least_m, radius_around(cell.things[thing].form));
      names += (names.empty() ? "" : ", ") + cell.things[thing].name;
    }
    const std::size_t most = most_that_fit(surface.size_x_m, surface.size_y_m, least_m, 0.0);
    if (count <= most) continue;
    SolverAnswer answer;
    answer.keep = k;
    answer.proven = true;
    answer.reason = surface.name + " takes no more than " + std::to_string(most) + " of " + names;
    return answer;
  }
  return std::nullopt;
}

// Places for all that ends on a region, at once.
void SequenceSolver::pack_regions() {
  const scene::RobotCell& cell = workspace_->cell();
  packed_.assign(actions_.size(), std::nullopt);
  others_.assign(actions_.size(), {});
  for (std::size_t surface = 0; surface < cell.surfaces.size(); ++surface) {
    const scene::Surface& on = cell.surfaces[surface];
    PackProblem problem;
    problem.size_x_m = on.size_x_m;
    problem.size_y_m = on.size_y_m;
    problem.apart_m = cell.manner.things_apart_m + 1e-6;
    std::vector<std::size_t> levels;
    for (std::size_t k = 0; k < actions_.size(); ++k)
      if (actions_[k].kind == ActionKind::Place && index_of(actions_[k].surface) == surface) {
        levels.push_back(k);
        problem.radii_m.push_back(radius_around(cell.things[index_of(actions_[k].thing)].form));
      }
    if (levels.empty()) continue;
    for (std::size_t thing = 0; thing < cell.things.size(); ++thing) {
      const PlanePoint at = in_frame(on, cell.things[thing].start);
      if (last_about(thing, actions_.size()) || std::abs(at.x_m) > on.size_x_m ||
          std::abs(at.y_m) > on.size_y_m)
        continue;
      problem.standing.push_back(at);
      problem.standing_radii_m.push_back(radius_around(cell.things[thing].form));
    }
    const auto places = spread(problem);
    if (!places) continue;
    // The farthest from the robot first, so that no arm has to reach over what stands there.
    std::vector<std::size_t> order(levels.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    const bool same =
        std::ranges::all_of(problem.radii_m, [&](double each) { return each == problem.radii_m.front(); });
    std::vector<scene::Pose> poses;
    for (const PlanePoint& each : *places) poses.push_back(predicates::place_on(on, each.x_m, each.y_m, 0.0));
    if (same)
      std::ranges::stable_sort(poses, [](const scene::Pose& a, const scene::Pose& b) {
        return std::hypot(a.x_m, a.y_m) > std::hypot(b.x_m, b.y_m) + 1e-6;
      });
    for (std::size_t k = 0; k < levels.size(); ++k) {
      packed_[levels[k]] = poses[k];
      if (same)
        for (std::size_t other = 0; other < poses.size(); ++other)
          if (other != k) others_[levels[k]].push_back(poses[other]);
    }
  }
}

std::vector<Sample> SequenceSolver::places_of(std::size_t level) const {
  const scene::RobotCell& cell = workspace_->cell();
  const ActionSpec& action = actions_[level];
  const scene::Thing& thing = cell.things[index_of(action.thing)];
  std::vector<Sample> all;
  const auto add = [&](scene::Pose pose) {
    constexpr int kTurns = 8;
    for (int k = 0; k < (thing.turns ? kTurns : 1); ++k) {
      pose.angle_rad = thing.start.angle_rad + 2.0 * std::numbers::pi * k / kTurns;
      all.push_back({0.0, pose});
    }
  };
  if (packed_[level]) add(*packed_[level]);
  if (stage_ == Stage::Packed && packed_[level]) return all;
  for (const scene::Pose& each : others_[level]) add(each);
  if (stage_ == Stage::Exchanged && packed_[level]) return all;
  for (std::size_t k = 0; k < cell.manner.places; ++k)
    all.push_back({0.0, predicates::place_sample(cell.surfaces[index_of(action.surface)], thing, k)});
  return all;
}

// Angles that leave the hand most room where the thing is going come first.
void SequenceSolver::order_grasps(std::size_t level) {
  const auto place = next_place(level);
  if (!place || !packed_[*place]) return;
  const scene::RobotCell& cell = workspace_->cell();
  const ActionSpec& action = actions_[level];
  std::vector<scene::Upright> others;
  for (const scene::Furniture& each : cell.furniture) others.push_back(standing(each.form, each.pose));
  for (std::size_t thing = 0; thing < cell.things.size(); ++thing) {
    if (thing == index_of(action.thing)) continue;
    const auto put = last_about(thing, *place);
    std::optional<scene::Pose> pose = cell.things[thing].start;
    if (put) pose = actions_[*put].kind == ActionKind::Place ? packed_[*put] : std::nullopt;
    if (pose) others.push_back(standing(cell.things[thing].form, *pose));
  }
  const scene::Pose& to = *packed_[*place];
  const double turned = cell.things[index_of(action.thing)].start.angle_rad;
  std::vector<std::pair<double, Sample>> valued;
  constexpr double kEnough_m = 0.02;
  for (const Sample& each : levels_[level].samples) {
    const predicates::ToolPlace tool{to.x_m, to.y_m, to.z_m + cell.tool_above(action.thing),
                                     turned + each.hand_rad};
    valued.emplace_back(std::min(kEnough_m, workspace_->hand_room(action.arm, action.thing, tool, others)),
                        each);
  }
  std::ranges::stable_sort(valued, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < valued.size(); ++k) levels_[level].samples[k] = valued[k].second;
}

void SequenceSolver::begin(std::size_t level) {
  Level& here = levels_[level];
  here = {};
  switch (actions_[level].kind) {
    case ActionKind::Pick:
      for (std::size_t k = 0; k < workspace_->cell().manner.grasps; ++k)
        here.samples.push_back({predicates::grasp_sample(k), {}});
      order_grasps(level);
      break;
    case ActionKind::Place:
      here.samples = places_of(level);
      break;
    case ActionKind::MoveAway:
      here.samples.emplace_back();
      break;
  }
}

const scene::GeometricState& SequenceSolver::state_before(std::size_t level) const {
  return level == 0 ? initial_ : levels_[level - 1].settled->after;
}

// The earlier choices without which this would not have failed.
std::uint64_t SequenceSolver::blame(std::size_t level, const Failure& failure) const {
  const std::uint64_t all = level == 0 ? 0 : bit_of(level) - 1;
  if (failure.kind == FailureKind::ArmMeets || failure.kind == FailureKind::NoPath ||
      failure.kind == FailureKind::Impossible)
    return all;
  std::uint64_t blamed = 0;
  for (std::size_t thing = 0; thing < workspace_->cell().things.size(); ++thing)
    if ((failure.things & bit_of(thing)) != 0)
      if (const auto put = last_about(thing, level)) blamed |= bit_of(*put);
  // The grasp of what is placed, or the place of what is picked; whether there is room knows neither.
  if (failure.kind != FailureKind::NoRoom)
    if (const auto own = last_about(index_of(actions_[level].thing), level)) blamed |= bit_of(*own);
  return blamed;
}

bool SequenceSolver::stopped() {
  constexpr std::uint64_t kBetweenLooks = 16;
  if (workspace_->counts().failed - began_with_ >= options_.most_failed) stopped_ = true;
  if (++looks_ % kBetweenLooks == 0) {
    if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) stopped_ = true;
    if (options_.until && std::chrono::steady_clock::now() >= *options_.until) stopped_ = true;
  }
  return stopped_;
}

bool SequenceSolver::advance(std::size_t level) {
  Level& here = levels_[level];
  here.settled.reset();
  const scene::GeometricState& state = state_before(level);
  const auto failed = [&](const Failure& failure) {
    here.conflict |= blame(level, failure);
    here.last = failure.kind;
  };
  while (!stopped()) {
    if (here.way == here.ways.size()) {
      if (here.sample == here.samples.size()) return false;
      here.way = 0;
      auto found = workspace_->ways(state, actions_[level], here.samples[here.sample++]);
      here.ways = found ? *std::move(found) : std::vector<predicates::ArmWay>{};
      if (!found) failed(found.error());
      continue;
    }
    const std::size_t way = here.way++;
    auto settled =
        workspace_->settle(state, actions_[level], here.samples[here.sample - 1], here.ways[way], false);
    if (settled) {
      here.settled = *std::move(settled);
      return true;
    }
    failed(settled.error());
  }
  return false;
}

// Motions for all actions; the first that has none, or their number.
std::size_t SequenceSolver::connect() {
  for (std::size_t k = 0; k < actions_.size(); ++k) {
    if (!levels_[k].settled->action.motions.empty()) continue;
    auto motions = workspace_->connect(state_before(k), *levels_[k].settled);
    if (!motions) {
      levels_[k].conflict |= blame(k, motions.error());
      levels_[k].last = motions.error().kind;
      return k;
    }
    levels_[k].settled->action.motions = *std::move(motions);
  }
  return actions_.size();
}

std::string SequenceSolver::words(std::size_t level) const {
  return scene::text_of(workspace_->cell(), actions_[level]) + ": " + name_of(levels_[level].last);
}

SolverAnswer SequenceSolver::solve() {
  SolverAnswer answer;
  constexpr std::size_t kMostActions = 64;
  if (actions_.size() > kMostActions || workspace_->cell().things.size() > kMostActions) {
    answer.reason = "more than 64 actions or things";
    return answer;
  }
  if (auto full = check_room()) return *full;
  began_with_ = workspace_->counts().failed;
  levels_.assign(actions_.size(), {});
  if (options_.pack)
    pack_regions();
  else
    packed_.assign(actions_.size(), std::nullopt), others_.assign(actions_.size(), {});
  for (const Stage stage : {Stage::Packed, Stage::Exchanged, Stage::Everything}) {
    const bool same_as_before = stage == Stage::Exchanged &&
                                std::ranges::all_of(others_, [](const auto& each) { return each.empty(); });
    if (!same_as_before && (search(stage, answer) || stopped_)) break;
  }
  answer.stopped = stopped_;
  return answer;
}

bool SequenceSolver::search(Stage stage, SolverAnswer& answer) {
  stage_ = stage;
  std::size_t k = 0, deepest = 0;
  if (!actions_.empty()) begin(0);
  while (true) {
    if (k == actions_.size()) {
      const std::size_t without = connect();
      if (without == actions_.size()) {
        answer.solved = true;
        for (Level& each : levels_) answer.settled.push_back(*std::move(each.settled));
        return true;
      }
      k = without;
      continue;  // its next choice
    }
    if (advance(k)) {
      deepest = std::max(deepest, k);
      if (++k < actions_.size()) begin(k);
      continue;
    }
    if (k >= deepest) answer.reason = words(k);
    answer.keep = k;
    if (stopped_ || levels_[k].conflict == 0) return false;
    const auto back = static_cast<std::size_t>(63 - std::countl_zero(levels_[k].conflict));
    const std::uint64_t rest = levels_[k].conflict & ~bit_of(back);
    ++backjumps_;
    jumped_over_ += k - back - 1;
    levels_[back].conflict |= rest;
    k = back;
  }
}

}  // namespace stepwright::tamp::planner
