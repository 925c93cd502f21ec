#pragma once

// A plan with the route that it follows, from which other plans are made. A value.
//
// Marks of the drive name points of that route. Before the first mark there may be controls that follow none:
// its pieces and its length are those of all that leads there.

#include "supervisor/ltl/search/driver.h"

namespace stepwright::ltl {

struct DrivenRoute {
  TrainState start{};
  Route route;
  DriveStyle style;
  Drive drive;

  double length_m() const { return drive.marks.back().length_m; }
  TrainPlan plan() const { return {start, drive.pieces, drive.marks.back().state, length_m()}; }
};

inline geometry::Point place_of(const DriveMark& mark) {
  return {mark.state[kTrainX], mark.state[kTrainY]};
}

// What is left of a route at a mark.
Route tail_of(const Route& route, const DriveMark& mark);

// The route as it was driven until the mark, and from there on another one, which begins there; `offset` is
// added to the indices of the other one's points.
Route with_other_end(const Route& route, const DriveMark& mark, const Route& other, std::size_t& offset);

// The drive until a mark, and behind it another one that begins there, whose points are so many further on in
// the route.
Drive joined(const Drive& drive, std::size_t mark, const Drive& other, std::size_t offset, std::size_t seen);

}  // namespace stepwright::ltl
