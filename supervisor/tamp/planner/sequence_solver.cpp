#include "supervisor/tamp/planner/sequence_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
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

constexpr int kTurns = 8;  // angles of a thing whose angle is to be chosen

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

// The action that put the thing where it is on which this one puts something; nothing: it stands where it
// began, or this one puts nothing on a thing.
std::optional<std::size_t> SequenceSolver::base_of(std::size_t level) const {
  if (actions_[level].on < 0) return std::nullopt;
  return last_about(index_of(actions_[level].on), level);
}

// A region that gets more things of one size than there is room for, or a thing a wider one, whatever the
// places: proved.
std::optional<SolverAnswer> SequenceSolver::check_room() const {
  const scene::RobotCell& cell = workspace_->cell();
  std::vector<int> on(cell.things.size(), -1);
  for (std::size_t k = 0; k < actions_.size(); ++k) {
    const ActionSpec& action = actions_[k];
    if (action.kind == ActionKind::Pick) on[index_of(action.thing)] = -1;
    if (action.kind != ActionKind::Place) continue;
    on[index_of(action.thing)] = action.surface;
    if (action.surface < 0) {
      const scene::Thing &upper = cell.things[index_of(action.thing)],
                         &lower = cell.things[index_of(action.on)];
      if (fits_on(upper.form, lower.form)) continue;
      SolverAnswer answer;
      answer.keep = k;
      answer.proven = true;
      answer.reason = upper.name + " is wider than " + lower.name;
      return answer;
    }
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
    if (!too_many(count, surface.size_x_m, surface.size_y_m, least_m, 0.0)) continue;
    const std::size_t most = most_that_fit(surface.size_x_m, surface.size_y_m, least_m, 0.0);
    SolverAnswer answer;
    answer.keep = k;
    answer.proven = true;
    answer.reason = surface.name + " takes no more than " + std::to_string(most) + " of " + names;
    return answer;
  }
  return std::nullopt;
}

// A thing that has a region for itself need not stand in the middle: what an arm reaches is mostly a part of
// it.
void SequenceSolver::add_places_around(std::size_t level) {
  const scene::RobotCell& cell = workspace_->cell();
  const scene::Surface& on = cell.surfaces[index_of(actions_[level].surface)];
  const double across_m = 2.0 * radius_around(cell.things[index_of(actions_[level].thing)].form);
  const double free_x = on.size_x_m - across_m, free_y = on.size_y_m - across_m;
  for (const double part : {0.25, 0.5})
    for (const double x : {-part, part})
      for (const double y : {-part, part})
        others_[level].push_back(predicates::place_on(on, x * free_x, y * free_y, 0.0));
  alone_[level] = true;
}

// Places for all that ends on a region, at once.
void SequenceSolver::pack_regions() {
  const scene::RobotCell& cell = workspace_->cell();
  packed_.assign(actions_.size(), std::nullopt);
  others_.assign(actions_.size(), {});
  alone_.assign(actions_.size(), false);
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
    if (levels.size() == 1 && problem.standing.empty()) add_places_around(levels.front());
  }
  // In the order of the sequence: what is below is known by then.
  for (std::size_t k = 0; k < actions_.size(); ++k) {
    if (actions_[k].on < 0) continue;
    const auto put = base_of(k);
    const std::optional<scene::Pose> below =
        put ? packed_[*put] : std::optional(cell.things[index_of(actions_[k].on)].start);
    if (below) packed_[k] = top_of(cell, actions_[k].on, *below, below->angle_rad);
  }
}

std::vector<Sample> SequenceSolver::places_of(std::size_t level) const {
  const scene::RobotCell& cell = workspace_->cell();
  const ActionSpec& action = actions_[level];
  const scene::Thing& thing = cell.things[index_of(action.thing)];
  std::vector<Sample> all;
  const auto add = [&](scene::Pose pose) {
    for (int k = 0; k < (thing.turns ? kTurns : 1); ++k) {
      pose.angle_rad = thing.start.angle_rad + 2.0 * std::numbers::pi * k / kTurns;
      all.push_back({0.0, pose});
    }
  };
  if (action.on >= 0) {
    add(top_of(cell, action.on, state_before(level).things[index_of(action.on)].pose, 0.0));
    return all;
  }
  if (packed_[level]) add(*packed_[level]);
  if (stage_ == Stage::Packed && packed_[level] && !alone_[level]) return all;
  for (const scene::Pose& each : others_[level]) add(each);
  if (stage_ != Stage::Everything && packed_[level]) return all;
  for (std::size_t k = 0; k < cell.manner.places * options_.more_samples; ++k)
    all.push_back({0.0, predicates::place_sample(cell.surfaces[index_of(action.surface)], thing, k)});
  return all;
}

// The visits of hands to a thing from this action on, as far as it is known where it will be put.
ReachOrder SequenceSolver::reach_from(std::size_t level, scene::Pose pose) const {
  constexpr std::size_t kMostGrasps = 16, kMostVisits = 4;
  const scene::RobotCell& cell = workspace_->cell();
  const scene::Thing& thing = cell.things[index_of(actions_[level].thing)];
  std::vector<double> grasps, angles;
  for (std::size_t k = 0; k < std::min(cell.manner.grasps, kMostGrasps); ++k)
    grasps.push_back(predicates::grasp_sample(k));
  for (int k = 0; k < (thing.turns ? kTurns : 1); ++k)
    angles.push_back(thing.start.angle_rad + 2.0 * std::numbers::pi * k / kTurns);
  ReachOrder order(*options_.model, std::move(grasps), std::move(angles));
  for (std::size_t k = level; k < actions_.size() && order.visits() < kMostVisits; ++k) {
    if (actions_[k].thing != actions_[level].thing || actions_[k].kind == ActionKind::MoveAway) continue;
    if (k > level && actions_[k].kind == ActionKind::Place) {
      if (!packed_[k]) break;
      pose = *packed_[k];
    }
    order.then(actions_[k].arm, {pose.x_m, pose.y_m, pose.z_m + cell.tool_above(actions_[level].thing)});
  }
  return order;
}

// What the bounds of reach exclude comes last. Of things that turn the choices that are farthest inside of
// all bounds come first: there are many, and most fail at the other end of the way.
void SequenceSolver::put_hopeful_first(std::size_t level) {
  Level& here = levels_[level];
  here.hopeful = here.samples.size();
  if (options_.model == nullptr || actions_[level].kind == ActionKind::MoveAway) return;
  const scene::ThingState& thing = state_before(level).things[index_of(actions_[level].thing)];
  const bool pick = actions_[level].kind == ActionKind::Pick;
  std::vector<std::pair<double, Sample>> valued;
  std::optional<ReachOrder> order;
  scene::Pose last;
  for (const Sample& each : here.samples) {
    const scene::Pose& pose = pick ? thing.pose : each.pose;
    if (!order || pose.x_m != last.x_m || pose.y_m != last.y_m) order = reach_from(level, last = pose);
    valued.emplace_back(pick ? order->of_grasp(pose.angle_rad, each.hand_rad)
                             : order->of_place(pose.angle_rad, thing.hand_rad),
                        each);
  }
  const bool by_margin = workspace_->cell().things[index_of(actions_[level].thing)].turns &&
                         (pick || stage_ != Stage::Everything);
  if (by_margin)
    std::ranges::stable_sort(valued, [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto rest = std::ranges::stable_partition(valued, [](const auto& each) { return each.first > 0.0; });
  here.hopeful = valued.size() - rest.size();
  for (std::size_t k = 0; k < valued.size(); ++k) here.samples[k] = valued[k].second;
}

// What is expected to stand around where a place is, when it is done.
std::vector<scene::Upright> SequenceSolver::around_at(std::size_t place) const {
  const scene::RobotCell& cell = workspace_->cell();
  std::vector<scene::Upright> others;
  for (const scene::Furniture& each : cell.furniture) others.push_back(standing(each.form, each.pose));
  for (std::size_t thing = 0; thing < cell.things.size(); ++thing) {
    if (thing == index_of(actions_[place].thing)) continue;
    const auto put = last_about(thing, place);
    std::optional<scene::Pose> pose = cell.things[thing].start;
    if (put) pose = actions_[*put].kind == ActionKind::Place ? packed_[*put] : std::nullopt;
    if (pose) others.push_back(standing(cell.things[thing].form, *pose));
  }
  return others;
}

// Puts the best of the grasps that were not tried in front of them: an angle that leaves the hand most room
// where the thing is going; what is enough for it is enough. What is excluded from reach stays behind.
void SequenceSolver::choose_grasp(std::size_t level) {
  Level& here = levels_[level];
  const auto place = next_place(level);
  if (here.ordered || !place || !packed_[*place] || here.sample >= here.hopeful) return;
  const scene::RobotCell& cell = workspace_->cell();
  const ActionSpec& action = actions_[level];
  const std::span<Sample> left = std::span(here.samples).first(here.hopeful).subspan(here.sample);
  const std::vector<scene::Upright> others = around_at(*place);
  const scene::Pose& to = *packed_[*place];
  const double turned = cell.things[index_of(action.thing)].start.angle_rad;
  std::vector<std::pair<double, Sample>> valued;
  constexpr double kEnough_m = 0.02;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const predicates::ToolPlace tool{to.x_m, to.y_m, to.z_m + cell.tool_above(action.thing),
                                     turned + left[k].hand_rad};
    valued.emplace_back(workspace_->hand_room(action.arm, action.thing, tool, others), left[k]);
    if (valued.back().first < kEnough_m) continue;
    const auto chosen = left.begin() + static_cast<std::ptrdiff_t>(k);
    std::rotate(left.begin(), chosen, chosen + 1);
    return;
  }
  here.ordered = true;
  std::ranges::stable_sort(valued, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < valued.size(); ++k) left[k] = valued[k].second;
}

void SequenceSolver::begin(std::size_t level) {
  Level& here = levels_[level];
  here = {};
  switch (actions_[level].kind) {
    case ActionKind::Pick:
      for (std::size_t k = 0; k < workspace_->cell().manner.grasps * options_.more_samples; ++k)
        here.samples.push_back({predicates::grasp_sample(k), {}});
      put_hopeful_first(level);
      break;
    case ActionKind::Place:
      here.samples = places_of(level);
      put_hopeful_first(level);
      // Where it can be put is only known once what it is put on has its place.
      if (const auto put = base_of(level)) here.conflict = bit_of(*put);
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
  const predicates::Counts& counts = workspace_->counts();
  if (counts.failed - began_with_ >= options_.most_failed) stopped_ = true;
  if (options_.most_path_motions > 0 && counts.path_motions - motions_before_ >= options_.most_path_motions)
    stopped_ = true;
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
    here.last.add(failure);
  };
  while (!stopped()) {
    if (here.way == here.ways.size()) {
      if (here.sample == here.samples.size()) return false;
      if (actions_[level].kind == ActionKind::Pick) choose_grasp(level);
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
      levels_[k].last.add(motions.error());
      return k;
    }
    levels_[k].settled->action.motions = *std::move(motions);
  }
  return actions_.size();
}

std::string SequenceSolver::words(std::size_t level) const {
  return scene::text_of(workspace_->cell(), actions_[level]) + ": " +
         text_of(workspace_->cell(), levels_[level].last);
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
  motions_before_ = workspace_->counts().path_motions;
  levels_.assign(actions_.size(), {});
  if (options_.pack)
    pack_regions();
  else
    packed_.assign(actions_.size(), std::nullopt), others_.assign(actions_.size(), {}),
        alone_.assign(actions_.size(), false);
  for (const Stage stage : {Stage::Packed, Stage::Exchanged, Stage::Everything}) {
    bool same_as_before = stage == Stage::Exchanged;
    for (std::size_t k = 0; k < others_.size(); ++k)
      same_as_before = same_as_before && (others_[k].empty() || alone_[k]);
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
