#include "supervisor/pddl/search/landmarks/landmarks.h"

#include <algorithm>
#include <iterator>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/landmarks/atom_order.h"
#include "supervisor/pddl/search/landmarks/reasonable_order.h"

namespace stepwright::pddl {
namespace {

// What all units need that can be the first to reach the atom.
std::vector<int> common_needs(const RelaxedTask& task, const AtomOrder& order, std::size_t atom) {
  std::vector<int> common;
  std::vector<Word> before;
  bool first = true;
  for (const int unit : task.added_by(atom)) {
    const auto u = static_cast<std::size_t>(unit);
    if (!order.applied(u)) continue;
    order.before_unit(u, before);
    if (bit(before.data(), static_cast<int>(atom))) continue;
    const std::span<const int> needs = task.needs(u);
    std::vector<int> both;
    if (first) both.assign(needs.begin(), needs.end());
    if (!first) {
      std::set_intersection(needs.begin(), needs.end(), common.begin(), common.end(),
                            std::back_inserter(both));
    }
    first = false;
    common = std::move(both);
  }
  return common;
}

}  // namespace

Landmarks::Landmarks(const RelaxedTask& task, const std::function<bool()>& stop, const RoomFor& room_for)
    : landmark_of_(task.atoms(), -1) {
  if (!room_for(2 * AtomOrder::bytes_for(task))) return;
  AtomOrder order(task);
  if (!order.work_out(stop)) return;
  std::vector<Word> all(order.words(), 0);
  for (const int goal : task.goal()) {
    if (!order.reached(static_cast<std::size_t>(goal))) return;
    const Word* before = order.before_atom(static_cast<std::size_t>(goal));
    for (std::size_t w = 0; w < all.size(); ++w) all[w] |= before[w];
  }
  const std::size_t choices = task.first_comparison() + task.comparisons();
  for (std::size_t a = 0; a < choices; ++a) {
    if (!bit(all.data(), static_cast<int>(a))) continue;
    landmark_of_[a] = static_cast<int>(atoms_.size());
    atoms_.push_back(static_cast<int>(a));
    goal_.push_back(std::binary_search(task.goal().begin(), task.goal().end(), static_cast<int>(a)));
  }
  const std::vector<Word> state = task.space().initial();
  std::vector<bool> holds(task.atoms(), false);
  task.for_each_holding(state.data(), [&](int atom) { holds[static_cast<std::size_t>(atom)] = true; });
  std::vector<std::vector<int>> wanted_for(atoms_.size());
  for (std::size_t l = 0; l < atoms_.size(); ++l) {
    const auto atom = static_cast<std::size_t>(atoms_[l]);
    if (holds[atom] || atom >= task.first_comparison()) continue;
    for (const int need : common_needs(task, order, atom)) {
      const int before = landmark_of(need);
      if (before >= 0) wanted_for[static_cast<std::size_t>(before)].push_back(static_cast<int>(l));
    }
  }
  wanted_for_ = PackedLists<int>(wanted_for);
  better_first_ = PackedLists<int>(reasonable_order(task, order, atoms_, wanted_for, stop));
}

Landmarks find_landmarks(const RelaxedTask& task, SearchControl& control) {
  return {task, [&control] { return control.check() != StopReason::None; },
          [&control](std::size_t bytes) { return control.has_room_for(bytes); }};
}

}  // namespace stepwright::pddl
