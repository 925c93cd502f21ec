#pragma once

// A plant of which nothing is known but its terminals, as a drawing with live values
// (hmi_web/doc/drawings.md): a block with its actuators on the left and its sensors and values on the right.
//
// Pure; any thread.

#include <string>

#include "cell/config/stepped_config.h"
#include "cell/hmi/picture_points.h"

namespace stepwright::hmi {

// Draws up to 40 lines on each side, and says how many more there are.
std::string terminal_drawing(const std::string& title, const config::SteppedPlantConfig& plant,
                             PicturePoints& points);

}  // namespace stepwright::hmi
