#include "supervisor/tamp/intervals/search/nogoods.h"

#include <algorithm>

#include "supervisor/tamp/intervals/cause/conflict_set.h"

namespace stepwright::tamp {
namespace {

bool same(const Action& a, const Action& b) {
  const auto same_beyond = [](const Beyond& x, const Beyond& y) {
    return x.object == y.object && x.direction_rad == y.direction_rad && x.distance_m == y.distance_m;
  };
  return a.kind == b.kind && a.arm == b.arm && a.object == b.object && a.region == b.region && a.on == b.on &&
         a.final_angle_rad == b.final_angle_rad && (a.kind != ActionKind::Pick || a.grasp == b.grasp) &&
         std::ranges::equal(a.beyond, b.beyond, same_beyond);
}

std::vector<Action> handlings_of(std::span<const Action> sequence, std::size_t object) {
  std::vector<Action> own;
  for (const Action& each : sequence)
    if (each.kind != ActionKind::MoveAway && each.object == object) own.push_back(each);
  return own;
}

// What ties objects to each other is told of the whole sequence only.
bool is_of_one_object(const ConflictSet& set) {
  return !set.constraints.empty() && std::ranges::all_of(set.constraints, [&](const Constraint& each) {
    return each.object == set.constraints.front().object && each.kind != ConstraintKind::Stack &&
           each.kind != ConstraintKind::Beyond;
  });
}

bool is_start(const Constraint& each) {
  return each.kind == ConstraintKind::StartPosition || each.kind == ConstraintKind::StartHeight ||
         each.kind == ConstraintKind::StartAngle;
}

}  // namespace

bool NogoodStore::learn(std::span<const Action> sequence, std::size_t most_nodes) {
  const auto set = conflict_of(*cell_, sequence, most_nodes);
  if (!set) return false;
  if (!is_of_one_object(*set)) {
    std::size_t last = 0;
    for (const Constraint& each : set->constraints) last = std::max(last, each.action);
    nogoods_.push_back(
        {std::nullopt, true, {sequence.begin(), sequence.begin() + static_cast<std::ptrdiff_t>(last) + 1}});
    return true;
  }
  std::size_t first = sequence.size(), last = 0;
  for (const Constraint& each : set->constraints) {
    first = std::min(first, each.action);
    last = std::max(last, each.action);
  }
  const std::size_t object = set->constraints.front().object;
  // The hand that places is the one that picked.
  while (sequence[first].kind != ActionKind::Pick || sequence[first].object != object) --first;
  const bool from_start = std::ranges::any_of(set->constraints, is_start);
  nogoods_.push_back({object, from_start, handlings_of(sequence.subspan(first, last - first + 1), object)});
  return true;
}

bool NogoodStore::matches(const Nogood& nogood, std::span<const Action> sequence) {
  if (!nogood.object) {
    return sequence.size() >= nogood.actions.size() &&
           std::ranges::equal(nogood.actions, sequence.first(nogood.actions.size()), same);
  }
  const std::vector<Action> own = handlings_of(sequence, *nogood.object);
  if (!nogood.from_start) return !std::ranges::search(own, nogood.actions, same).empty();
  return own.size() >= nogood.actions.size() &&
         std::ranges::equal(nogood.actions, std::span(own).first(nogood.actions.size()), same);
}

bool NogoodStore::refutes(std::span<const Action> sequence) const {
  return std::ranges::any_of(nogoods_, [&](const Nogood& each) { return matches(each, sequence); });
}

std::string NogoodStore::text(std::size_t k) const {
  const Nogood& nogood = nogoods_[k];
  std::string text = nogood.object ? cell_->objects[*nogood.object].name : std::string("all");
  text += nogood.from_start ? " from its start:" : ":";
  for (const Action& each : nogood.actions)
    text += (&each == nogood.actions.data() ? " " : ", ") + text_of(*cell_, each);
  return text;
}

}  // namespace stepwright::tamp
