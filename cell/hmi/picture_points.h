#pragma once

// The live points of a picture while it is drawn up: each gets its id and the sources of its value. Every
// function returns the id of the point; an empty one if there is nothing to read it from.

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "hmi_web/protocol/synoptic.h"
#include "hmi_web/server/point_reader.h"

namespace stepwright::hmi {

class PicturePoints {
 public:
  // `ports` must outlive it.
  explicit PicturePoints(const std::vector<config::PortAddress>& ports) : ports_(ports) {}

  std::string add(std::string id, std::string label, std::string unit, bool trend,
                  server::PointSources sources);
  // The terminal of the plant, 0 or 1.
  std::string terminal(const std::string& id, const std::string& port);
  // The counts of a terminal, each of them worth `factor` of the unit.
  std::string counted(const std::string& id, const std::string& unit, const std::string& port, double factor);
  // Point of the simulated plant's value `name`.
  std::string truth(const std::string& id, const std::string& label, const std::string& unit, bool trend,
                    const std::string& name);

  // Null if the terminal is not wired.
  const std::string* address_of(const std::string& port) const;

  std::vector<protocol::Point> points;
  std::vector<server::PointSources> sources;  // by points

 private:
  const std::vector<config::PortAddress>& ports_;
};

}  // namespace stepwright::hmi
