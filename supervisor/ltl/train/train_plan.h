#pragma once

// Plan for a train: constant controls one after the other. A value.

#include <vector>

#include "supervisor/ltl/train/train_model.h"

namespace stepwright::ltl {

struct TrainPiece {
  TrainControl control;
  double duration_s = 0.0;  // greater than 0
};

struct TrainPlan {
  TrainState start{};
  std::vector<TrainPiece> pieces;
  TrainState end{};       // where the planner's integration of them ends
  double length_m = 0.0;  // of the way of the car's reference point, as the sum of its chords

  double duration_s() const {
    double sum = 0.0;
    for (const TrainPiece& piece : pieces) sum += piece.duration_s;
    return sum;
  }
};

}  // namespace stepwright::ltl
