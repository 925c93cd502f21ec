#pragma once

// A floor with vehicles as the page's picture: the plant's description, and the map as outlines.
//
//   PicturePoints points(ports);
//   synoptic.floor = floor_of(assemblies::describe_fleet(parameters), &*grid, points);

#include "cell/hmi/picture_points.h"
#include "hmi_web/protocol/floor.h"
#include "plant_models/core/plant_description.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::hmi {

// Terminals are named as plant_models/doc/forklift.md says: `x_v1`. Without a map (null) the floor has no
// walls. Obstacles that always stand are on the map already.
protocol::Floor floor_of(const core::PlantDescription& plant, const fleet::OccupancyGrid* map,
                         PicturePoints& points);

}  // namespace stepwright::hmi
