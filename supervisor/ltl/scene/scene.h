#pragma once

// Problem of a planner of tasks: a floor with obstacles and places, a train that stands on it, and a task. A
// value.

#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/geometry/point.h"
#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/ltl/train/train_model.h"

namespace stepwright::ltl {

struct Problem {
  Floor floor;
  TrainModel train;
  geometry::Pose start;                   // of the car, at rest
  std::string task;                       // syntax: supervisor/doc/ltl.md
  std::vector<double> trailers_rad = {};  // where they head; empty: all in one line behind the car
  // What a run that goes on has read of the task's word before it begins here: labels, in their order.
  std::vector<Label> read = {};

  TrainState standing() const {
    TrainState state = standing_at(train, start);
    for (std::size_t k = 0; k < trailers_rad.size() && k < train.trailers; ++k)
      state[kTrainTrailer + k] = trailers_rad[k];
    return state;
  }

  std::vector<std::string> places() const {
    std::vector<std::string> names;
    for (const Area& area : floor.propositions) names.push_back(area.name);
    return names;
  }
};

}  // namespace stepwright::ltl
