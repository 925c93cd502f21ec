#pragma once

// What a planner of tasks is asked: a floor with obstacles and places, a train that stands on it, and a
// task. A value.

#include <string>
#include <vector>

#include "supervisor/geometry/point.h"
#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/ltl/train/train_model.h"

namespace stepwright::ltl {

struct Problem {
  Floor floor;
  TrainModel train;
  geometry::Pose start;  // all links in one line behind it, at rest
  std::string task;      // syntax: supervisor/doc/ltl.md

  std::vector<std::string> places() const {
    std::vector<std::string> names;
    for (const Area& area : floor.propositions) names.push_back(area.name);
    return names;
  }
};

}  // namespace stepwright::ltl
