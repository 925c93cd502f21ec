#pragma once

// A circle problem with its envelopes as a scheduling problem in JSON, for solvers in any language:
//
//   {"vehicles": [{"name": "v1", "polygons": [
//      {"corners_m": [[x, y], ...], "stay_ms": [least, most], "overlap_ms": [least, most]}, ...]}, ...],
//    "constraints": [{"name": "v1 starts at once", "to": {"vehicle": "v1", "polygon": 0, "side": "entry"},
//                     "distance_ms": [0, 0]}, ...]}
//
// Corners anticlockwise; numbers read back as they were; a last polygon has no overlap. A constraint without
// "from" counts from time zero: all vehicles enter their first polygon then.

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
