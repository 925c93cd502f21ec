#pragma once

// A circle problem with its envelopes as one JSON object, for solvers in any language:
//
//   {"problem": "circle", "vehicles": 2, "run": 0, "min_mps": 0.05, "max_mps": 1.5, "envelopes": [
//     {"vehicle": "v0", "start": [x, y, heading], "goal": [x, y, heading], "polygons": [
//       {"corners": [[x, y], ...], "stay_ms": [least, most], "overlap_ms": [least, most]}, ...]}, ...]}
//
// Metres and radians; corners anticlockwise; numbers read back as they were. All vehicles enter their first
// polygon at 0.

#include <string>
#include <vector>

#include "tests/bench/lattice/circle_envelopes.h"

namespace stepwright::bench {

struct Instance {
  int vehicles = 0;
  int run = 0;
  fleet::SpeedLimits speed;
  std::vector<support::CircleTask> tasks;
  std::vector<fleet::GrownEnvelope> envelopes;  // one for each task

  std::string name() const;  // of its file: circle_n02_r000_v1.5.json
};

Instance make_instance(CircleEnvelopes& circle, int vehicles, int run, const fleet::SpeedLimits& speed);
std::string to_json(const Instance& instance);

}  // namespace stepwright::bench
