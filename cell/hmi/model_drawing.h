#pragma once

// A described plant as the page's picture: an SVG in the terms of hmi_web/doc/drawings.md, laid out from its
// connections. Components are grey (ISA-101); what runs or is closed has the colour of what is active; tanks
// are filled to their level; the main values stand in them.
//
//   PicturePoints points(ports);
//   picture.drawing = model_drawing(model, points);

#include <string>

#include "cell/hmi/picture_points.h"
#include "plant_models/components/model.h"

namespace stepwright::hmi {

// Points are made for all values of the plant, by their names ("a1.level").
std::string model_drawing(const components::Model& model, PicturePoints& points);

}  // namespace stepwright::hmi
