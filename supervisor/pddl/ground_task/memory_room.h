#pragma once

// Question whether so much more may be held in memory: asked before large tables are made, which no check in
// between could stop.
//
// Threads: as whoever answers it says.
//
//   if (!room_for(rows * sizeof(Row))) return give_up();

#include <cstddef>
#include <functional>

namespace stepwright::pddl {

// May so many bytes more be held?
using RoomFor = std::function<bool(std::size_t bytes)>;

inline bool everything_fits(std::size_t) {
  return true;
}

}  // namespace stepwright::pddl
