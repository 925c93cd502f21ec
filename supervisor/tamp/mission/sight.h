#pragma once

// Where things stand, from several reports of a camera that misses things, sees some that are not there, and
// is off by millimetres: what most reports agree in is believed. Reports have kinds and no names: each thing
// is what is nearest to where it was believed to be. Heights are those of what it stands on.
//
// Values and pure functions; any thread.
//
//   const Sight sight = agree(cell, reports, believed);
//   if (!sight.things[cup]) ...   // most reports do not have it

#include <optional>
#include <string>
#include <vector>

#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::mission {

// An object in a report.
struct Seen {
  int kind = 0;  // of the camera, from 1: cup, can, tray, box, obstacle
  scene::Pose pose;
};
using Report = std::vector<Seen>;
inline constexpr int kObstacle = 5;  // what no order knows, and no arm may meet

struct Sight {
  std::vector<std::optional<scene::Pose>> things;
  std::vector<Seen> strangers;  // obstacles, and more of a kind of things than there are
};

// The camera's number of a thing's kind; 0: none.
int kind_of(const scene::Thing& thing);

// `before`: where each thing was believed to be.
Sight agree(const scene::RobotCell& cell, const std::vector<Report>& reports,
            const std::vector<scene::Pose>& before);

// The height of what a thing that is seen there stands on, if it is within 15 mm; else as seen.
scene::Pose settled(const scene::RobotCell& cell, const Sight& sight, std::size_t thing,
                    const scene::Pose& seen);

}  // namespace stepwright::tamp::mission
