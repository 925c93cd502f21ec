#pragma once

// A hall with a train as the page's picture: an SVG in the terms of hmi_web/doc/drawings.md, from the plant's
// description. Walls, obstacles and places as they lie; the tractor where its navigation has it, trailers
// where the simulated plant has them; blockages while they stand there.
//
//   PicturePoints points(ports);
//   picture.drawing = hall_drawing(assemblies::describe_tugger(parameters), points);

#include <string>

#include "cell/hmi/picture_points.h"
#include "plant_models/core/plant_description.h"

namespace stepwright::hmi {

// Requires a description with regions. Terminals are named as plant_models/doc/tugger.md says. Points that
// nothing is read from leave their part of the drawing without a value.
std::string hall_drawing(const core::PlantDescription& plant, PicturePoints& points);

}  // namespace stepwright::hmi
