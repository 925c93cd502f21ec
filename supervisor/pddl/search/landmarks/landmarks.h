#pragma once

// Atoms that every plan makes true at some time, and which of them must hold just before another: all that
// the delete relaxation shows (Zhu, Givan 2003, "Landmark extraction via planning graph propagation"; Keyder,
// Richter, Helmert 2010, "Sound and complete landmarks for and/or graphs"). Comparisons of numbers are atoms
// like any other. Some had better be reached before others (`reasonable_order`).
//
// Thread rule: immutable once built.

#include <functional>
#include <vector>

#include "supervisor/pddl/ground_task/memory_room.h"
#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

class SearchControl;

class Landmarks {
 public:
  // Of all plans from the initial state. `stop` gives up, and so it does where the orders of all atoms are
  // too large for half of the room; there are no landmarks then.
  Landmarks(const RelaxedTask& task, const std::function<bool()>& stop,
            const RoomFor& room_for = everything_fits);

  std::size_t size() const { return atoms_.size(); }
  int atom(std::size_t landmark) const { return atoms_[landmark]; }
  bool is_goal(std::size_t landmark) const { return goal_[landmark]; }
  // -1 if the atom is none.
  int landmark_of(int atom) const { return landmark_of_[static_cast<std::size_t>(atom)]; }
  // The landmarks that nothing reaches for the first time unless this one holds just before.
  std::span<const int> wanted_for(std::size_t landmark) const { return wanted_for_[landmark]; }
  // The landmarks that, once this one holds, are only reached by giving it up again.
  std::span<const int> better_first(std::size_t landmark) const { return better_first_[landmark]; }

 private:
  std::vector<int> atoms_, landmark_of_;
  std::vector<bool> goal_;
  PackedLists<int> wanted_for_, better_first_;
};

// As long as the search goes on, in the room that is left.
Landmarks find_landmarks(const RelaxedTask& task, SearchControl& control);

}  // namespace stepwright::pddl
