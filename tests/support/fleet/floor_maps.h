#pragma once

// Floors drawn by code: an underground mine and a warehouse, and places where vehicles stand in them. The
// same seed draws the same floor on every machine.
//
//   const DrawnFloor mine = draw_mine(1);
//   mine.stations[0];  // in a dead end, looking out

#include <cstdint>
#include <vector>

#include "supervisor/map/occupancy_grid.h"

namespace stepwright::support {

struct DrawnFloor {
  fleet::OccupancyGrid grid;
  std::vector<geometry::Pose> stations;  // free for a vehicle of 1.4 x 4.0 m
};

// 120 x 80 m, cells of 0.2 m: a ring of tunnels about 6 m wide with crosscuts and dead ends, walls uneven.
DrawnFloor draw_mine(std::uint64_t seed);

// Tasks of seven vehicles in it: out of one dead end and forwards into another; all starts differ and all
// goals do.
struct DrawnTask {
  geometry::Pose start;
  geometry::Pose goal;
};
std::vector<DrawnTask> mine_tasks(const DrawnFloor& mine);

// 80 x 60 m, cells of 0.2 m: racks, aisles of 4 m, cross aisles of 6 m. The seed leaves out some racks.
DrawnFloor draw_warehouse(std::uint64_t seed);

// 100 x 66 m, cells of 0.2 m: racks with aisles of 4 m and cross aisles of 6 m in the middle, wider aisles
// around them; places where vehicles take or leave something, in the aisles (shelves) and in niches of the
// walls on the left and right (docks); bays in which they rest, one vehicle each, in the walls below and
// above.
struct DrawnHall {
  fleet::OccupancyGrid grid;
  std::vector<geometry::Pose> shelves;
  std::vector<geometry::Pose> docks;
  std::vector<geometry::Pose> bays;  // 50; the first ones are spread over the hall
};
DrawnHall draw_hall();

}  // namespace stepwright::support
