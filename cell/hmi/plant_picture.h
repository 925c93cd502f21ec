#pragma once

// The plant's description as the page's picture: what to draw, and from which values of the cell each part of
// it lives.
//
//   PlantPicture picture = picture_of(config.plant).value();
//   Feed feed(greeting, picture.synoptic);
//   CellViewer viewer(picture.sources);
//
// A level is what the controller measures: the filtered counts of its sensor, less the tare that the
// supervisor has identified, through the sensor's calibration; or the raw counts while no program filters
// them. The true state of a simulated plant stands
// beside it.

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/server/point_reader.h"
#include "plant_models/core/plant_description.h"
#include "runtime/ground/result/result.h"

namespace stepwright::hmi {

struct PlantPicture {
  protocol::Synoptic synoptic;
  std::vector<server::PointSources> sources;  // by the points of the synoptic
  // An SVG (hmi_web/doc/drawings.md) of a plant that the page cannot draw by itself; empty: it can.
  std::string drawing = {};
};

// The configured plant; an empty picture for a kind without a description. Fails with what is wrong with a
// fleet's map (F0101 to F0104) or a hall's scene (hall_parameters()).
[[nodiscard]] result::Result<PlantPicture> picture_of(const config::PlantConfig& plant);

// `ports` says at which address of the process image each terminal of the plant is.
PlantPicture picture_of(const core::PlantDescription& plant, const std::vector<config::PortAddress>& ports);

}  // namespace stepwright::hmi
